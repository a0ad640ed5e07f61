//! Questions about two events of a set, shown side by side.

use crate::{
    Facts, Query,
    ask::{Draft, shows_relation, texts},
};
use phase_evidence::parting::Parting;
use phase_model::{Attitude, EventKind};
use serde_json::json;

/// All drafts about two events of a set, shown side by side, of which both show what they are.
pub(crate) fn about_pair(pair: [&Facts; 2]) -> Vec<Draft> {
    let of = |facts: &Facts| {
        let attitudes = facts.scene.attitudes();
        (attitudes.contains(&Attitude::Help), attitudes.contains(&Attitude::Hinder))
    };
    let same = |facts: &Facts| facts.scene.kind == EventKind::Collaborating;
    let [one, other] = pair.map(of);
    let mut queries = Vec::new();
    if one.0 != other.0 {
        queries.push((Query::PairHelp, usize::from(other.0)));
    }
    if one.1 != other.1 && one.0 == other.0 {
        queries.push((Query::PairHinder, usize::from(other.1)));
    }
    if pair.map(same) == [true, false] || pair.map(same) == [false, true] {
        queries.push((Query::PairTogether, usize::from(same(pair[1]))));
    }
    let parting = Parting::of(&pair[0].track, &pair[1].track);
    let Some(seen) = parting.seen else { return Vec::new() };
    if !pair.iter().all(|facts| shows_relation(&facts.scene, &facts.track)) {
        return Vec::new();
    }
    let draft = |(query, right): (Query, usize)| Draft {
        query,
        events: pair.map(|facts| facts.id.clone()).to_vec(),
        set: pair[0].set.clone(),
        until: None,
        values: texts(["0", "1"]),
        value: right.to_string(),
        stratum: String::new(),
        proof: json!({
            "rule": "attitudes and goals of the scenes, seen in what the agents touch and move",
            "alphas": pair.map(|facts| facts.scene.attitudes()),
            "goals": pair.map(|facts| facts.scene.goals()), "visibly_parted_after_step": seen.step,
        }),
        p_human: None,
    };
    queries.into_iter().map(draft).collect()
}

#[cfg(test)]
mod tests {
    use super::about_pair;
    use crate::ask::tests::{alone, shared};
    use phase_model::AgentId;

    /// Videos look alike if a helper does everything alone in one, and an independent agent in the other.
    #[test]
    fn pairs_are_asked_about_where_both_videos_show_what_they_are() {
        let shows = shared("helping", [1, 0], AgentId::ONE);
        let hides = alone("helping", [1, 0], AgentId::ZERO);
        let apart = alone("independent", [0, 0], AgentId::ZERO);
        assert_eq!(about_pair([&shows, &apart]).len(), 1);
        assert!(about_pair([&hides, &apart]).is_empty());
    }
}

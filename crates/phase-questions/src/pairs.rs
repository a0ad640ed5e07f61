//! Questions about two events of a set, shown side by side.

use crate::{
    Facts, Query,
    ask::{Draft, texts},
};
use phase_evidence::parting::Parting;
use phase_model::{Attitude, EventKind};
use serde_json::json;

/// All drafts about two events of a set, shown side by side.
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
    let draft = |(query, right): (Query, usize)| Draft {
        query,
        events: pair.map(|facts| facts.id.clone()).to_vec(),
        set: pair[0].set.clone(),
        until: None,
        values: texts(["0", "1"]),
        value: right.to_string(),
        stratum: String::new(),
        proof: json!({
            "rule": "attitudes and goals of the scenes", "alphas": pair.map(|facts| facts.scene.attitudes()),
            "goals": pair.map(|facts| facts.scene.goals()), "visibly_parted_after_step": seen.step,
        }),
        p_human: None,
    };
    queries.into_iter().map(draft).collect()
}

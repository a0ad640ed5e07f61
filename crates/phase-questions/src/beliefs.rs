//! Questions about two events that differ in nothing but what an agent has been told: its belief about an
//! object that was moved behind its back is false in one and true in the other.

use crate::{
    Facts, Query,
    ask::{Draft, SURE, texts},
    query::room_value,
};
use phase_evidence::search;
use phase_model::{AgentId, Entity, ObjectId, RoomId, layout::room_of};
use serde_json::json;

/// A video that stops before the agent's first look shows this part of the time since it set out.
const SHOWN_WAY: (usize, usize) = (2, 3);
/// Least time between the end of such a video and the look (steps).
const LEAST_AHEAD: usize = 2;

/// One of the two events.
struct Twin<'a> {
    facts: &'a Facts,
    /// The step after which the agent sets out.
    from: usize,
    /// The step at which it sees the object or the place where that was.
    look: usize,
    /// The room in which its particles have the object, and their share.
    believed: (RoomId, f64),
    /// The room in which the object is.
    room: RoomId,
}

impl<'a> Twin<'a> {
    /// An event in which an agent is sure where the object is, and then looks there.
    fn of(facts: &'a Facts, agent: AgentId, object: ObjectId) -> Option<Self> {
        let from = usize::from(facts.scene.agents[agent].awareness.waits);
        let entity = Entity::Object(object);
        let inside = facts.inside.as_ref()?;
        let &believed = inside.beliefs[agent].get(from)?.get(object.index())?;
        let look = search::first_look(&facts.track, agent, entity, from)?;
        let room = room_of(inside.states.get(from)?.position(entity));
        let query = Query::Expects { agent, object, step: from };
        let shows = query.seen(&facts.track) == Some(room_value(believed.0));
        (shows && believed.1 >= SURE).then_some(Self { facts, from, look: look.step, believed, room })
    }
}

/// All drafts about two events of a set of beliefs. Either both events give a question, or none.
pub(crate) fn about_beliefs(pair: [&Facts; 2]) -> Vec<Draft> {
    let mut drafts = Vec::new();
    for agent in AgentId::ALL {
        let [one, other] = pair.map(|facts| facts.scene.agents[agent].awareness);
        let goal = pair[0].scene.agents[agent].goal;
        let Entity::Object(object) = goal.subject() else { continue };
        if one.sees == other.sees || one.waits != other.waits {
            continue;
        }
        let twins = pair.map(|facts| Twin::of(facts, agent, object));
        let [Some(one), Some(other)] = twins else { continue };
        if one.believed.0 == other.believed.0 || one.room != other.room {
            continue;
        }
        let rooms = [one.believed.0, other.believed.0].map(room_value).to_vec();
        let whole = [&one, &other].map(|twin| {
            let step = twin.from;
            let room = room_value(twin.believed.0);
            let right = if twin.believed.0 == twin.room { "yes" } else { "no" };
            [
                twin.draft(Query::Expects { agent, object, step }, &rooms, &room, None),
                twin.draft(Query::IsRight { agent, object, step }, &texts(["yes", "no"]), right, None),
            ]
        });
        drafts.extend(whole.into_iter().flatten());
        let cuts = [&one, &other].map(|twin| {
            let step = twin.from + SHOWN_WAY.0 * (twin.look - twin.from) / SHOWN_WAY.1;
            let query = Query::LooksNext { agent, object, step };
            let is_seen = query.seen(&twin.facts.track.until(step)) == Some(room_value(twin.believed.0));
            (is_seen && step + LEAST_AHEAD <= twin.look)
                .then(|| twin.draft(query, &rooms, &room_value(twin.believed.0), Some(step)))
        });
        if let [Some(one), Some(other)] = cuts {
            drafts.extend([one, other]);
        }
    }
    drafts
}

impl Twin<'_> {
    fn draft(&self, query: Query, values: &[String], value: &str, until: Option<usize>) -> Draft {
        let Facts { id, set, .. } = self.facts;
        Draft {
            query,
            events: vec![id.clone()],
            set: set.clone(),
            until,
            values: values.to_vec(),
            value: value.to_owned(),
            stratum: format!("both events of {}", set.as_deref().unwrap_or(id)),
            proof: json!({
                "rule": "particles of the agent's belief when it sets out; its way and first look agree",
                "share_of_particles": self.believed.1, "true_room": self.room,
                "false_belief": self.believed.0 != self.room, "first_look_step": self.look,
            }),
            p_human: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::about_beliefs;
    use crate::{
        Facts, Inside,
        ask::{
            about_event,
            tests::{FAR, START, event},
        },
    };
    use phase_model::{Awareness, RoomId, Sight, Vec2};

    /// The step after which the agent sets out, and that at which it looks.
    const STEPS: [usize; 2] = [10, 20];

    /// An agent that waits with its back to the object, which is taken to another room; then it goes to where
    /// the object was, or is, turns round and looks.
    fn twin(sees: Sight, share: f64) -> Facts {
        let moved = START + Vec2::new(11.0, 0.0);
        let (goes_to, room) = match sees {
            Sight::Start => (START, RoomId::ALL[3]),
            _ => (moved, RoomId::ALL[2]),
        };
        let beside = goes_to + Vec2::new(0.0, 4.0);
        let mut facts = event("competing", [0, 0], |step| {
            let way = step.clamp(STEPS[0], STEPS[1]) - STEPS[0];
            let way = way as f32 / (STEPS[1] - STEPS[0]) as f32;
            [FAR[0] + way * (beside - FAR[0]), FAR[1], if step < 5 { START } else { moved }]
        });
        for state in &mut facts.track.states[STEPS[1]..] {
            state.bodies[0].angle = core::f32::consts::PI;
        }
        facts.scene.agents[0].awareness = Awareness { sees, waits: STEPS[0] as u16, ..Awareness::default() };
        facts.id = format!("{sees:?}");
        facts.set = Some("twins".into());
        let beliefs = [vec![vec![(room, share)]; 41], vec![vec![(room, share)]; 41]];
        let states = facts.track.states.clone();
        facts.inside = Some(Inside { states, beliefs, without: None, futures: None });
        facts
    }

    #[test]
    fn twins_are_asked_about_together_and_have_other_answers() {
        let [one, other] = [Sight::Start, Sight::Objects].map(|sees| twin(sees, 0.9));
        let drafts = about_beliefs([&one, &other]);
        let answers = |name: &str| -> Vec<&str> {
            let of = drafts.iter().filter(|draft| draft.query.type_name() == name);
            of.map(|draft| draft.value.as_str()).collect()
        };
        assert_eq!(answers("expects"), ["3", "2"]);
        assert_eq!(answers("is-right"), ["no", "yes"]);
        assert_eq!(answers("looks-next"), ["3", "2"]);
        let before_the_look = |draft: &crate::ask::Draft| draft.until.is_none_or(|step| step < STEPS[1]);
        assert!(drafts.iter().all(before_the_look), "the end of the video does not show the answer");
        assert!(drafts.iter().all(|draft| draft.stratum == drafts[0].stratum));
        // Neither of the two is asked about if one is unsure, or if both believe the same.
        assert!(about_beliefs([&one, &twin(Sight::Objects, 0.7)]).is_empty());
        assert!(about_beliefs([&one, &one]).is_empty());
    }

    /// Events for beliefs end before they show a relation, and their agents know more than a viewer sees.
    #[test]
    fn nothing_but_beliefs_is_asked_about_twins() {
        let drafts = about_event(&twin(Sight::Start, 0.9));
        assert!(drafts.iter().all(|draft| draft.query.type_name() == "seen"), "{drafts:?}");
        assert!(drafts.iter().all(|draft| draft.events == ["Start"]));
    }
}

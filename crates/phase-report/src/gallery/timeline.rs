//! The subgoals of an event's agents, step by step, in few bytes, and the event in words.

use phase_dataset::manifest::EventEntry;
use phase_event::Event;
use phase_evidence::{Narrative, Track};
use phase_model::{AGENT_COUNT, AgentId, Entity, LandmarkId, words::Names};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// The subgoals of both agents, and what happens.
#[derive(Clone, PartialEq, Debug)]
pub struct Timeline {
    /// The subgoals of each agent.
    pub tracks: [SubgoalTrack; AGENT_COUNT],
    /// The event in words.
    pub narrative: Narrative,
}

/// The subgoals of one agent.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct SubgoalTrack {
    /// The subgoal as it changed: steps (from 0) and the subgoal's text from then on.
    pub subgoals: Vec<(usize, String)>,
    /// The share of belief particles behind the subgoal in every step, 0 to 1.
    pub shares: Vec<f32>,
}

impl Timeline {
    /// The timeline of an event.
    #[must_use]
    pub fn of(event: &Event) -> Self {
        let tracks = AgentId::ALL.map(|agent| {
            let mut track = SubgoalTrack::default();
            for (t, step) in event.steps.iter().enumerate() {
                let thought = &step.thoughts[agent];
                let text = thought.subgoal.to_string();
                if track.subgoals.last().is_none_or(|(_, last)| *last != text) {
                    track.subgoals.push((t, text));
                }
                track.shares.push(thought.share());
            }
            track
        });
        Self { tracks, narrative: Narrative::of(&event.scene, &Track::of_event(event), &Names::PAPER) }
    }
}

/// All timelines for the page's script: `texts`; `names`, the colours of what they mention, such as
/// `light blue object` for `object 0`; and for each event and agent the changes, as steps and indices into
/// `texts` alternating, and the shares, a base-36 digit for each step from 0 for none to z for all.
pub(super) fn table(events: &[EventEntry], timelines: &[Timeline]) -> Value {
    let mut places: BTreeMap<&str, usize> = BTreeMap::new();
    let mut texts: Vec<&str> = Vec::new();
    let mut table = Map::new();
    for (event, timeline) in events.iter().zip(timelines) {
        let mut tracks = Vec::with_capacity(AGENT_COUNT);
        for track in &timeline.tracks {
            let mut changes = Vec::with_capacity(2 * track.subgoals.len());
            for (step, text) in &track.subgoals {
                let place = *places.entry(text).or_insert_with(|| {
                    texts.push(text);
                    texts.len() - 1
                });
                changes.extend([*step, place]);
            }
            let shares: String = track.shares.iter().map(|&share| digit(share)).collect();
            tracks.push(json!([changes, shares]));
        }
        table.insert(event.id.clone(), tracks.into());
    }
    json!({ "texts": texts, "names": names(), "events": table })
}

/// Each entity and landmark by its id, as subgoals write it, with its name in the videos.
fn names() -> Map<String, Value> {
    let entities = Entity::ALL.into_iter().map(|it| (it.to_string(), Names::PAPER.entity(it)));
    let landmarks =
        LandmarkId::ALL.into_iter().map(|it| (format!("landmark {it}"), Names::PAPER.landmark(it)));
    entities.chain(landmarks).map(|(id, name)| (id, name.into())).collect()
}

fn digit(share: f32) -> char {
    // Values out of range and NaN become the nearest digit: `as` saturates.
    char::from_digit(((share * 35.0).round() as u32).min(35), 36).unwrap_or('0')
}

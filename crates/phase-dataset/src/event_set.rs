//! Sets of events that differ in one social variable, and where and when their events part.

use crate::ids;
use phase_event::Event;
use phase_evidence::{Track, parting::Parting};
use phase_files::checksum::FileEntry;
use phase_model::{AgentId, arena};
use phase_sampler::Stance;
use serde::{Deserialize, Serialize};

/// File name of the table of all pairs.
pub const PAIRS_FILE: &str = "pairs.csv";

/// The set that an event belongs to.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SetPlace {
    /// Name of the set.
    #[serde(deserialize_with = "ids::deserialize")]
    pub set: String,
    /// Stance of the changed agent towards the other.
    pub stance: Stance,
}

/// A set of events with the same scene and the same seed, which differ in the stance of one agent.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SetEntry {
    /// Name; the names of its events are this and a letter.
    #[serde(deserialize_with = "ids::deserialize")]
    pub id: String,
    /// The agent whose stance differs.
    pub changed: AgentId,
    /// Number of scenes tried until all events showed their labels.
    pub attempts: usize,
    /// Every two of its events.
    pub pairs: Vec<PairEntry>,
    /// The events side by side, unless the dataset was generated without videos.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub video: Option<FileEntry>,
}

/// Two events of a set.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PairEntry {
    /// Their names.
    pub events: [String; 2],
    /// The first step after which any place differs at all.
    pub first: Option<usize>,
    /// The first difference that a viewer sees.
    pub seen: Option<SeenDifference>,
    /// The first step after which each entity is visibly elsewhere, agents first.
    pub entities: Vec<Option<usize>>,
    /// The largest difference of place of any entity (u).
    pub farthest: f32,
}

/// The first difference of two events that can be seen in their videos.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SeenDifference {
    /// After which step.
    pub step: usize,
    /// The entity: 0 and 1 are the agents, 2 and 3 the objects.
    pub entity: usize,
    /// Its places in the one and the other event (x, y; u).
    pub places: [[f32; 2]; 2],
}

impl PairEntry {
    /// Compares two events.
    #[must_use]
    pub fn of(events: [(&str, &Event); 2]) -> Self {
        let [one, other] = events.map(|(_, event)| Track::of_event(event));
        let parting = Parting::of(&one, &other);
        Self {
            events: events.map(|(id, _)| id.to_owned()),
            first: parting.first,
            seen: parting.seen.map(|seen| SeenDifference {
                step: seen.step,
                entity: seen.entity.index(),
                places: seen.places.map(|place| place.to_array()),
            }),
            entities: parting.entities,
            farthest: parting.farthest,
        }
    }

    /// Every two of some events.
    #[must_use]
    pub fn all(events: &[(&str, &Event)]) -> Vec<Self> {
        let pairs =
            events.iter().enumerate().flat_map(|(k, one)| events[k + 1..].iter().map(move |it| (one, it)));
        pairs.map(|(one, other)| Self::of([*one, *other])).collect()
    }
}

/// The name of an event of a set: letters, which reveal nothing.
#[must_use]
pub fn member_id(set: &str, index: usize) -> String {
    let letter = char::from(b'a' + u8::try_from(index % 26).unwrap_or_default());
    format!("{set}{letter}")
}

/// Path of the video of a set, relative to the dataset's folder.
#[must_use]
pub fn set_video_path(id: &str) -> String {
    format!("videos/{id}.mp4")
}

/// The first line of the table of all pairs, which is CSV. Neither names nor numbers need quoting.
pub const PAIRS_HEADER: &str = "set,event_a,event_b,stance_a,stance_b,changed_agent,first_step,seen_step,seen_s,seen_entity,\
     seen_x_a,seen_y_a,seen_x_b,seen_y_b,changed_agent_seen_step,other_agent_seen_step,farthest_u\n";

/// The rows of a set in that table; `place` gives that of an event by its name.
#[must_use]
pub fn pair_rows<'a>(set: &SetEntry, place: impl Fn(&str) -> Option<&'a SetPlace>) -> String {
    let mut text = String::new();
    let number = |value: Option<usize>| value.map_or_else(String::new, |value| value.to_string());
    for pair in &set.pairs {
        let [one, other] =
            [0, 1].map(|k: usize| place(&pair.events[k]).map_or("", |place| place.stance.name()));
        let of_agent = |agent: AgentId| number(pair.entities.get(agent.index()).copied().flatten());
        let seen = pair.seen.as_ref().map_or_else(
            || ",,,,,,".to_owned(),
            |SeenDifference { step, entity, places: [[x, y], [to_x, to_y]] }| {
                let seconds = *step as f64 * arena::STEP_VIDEO_SECONDS;
                format!("{step},{seconds:.2},{entity},{x:.2},{y:.2},{to_x:.2},{to_y:.2}")
            },
        );
        let fields = [
            set.id.clone(),
            pair.events.join(","),
            one.to_owned(),
            other.to_owned(),
            set.changed.to_string(),
            number(pair.first),
            seen,
            of_agent(set.changed),
            of_agent(set.changed.other()),
            format!("{:.2}", pair.farthest),
        ];
        text += &format!("{}\n", fields.join(","));
    }
    text
}

//! PHASE events in memory and as JSON of the format `phase-events/1`.
//!
//! A [`Recording`] is one event of such a file: its [`Scene`](phase_model::Scene), its labels, and the
//! [`Trajectory`] of all entities. A simulated event additionally has its whole [`Event`]: every substep,
//! both agents' actions ([`Step`]) and their explanations ([`Thought`]). Reading a file of events:
//!
//! ```
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let text = r#"{"format": "phase-events/1", "events": [{"id": "chase", "layout": {"base": 0},
//!         "agents": [{"size_level": 0, "strength_level": 2, "alpha": 0,
//!                     "goal": {"kind": "touch", "agent": 0, "other": 1, "sign": 1}},
//!                    {"size_level": 0, "strength_level": 2, "alpha": 0,
//!                     "goal": {"kind": "touch", "agent": 0, "other": 1, "sign": -1}}],
//!         "objects": [], "event": "chasing",
//!         "trajectory": {"columns": ["x", "y", "vx", "vy", "angle"], "objects": [],
//!                        "agents": [[[8, 14, 0, 0, 0]], [[24, 14, 0, 0, 1.5]]]}}]}"#;
//!     for recording in phase_event::from_json(text)? {
//!         let kind = recording.scene.kind.name();
//!         let relation = recording.relation.name();
//!         println!("{}: {kind}, {relation}, {} steps", recording.id, recording.trajectory.steps());
//!     }
//!     Ok(())
//! }
//! ```
//!
//! A method that perceives events implements [`Recogniser`] (goals and relations) or [`Forecaster`]
//! (trajectories), and is shown an [`ObservedEvent`].
//! [`parse_observed`] reads them from files without labels.
//!
//! `docs/reference/formats/events.md` describes every field. Reading and writing are exact inverses, bit for
//! bit. Every part can also be read and written separately: [`Recording`], [`Event`] and
//! [`Scene`](phase_model::Scene) have `from_json` and `to_json`, and implement serde's traits.
//!
//! Key design decision: events are read by hand from a tree of JSON values instead of by derived readers, so
//! that errors name the field, the event and the rule that is violated. The trade-off is a reader four times
//! as long, and a file has to fit in memory twice.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod beliefs;
mod error;
mod event;
mod line_formatter;
mod mean;
mod method;
mod observed;
mod read;
mod read_simulation;
mod recording;
mod serde_impls;
mod subgoals;
mod thought;
mod tracking;
mod trajectory;
mod warning;
mod write;

pub use beliefs::{
    BeliefOrder, BeliefReader, Beliefs, PLACES, SEEN, Whereabouts, certain, others, whereabouts,
};
pub use error::{EventReadError, EventWriteError};
pub use event::{Event, Step};
pub use mean::mean_state;
pub use method::{Forecaster, MethodError, MethodResult, Prediction, ProgressCallback, Recogniser, SAMPLES};
pub use observed::{ObservedError, ObservedEvent};
pub use read::{LONGEST_ID, check_id, from_json, is_labelled, parse, parse_observed};
pub use recording::{Controller, Recording, Recovered, SimulationRecord};
pub use subgoals::subgoal_of;
pub use thought::{ActionEvaluation, BelievedIntent, SubgoalValue, Thought};
pub use tracking::{Missing, Noise, Tracking};
pub use trajectory::{COLUMNS, Row, SUBSTEP_COLUMNS, SubstepRow, Trajectory, substep_row};
pub use warning::EventWarning;
pub use write::{FILE_FORMAT, observed_to_json, pairs_in_contact, to_json};

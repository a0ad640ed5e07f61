//! The format `phase-events/1`: recordings of social events, measured or simulated, as JSON.
//!
//! `docs/formats.md` describes every field. A [`Recording`] is one event of such a file in memory; reading
//! and writing are each other's inverse.

mod read;
mod read_scene;
mod read_simulation;
mod recording;
mod replay;
mod subgoals;
mod write;

pub(crate) use read::check_format;
pub use read::{LONGEST_ID, parse, read};
pub(crate) use recording::substep_row;
pub use recording::{COLUMNS, Recording, Recovered, Row, SUBSTEP_COLUMNS, Simulation, Trajectory};
pub use subgoals::subgoal_of;
pub(crate) use write::pairs_in_contact;
pub use write::{FILE_FORMAT, NotFinite, to_json};

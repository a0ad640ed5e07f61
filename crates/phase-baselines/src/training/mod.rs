//! Training of any of the networks: rounds, batches, Adam, early stopping, and checkpoints from which it resumes
//! exactly.

mod adam;
mod checkpoint;
mod network;
mod order;
mod published;
mod record;
mod run;
mod weights;

pub use checkpoint::{Checkpoint, CheckpointError};
pub use network::{Loss, Network};
pub use published::Published;
pub use record::{Final, NamedMeasure, Record, RecordError, RecordedRound, Source};
pub use run::{Measure, Round, Run, Settings, TrainingError, measure};
pub use weights::{NetworkError, from_safetensors, to_safetensors};

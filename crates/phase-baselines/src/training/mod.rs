//! Training of any of the networks: rounds, batches, Adam, early stopping, and checkpoints from which it
//! resumes exactly.

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
pub use published::PublishedNetwork;
pub use record::{DataSource, Final, NamedMetrics, RecordedRound, TrainingRecord, TrainingRecordError};
pub use run::{Metrics, Round, TrainingError, TrainingRun, TrainingSettings, evaluate};
pub use weights::{NetworkError, from_safetensors, to_safetensors};

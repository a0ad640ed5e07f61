//! Training of any of the networks: epochs, batches, Adam, early stopping, and a checkpoint after which it goes on as if
//! nothing had happened.

mod adam;
mod checkpoint;
mod network;
mod published;
mod run;
mod tensors;
mod weights;

pub use checkpoint::{Checkpoint, CheckpointError};
pub use network::{Loss, Network};
pub use published::Published;
pub use run::{Epoch, Measure, Run, Settings, TrainingError, measure};
pub use tensors::TensorsError;
pub use weights::{from_safetensors, to_safetensors};

//! SIMPLE's strength regressor: two hidden layers from speeds and accelerations to a force (appendix,
//! "Bottom-up Proposals").
//!
//! It is trained on the inputs that it is used for: whole events, for the initial proposals, and windows of
//! ΔT steps, for those after.

mod network;
mod samples;
mod score;
mod training;

pub use samples::{AgentSamples, Sample, WINDOW};
pub use score::{Score, most_common, nearest, score};
pub use training::{Epoch, StrengthTrainingSettings, TrainingError, train};

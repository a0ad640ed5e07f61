//! SIMPLE's strength regressor: two hidden layers from speeds and accelerations to a force (appendix, "Bottom-up
//! Proposals").
//!
//! It is trained on what it is asked about later: whole events, for the first proposals, and stretches of ΔT steps,
//! for those after.

mod network;
mod samples;
mod score;
mod training;

pub use samples::{AgentSamples, Sample, WINDOW};
pub use score::{Score, most_common, nearest, score};
pub use training::{Epoch, StrengthTrainingSettings, TrainingError, train};

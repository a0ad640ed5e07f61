//! SIMPLE (SIMulation, Planning and Local Estimation): what explains the motion of a social event, and how it goes on.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod beliefs;
pub mod chain;
pub mod cue;
pub mod generative;
pub mod hypothesis;
pub mod inference;
pub mod posterior;
pub mod proposal;
pub mod reconstruction;
pub mod settings;
pub mod strength;

pub use generative::Stage;
pub use hypothesis::{Hypothesis, physical_goals};
pub use inference::{Inference, explain, infer};
pub use posterior::Posterior;
pub use proposal::Proposal;
pub use settings::{Settings, Update};
pub use strength::{AnyStrength, StrengthCue, StrengthRegressor};

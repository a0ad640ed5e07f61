//! SIMPLE (SIMulation, Planning and Local Estimation): what explains the motion of a social event, and how it goes on.
//!
//! An event is first prepared ([`Stage`]): who held what, and what each agent can have observed and so believed. A
//! [`Hypothesis`] is then simulated by the very minds and physics that make events, and is the likelier the nearer it
//! stays to what was observed. [`infer`] searches hypotheses and returns a [`Posterior`]; [`forecast()`] plays the
//! likeliest on.
//!
//! The key design decision is that everything starts from an [`ObservedEvent`](phase_model::ObservedEvent), a type
//! without labels: what is inferred cannot have been read. The price is that grips and contacts, which trajectories do
//! not tell, have to be guessed ([`reconstruction`]).
//!
//! `docs/simple.md` says where the paper's formulas were settled and where this goes beyond them.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod beliefs;
pub mod cue;
pub mod forecast;
pub mod generative;
pub mod hypothesis;
pub mod inference;
pub mod metropolis;
pub mod posterior;
pub mod proposal;
pub mod reconstruction;
pub mod settings;
pub mod simulations;
pub mod strength;
mod sweep;

pub use forecast::{ForecastSettings, forecast};
pub use generative::Stage;
pub use hypothesis::{Hypothesis, physical_goals};
pub use inference::{Inference, explain, infer};
pub use posterior::Posterior;
pub use proposal::Proposal;
pub use settings::{Settings, Update};
pub use strength::{AnyStrength, StrengthCue, StrengthRegressor};

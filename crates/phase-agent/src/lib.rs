//! One PHASE agent's mind: from belief to subgoal to action (paper, Algorithm 1).
//!
//! [`Agent::perceive`] updates the belief, [`Agent::decide`] plans from every particle, weighs the subgoals,
//! and searches an action for the best of them with the particles that agree on it. The latter is [`Mind::decide`],
//! which inference uses with beliefs that it has estimated.
//!
//! The key design decision is that a mind owns its model of the world ([`phase_model::Dynamics`]) and never
//! sees the true one: whatever it knows it has perceived. The price is a second simulation of the physics.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod agent;
pub mod convoy;
pub mod course;
pub mod guidance;
pub mod imagination;
mod load;
pub mod mind;
pub mod objective;
pub mod patience;
pub mod repertoire;
pub mod settings;

pub use agent::Agent;
pub use mind::{Mind, Outlook};
pub use settings::{Foresight, Settings};

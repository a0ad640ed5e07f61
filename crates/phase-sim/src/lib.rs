//! Two PHASE agents and a world make a social event (paper, Algorithm 1).
//!
//! [`simulate`] takes a scene and a seed and returns the [`Event`](phase_event::Event): what both did at every step and why, and
//! all substeps of what became of it. The event plays in `phase-world`, or on request in `phase-forward`
//! ([`Engine`]); what agents perceive, believe and imagine is made in the same way for both.
//!
//! The key design decision is that every random stream belongs to one agent and one purpose. The same seed
//! makes the same event bit for bit, and what an agent believed can be recomputed from the recorded
//! trajectory without planning ([`beliefs()`]). From its search stream an agent draws once a decision, for a generator
//! of that decision's own. The price is that a change in how often a belief draws changes all its later draws.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod beliefs;
pub mod settings;
pub mod simulation;
mod truth;

pub use beliefs::{BeliefSnapshot, beliefs};
pub use settings::{Engine, Settings};
pub use simulation::{SimulationError, simulate, simulate_with};

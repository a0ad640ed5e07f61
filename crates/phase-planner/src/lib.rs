//! High-level planning in PHASE: A* over symbolic states of both agents, subgoals and their value.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod subgoal;

pub use subgoal::Subgoal;

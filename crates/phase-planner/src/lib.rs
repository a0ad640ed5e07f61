//! High-level planning in PHASE: what an agent should bring about next.
//!
//! From one possible world (a belief particle) [`Planner::plan`] finds the agent's best plan: the physical
//! state is reduced to a few named spots, doors, widths, forces and holds, A* searches the symbolic actions
//! of one or both agents, and the agent's own part of the cheapest plan is put into predicates
//! ([`Subgoal`]). [`value::candidates`] then weighs the first subgoals of all particles (V with λ = 0.05).
//!
//! The key design decision is that nothing is forbidden that could be tried: a door too narrow or a load too
//! heavy costs more than any way round instead of cutting the search off. A weak agent without help still
//! goes and pulls, as people expect to see. The price is that a plan's existence does not mean that it will
//! succeed; its cost does.
//!
//! This crate knows no physics engine: widths, forces and straight distances are all it uses.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod flight;
pub mod hindrance;
pub mod plan;
pub mod routes;
pub mod search;
pub mod situation;
pub mod subgoal;
pub mod task;
pub mod value;

pub use plan::{Plan, Planner};
pub use routes::{Gaps, Route, Routes};
pub use situation::{Situation, Spot};
pub use subgoal::Subgoal;
pub use value::Candidate;

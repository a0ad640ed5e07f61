//! On, Touch, Attach and Close: the words in which PHASE agents plan.
//!
//! A physical [`State`](phase_model::State) becomes a [`SymbolicState`], the set of predicates true in it
//! (paper, appendix "Predicates, Symbolic States, Goals, and Subgoals"). Goals and subgoals are
//! [`Literal`](phase_model::Literal)s: predicates or their negations.
//!
//! The key design decision is that *Close to a landmark* means *in the landmark's room*. The paper says "within
//! a certain distance" and gives no number; with the room as that distance, going through a door is a change
//! of one predicate, and symbolic plans can speak of rooms without a fifth kind of predicate. The price is
//! that two points a hand's breadth apart on either side of a border are close to different landmarks.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod evaluate;
pub mod symbolic;
pub mod threshold;

pub use evaluate::{achieved, holds, is_true};
pub use symbolic::SymbolicState;

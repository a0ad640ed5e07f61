//! One PHASE agent's mind: belief to subgoal to action.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod thought;

pub use thought::{ActionValue, SubgoalValue, Thought};

//! The search on problems with independently known solutions.

mod arbitrary;
mod batch;
mod chain;
mod errors;
mod invariants;
mod pinned;
mod puct;
mod returns;
mod tiger;
mod tiger_problem;

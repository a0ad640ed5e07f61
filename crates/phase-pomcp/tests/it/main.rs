//! The search on problems with independently known solutions.

mod chain;
mod errors;
mod invariants;
mod puct;
mod returns;
mod tiger;
mod tiger_problem;

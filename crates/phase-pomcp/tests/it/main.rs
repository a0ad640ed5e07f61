//! The search against problems whose answers are known by other means.

mod chain;
mod errors;
mod invariants;
mod puct;
mod returns;
mod tiger;
mod tiger_problem;

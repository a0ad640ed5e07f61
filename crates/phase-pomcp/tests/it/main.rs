//! The search on problems with independently known solutions.

mod arbitrary;
mod belief;
mod chain;
mod errors;
mod invariants;
mod legal;
mod pinned;
mod puct;
mod returns;
mod tiger;
mod tiger_problem;
mod view;
mod widening;

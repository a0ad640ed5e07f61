//! Beliefs: their invariants, their statistics, and drawn cases.

mod ascribed;
mod common;
mod consistency;
mod contest;
mod invariants;
mod memory;
mod place;
mod predict;
mod statistics;

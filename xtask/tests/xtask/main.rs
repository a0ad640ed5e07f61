//! The development commands of `cargo xtask`, run as a program.

mod check_behaviour;
mod check_minds;
mod check_physics;
mod check_schedule;
mod check_verify;
mod commands;
mod documents;
mod fit_inference;
mod fit_minds;
mod fit_reports;
mod results;
mod support;
mod tidy;
mod torture;
mod walks;

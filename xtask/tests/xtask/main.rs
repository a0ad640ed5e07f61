//! The command line, run as a program.

mod bad_input;
mod check_physics;
mod check_behaviour;
mod gen_dataset;
mod interruption;
mod render;
mod simulate;
mod support;
mod tidy;

//! The command line, run as a program.

mod bad_input;
mod benchmark;
mod captions;
mod damage;
mod eval;
mod gen_dataset;
mod interruption;
mod networks;
mod predictions;
mod render;
mod selection;
mod simulate;
mod support;
#[cfg(feature = "networks")]
mod train;
mod verify;

//! The command line, run as a program.

mod bad_input;
mod benchmark;
mod blocks;
mod console;
mod damage;
mod earlier;
mod eval;
mod export;
mod gen_dataset;
mod hostile;
mod inputs;
mod interruption;
mod json;
mod laboratory;
mod manual;
mod narrate;
mod networks;
mod new_scene;
mod playground;
mod predictions;
mod progress;
mod questions;
mod render;
mod seal;
mod selection;
#[cfg(feature = "serve")]
mod serve;
mod sets;
mod shell;
mod simulate;
mod stats;
mod study;
mod support;
mod threads;
mod track;
#[cfg(feature = "networks")]
mod train;
mod verify;
mod walks;

/// The program that is run.
const PROGRAM: &str = env!("CARGO_BIN_EXE_phase");

//! SIMPLE, its variants and its parts as methods that answer to events.

mod cue;
mod intent_guess;
mod simple;
mod variants;

pub use cue::MotionCue;
pub use intent_guess::IntentGuess;
pub use simple::Simple;

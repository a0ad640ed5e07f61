//! Ctrl-C: once to stop in good order, twice to stop at once.

use crate::console::print_message;
use std::sync::{
    Once,
    atomic::{AtomicBool, Ordering},
};

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Begins to listen. Without it, or where the system does not let us listen, Ctrl-C ends the program at once;
/// nothing is half-written then either, but the event at work is lost.
pub fn listen() {
    static LISTENING: Once = Once::new();
    LISTENING.call_once(|| {
        let heard = ctrlc::set_handler(|| {
            if REQUESTED.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
            print_message("stopping after this step; press Ctrl-C again to stop at once");
        });
        if let Err(error) = heard {
            print_message(format!("note: cannot listen for Ctrl-C ({error}); it will stop at once"));
        }
    });
}

/// Whether someone wants us to stop.
#[must_use]
pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

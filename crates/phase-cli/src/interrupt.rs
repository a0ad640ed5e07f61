//! Ctrl-C: once for a graceful stop, twice to stop immediately.

use crate::console::print_message;
use std::sync::{
    Once,
    atomic::{AtomicBool, Ordering},
};

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Installs the handler. Without it, or where the system does not allow it, Ctrl-C ends the program at once;
/// nothing is half-written then either, but the current event is lost.
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

/// Whether an interruption was requested.
#[must_use]
pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

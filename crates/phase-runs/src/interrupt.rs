//! Ctrl-C: once for a graceful stop, twice to stop immediately.

use crate::console::print_message;
use std::sync::{
    Once,
    atomic::{AtomicBool, Ordering},
};

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Whether a program that this one is a part of listens for Ctrl-C.
static LEFT_TO_HOST: AtomicBool = AtomicBool::new(false);

/// Leaves Ctrl-C to the program that runs the commands of this one, such as Python: no handler is installed, and that program
/// calls [`request`].
pub fn leave_to_host() {
    LEFT_TO_HOST.store(true, Ordering::Relaxed);
}

/// Requests a graceful stop.
pub fn request() {
    REQUESTED.store(true, Ordering::Relaxed);
}

/// Forgets a request, after the command that it was meant for.
pub fn clear() {
    REQUESTED.store(false, Ordering::Relaxed);
}

/// Installs the handler. Without it, or where the system does not allow it, Ctrl-C ends the program at once;
/// nothing is half-written then either, but the current event is lost.
pub fn listen() {
    static LISTENING: Once = Once::new();
    if LEFT_TO_HOST.load(Ordering::Relaxed) {
        return;
    }
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

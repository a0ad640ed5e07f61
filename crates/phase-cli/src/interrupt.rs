//! Ctrl-C: once for a graceful stop, twice to stop immediately.

use crate::console::print_message;
use phase_runs::interrupt;
use std::sync::{
    Once,
    atomic::{AtomicBool, Ordering},
};

/// Whether a program that this one is a part of listens for Ctrl-C.
static LEFT_TO_HOST: AtomicBool = AtomicBool::new(false);

/// Leaves Ctrl-C to the program that runs the commands of this one, such as Python: no handler is installed,
/// and that program calls [`interrupt::request`].
pub fn leave_to_host() {
    LEFT_TO_HOST.store(true, Ordering::Relaxed);
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
            if interrupt::request() {
                std::process::exit(130);
            }
            print_message("stopping after this step; press Ctrl-C again to stop at once");
        });
        if let Err(error) = heard {
            print_message(format!("note: cannot listen for Ctrl-C ({error}); it will stop at once"));
        }
    });
}

//! A graceful stop of all runs of this process: nothing new is begun, what is under way is given up, what is
//! finished is kept.
//!
//! The request is one for the whole process, as Ctrl-C is. A listener for Ctrl-C calls [`request`].

use core::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Requests a graceful stop; returns whether one was requested before.
pub fn request() -> bool {
    REQUESTED.swap(true, Ordering::Relaxed)
}

/// Forgets a request, after the run that it was meant for.
pub fn clear() {
    REQUESTED.store(false, Ordering::Relaxed);
}

/// Whether a stop was requested.
#[must_use]
pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

/// Whether a computation goes on, for callbacks that are asked after each of its steps.
pub(crate) fn goes_on() -> ControlFlow<()> {
    if requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

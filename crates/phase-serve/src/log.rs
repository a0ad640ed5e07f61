//! The log: failures of the server's own, on stderr, one line each. It does not tell who plays or rates what,
//! since that is nobody's business.

use std::{error::Error, io::Write as _, iter::successors};

/// Tells of a failure and its causes.
pub(crate) fn failure(error: &dyn Error) {
    let causes = successors(Some(error), |error| (*error).source()).map(ToString::to_string);
    line(&format!("error: {}", causes.collect::<Vec<_>>().join(": ")));
}

/// Tells something.
pub(crate) fn line(text: &str) {
    // A closed stderr is no reason to stop.
    let _ = writeln!(std::io::stderr(), "{text}");
}

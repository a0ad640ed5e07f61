//! The log: failures of the server's own, on stderr, one line each. It does not tell who plays or rates what,
//! since that is nobody's business.

use std::{error::Error, io::Write as _, iter::successors};

/// Tells of a failure and its causes, each once: many errors have the words of their cause.
pub(crate) fn failure(error: &dyn Error) {
    let mut text = format!("error: {error}");
    for cause in successors(error.source(), |cause| (*cause).source()) {
        let cause = cause.to_string();
        if !text.ends_with(&cause) {
            text += &format!(": {cause}");
        }
    }
    line(&text);
}

/// Tells something.
pub(crate) fn line(text: &str) {
    // A closed stderr is no reason to stop.
    let _ = writeln!(std::io::stderr(), "{text}");
}

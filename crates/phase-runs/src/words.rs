//! Numbers of things in words.

/// A number of events: `1 event`, `12 events`.
#[must_use]
pub fn events(count: usize) -> String {
    if count == 1 { "1 event".into() } else { format!("{count} events") }
}

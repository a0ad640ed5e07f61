//! Numbers of things in words.

/// A number of events: `1 event`, `12 events`.
#[must_use]
pub fn events(count: usize) -> String {
    counted(count, "event", "events")
}

/// A number of things: `1 matrix`, `2 matrices`.
#[must_use]
pub fn counted(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}

//! Which probes belong together.

/// Beginnings of names that belong to a family of another name, longest first where one begins another.
const PREFIXES: [(&str, &str); 6] = [
    ("items_collide", "items_collide"),
    ("push_off", "push_off_centre"),
    ("item_coast", "coast"),
    ("attach", "grab"),
    ("inner_wall", "wall"),
    ("turn", "turn"),
];

/// The family of a probe: what its name begins with, up to the first `_`, except for a few that are named
/// after a variation of their family. A beginning that is not known is a family of its own.
#[must_use]
pub fn family(name: &str) -> &str {
    let special = PREFIXES.into_iter().find(|(prefix, _)| name.starts_with(prefix));
    special.map_or_else(|| name.split('_').next().unwrap_or(name), |(_, family)| family)
}

//! Families of probes.

/// Prefixes of names that belong to a family of another name, longest first where one is a prefix of another.
const PREFIXES: [(&str, &str); 6] = [
    ("items_collide", "items_collide"),
    ("push_off", "push_off_centre"),
    ("item_coast", "coast"),
    ("attach", "grab"),
    ("inner_wall", "wall"),
    ("turn", "turn"),
];

/// The family of a probe: the prefix of its name up to the first `_`, except for a few that are named after a
/// variation of their family. An unknown prefix is a family of its own.
#[must_use]
pub fn family(name: &str) -> &str {
    let special = PREFIXES.into_iter().find(|(prefix, _)| name.starts_with(prefix));
    special.map_or_else(|| name.split('_').next().unwrap_or(name), |(_, family)| family)
}

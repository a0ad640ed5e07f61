//! Clips, lists and matches, tested module by module.

mod clips;
mod lists_and_matches;

//! Criterion benches of the PHASE crates; see `benches/`.

//! Comparison with what the published simulator itself computes (reference material beside the project).

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::indexing_slicing, clippy::panic)]

mod belief;
mod cases;
mod decisions;
mod imagined;
mod observe;
mod recorded;
mod replayed;
mod reward;
mod rules;
mod selection;

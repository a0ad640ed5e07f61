//! Comparison with what the published simulator itself computes (reference material beside the project).

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::indexing_slicing, clippy::panic)]

mod cases;
mod observe;
mod reward;
mod rules;
mod selection;
mod imagined;
mod belief;
mod decisions;

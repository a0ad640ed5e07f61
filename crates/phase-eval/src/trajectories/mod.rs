//! Task 2, multi-entity trajectory prediction: how far off a method is.

mod errors;
mod summary;

pub use errors::{Errors, ForecastError, ForecastEvent};
pub use summary::{ForecastScores, ForecastSummary};

/// Steps that are watched before the prediction (5 s of video).
pub const WATCHED_STEPS: usize = 20;
/// Steps to predict (5 s of video), or as many as there are in an event that ends before.
pub const PREDICTED_STEPS: usize = 20;

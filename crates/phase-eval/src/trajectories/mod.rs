//! Task 2, multi-entity trajectory prediction: the errors of a method.

mod errors;
mod samples;
mod summary;

pub use errors::{Errors, ForecastError, ForecastEvent};
pub use samples::SampleErrors;
pub use summary::{ForecastScores, ForecastSummary, SampleScores};

/// Observed steps before the prediction (5 s of video).
pub const WATCHED_STEPS: usize = 20;
/// Steps to predict (5 s of video), or up to the end of an event that ends earlier.
pub const PREDICTED_STEPS: usize = 20;

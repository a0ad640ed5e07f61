//! Means over events, with confidence intervals.

use phase_model::random::{Purpose, stream};
use phase_statistics::{Interval, bootstrap_mean, mean};
use serde::{Deserialize, Serialize};

/// Number of bootstrap resamples for an interval.
pub const RESAMPLES: usize = 10_000;
/// The share of resampled means that lies in an interval.
pub const CONFIDENCE: f64 = 0.95;

/// A mean over events and its 95 % interval.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Estimate {
    /// The mean.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

impl Estimate {
    /// The mean of one number for each event, and the percentile bootstrap interval over events: as many
    /// events are drawn with replacement as there are, [`RESAMPLES`] times. `None` without events. The
    /// numbers must be finite.
    #[must_use]
    pub fn of(values: &[f64], seed: u64) -> Option<Self> {
        let mut random = stream(seed, Purpose::Bootstrap, 0);
        let Interval { low, high } = bootstrap_mean(values, RESAMPLES, CONFIDENCE, &mut random)?;
        Some(Self { value: mean(values)?, low, high })
    }

    /// The interval as a pair, as files have it beside the mean.
    #[must_use]
    pub const fn interval(&self) -> [f64; 2] {
        [self.low, self.high]
    }
}

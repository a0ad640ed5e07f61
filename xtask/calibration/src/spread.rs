//! Distributions of errors.

use phase_statistics::percentile;
use serde::Serialize;

/// The median and the upper tail of a distribution of errors.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct ErrorQuantiles {
    /// 50th percentile.
    pub median: f32,
    /// 90th percentile.
    pub p90: f32,
    /// Largest value.
    pub max: f32,
}

impl ErrorQuantiles {
    /// Of some values; `None` for none.
    #[must_use]
    pub fn of(values: &[f32]) -> Option<Self> {
        Some(Self {
            median: percentile(values, 50)?,
            p90: percentile(values, 90)?,
            max: percentile(values, 100)?,
        })
    }
}

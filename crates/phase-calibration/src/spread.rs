//! Percentiles by nearest rank.

use serde::Serialize;

/// The smallest of the values that at least a share of them (in hundredths, 0 to 100) do not exceed, so that
/// "the 90th percentile is at most x" means "nine in ten are at most x". `None` of no values. NaN counts as
/// greater than everything.
#[must_use]
pub fn percentile(values: &[f32], hundredths: usize) -> Option<f32> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f32::total_cmp);
    let rank = (sorted.len() * hundredths.min(100)).div_ceil(100);
    sorted.get(rank.saturating_sub(1)).copied()
}

/// The middle and the end of a distribution of errors.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Spread {
    /// 50th percentile.
    pub median: f32,
    /// 90th percentile.
    pub p90: f32,
    /// Largest value.
    pub max: f32,
}

impl Spread {
    /// Of some values; `None` of none.
    #[must_use]
    pub fn of(values: &[f32]) -> Option<Self> {
        Some(Self {
            median: percentile(values, 50)?,
            p90: percentile(values, 90)?,
            max: percentile(values, 100)?,
        })
    }
}

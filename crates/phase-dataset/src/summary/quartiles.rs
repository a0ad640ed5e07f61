//! Quartiles as the summary keeps them.

use phase_statistics::quartiles;
use serde::{Deserialize, Serialize};

/// The quartiles of a list of values, by nearest rank: each is one of the values.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quartiles {
    /// 25th percentile: at least a quarter of the values do not exceed it.
    pub p25: f32,
    /// 50th percentile; of an even number of values the lower of the two central ones.
    pub median: f32,
    /// 75th percentile.
    pub p75: f32,
}

impl Quartiles {
    /// Of a list of values; `None` if it is empty.
    #[must_use]
    pub fn of(numbers: &[f32]) -> Option<Self> {
        quartiles(numbers).map(|[p25, median, p75]| Self { p25, median, p75 })
    }
}

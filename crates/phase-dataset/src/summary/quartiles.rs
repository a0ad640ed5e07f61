//! Quartiles as the summary keeps them.

use phase_statistics::quartiles;
use serde::{Deserialize, Serialize};

/// The quartiles of some numbers, by nearest rank: each is one of the numbers.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quartiles {
    /// 25th percentile: at least a quarter of the numbers are no greater.
    pub p25: f32,
    /// 50th percentile; of an even number the lower of the two central ones.
    pub median: f32,
    /// 75th percentile.
    pub p75: f32,
}

impl Quartiles {
    /// Of some numbers; `None` of none.
    #[must_use]
    pub fn of(numbers: &[f32]) -> Option<Self> {
        quartiles(numbers).map(|[p25, median, p75]| Self { p25, median, p75 })
    }
}

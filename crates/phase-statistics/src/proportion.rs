//! How sure one may be after a few events, and how numbers spread.

use phase_calibration::percentile;
use serde::{Deserialize, Serialize};

/// 97.5 % quantile of the normal distribution.
const NORMAL_QUANTILE: f64 = 1.959_963_984_540_054;

/// The 95 % confidence interval of a rate after Wilson, from 0 to 1; (0, 1) without trials.
#[must_use]
pub fn wilson(successes: usize, trials: usize) -> (f64, f64) {
    if trials == 0 {
        return (0.0, 1.0);
    }
    let (n, square) = (trials as f64, NORMAL_QUANTILE * NORMAL_QUANTILE);
    let rate = successes.min(trials) as f64 / n;
    let middle = rate + square / (2.0 * n);
    let half = NORMAL_QUANTILE * libm::sqrt(rate * (1.0 - rate) / n + square / (4.0 * n * n));
    let scale = 1.0 + square / n;
    (((middle - half) / scale).max(0.0), ((middle + half) / scale).min(1.0))
}

/// The middle of some numbers, the mean of the two in the middle if they are even in number.
#[must_use]
pub fn median(numbers: &[usize]) -> Option<f64> {
    let mut sorted = numbers.to_vec();
    sorted.sort_unstable();
    let upper = *sorted.get(sorted.len() / 2)?;
    let lower = if sorted.len().is_multiple_of(2) { sorted[sorted.len() / 2 - 1] } else { upper };
    Some((lower as f64 + upper as f64) / 2.0)
}

/// The quartiles of some numbers, by nearest rank: each is one of the numbers.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quartiles {
    /// 25th percentile: a quarter of the numbers are no greater.
    pub p25: f32,
    /// 50th percentile; of an even number the lower of the two in the middle.
    pub median: f32,
    /// 75th percentile.
    pub p75: f32,
}

impl Quartiles {
    /// Of some numbers; `None` of none.
    #[must_use]
    pub fn of(numbers: &[f32]) -> Option<Self> {
        Some(Self {
            p25: percentile(numbers, 25)?,
            median: percentile(numbers, 50)?,
            p75: percentile(numbers, 75)?,
        })
    }
}

/// Fisher's exact test, one-sided: how likely it is that the first of two groups has so many successes or more
/// if both have the same rate. Each group is (successes, trials).
#[must_use]
pub fn fisher(first: (usize, usize), second: (usize, usize)) -> f64 {
    let (a, n) = (first.0.min(first.1), first.1);
    let (b, m) = (second.0.min(second.1), second.1);
    let successes = a + b;
    let ways = |k: usize| {
        let rest = successes.checked_sub(k).filter(|&rest| rest <= m);
        rest.map_or(0.0, |rest| libm::exp(ln_choose(n, k) + ln_choose(m, rest) - ln_choose(n + m, successes)))
    };
    (a..=n.min(successes)).map(ways).sum::<f64>().min(1.0)
}

fn ln_choose(n: usize, k: usize) -> f64 {
    let factorial = |n: usize| libm::lgamma(n as f64 + 1.0);
    factorial(n) - factorial(k) - factorial(n - k)
}

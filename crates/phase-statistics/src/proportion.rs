//! Confidence intervals of proportions.

use crate::Interval;

/// 97.5 % quantile of the standard normal distribution.
const NORMAL_QUANTILE: f64 = 1.959_963_984_540_054;

/// The 95 % score interval of a proportion, without continuity correction, 0 to 1; from 0 to 1 without
/// trials. More successes than trials count as all of them.
///
/// Wilson, *Probable Inference, the Law of Succession, and Statistical Inference* (JASA 22, 1927); method 3
/// of Newcombe, *Two-sided confidence intervals for the single proportion* (Statistics in Medicine 17, 1998).
#[must_use]
pub fn wilson_interval(successes: usize, trials: usize) -> Interval {
    if trials == 0 {
        return Interval { low: 0.0, high: 1.0 };
    }
    let n = trials as f64;
    let square = NORMAL_QUANTILE * NORMAL_QUANTILE;
    let rate = successes.min(trials) as f64 / n;
    let middle = rate + square / (2.0 * n);
    let half = NORMAL_QUANTILE * libm::sqrt(rate * (1.0 - rate) / n + square / (4.0 * n * n));
    let scale = 1.0 + square / n;
    Interval { low: ((middle - half) / scale).max(0.0), high: ((middle + half) / scale).min(1.0) }
}

//! Intervals without assumptions about the distribution.

use crate::Interval;
use rand::{Rng, RngExt};

/// The percentile bootstrap interval of a mean (Efron and Tibshirani, *An Introduction to the Bootstrap*,
/// 1993, chapter 13): `resamples` samples of the original size are drawn with replacement, and the interval
/// is the central share `confidence` (0 to 1, such as 0.95) of their means. The values must be finite. `None`
/// without values or without resamples.
#[must_use]
pub fn bootstrap_mean<R: Rng>(
    values: &[f64],
    resamples: usize,
    confidence: f64,
    random: &mut R,
) -> Option<Interval> {
    let count = values.len();
    if count == 0 || resamples == 0 {
        return None;
    }
    let mut draw = || (0..count).map(|_| values[random.random_range(0..count)]).sum::<f64>();
    let mut means: Vec<f64> = (0..resamples).map(|_| draw() / count as f64).collect();
    means.sort_by(f64::total_cmp);
    let outside = ((1.0 - confidence) / 2.0 * resamples as f64).round() as usize;
    let outside = outside.min((resamples - 1) / 2);
    Some(Interval { low: means[outside], high: means[resamples - 1 - outside] })
}

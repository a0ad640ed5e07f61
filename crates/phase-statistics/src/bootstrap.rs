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
    let mean = |sample: &[usize]| {
        let sum: f64 = sample.iter().map(|&k| values[k]).sum();
        Some(sum / values.len() as f64)
    };
    bootstrap(values.len(), resamples, confidence, random, mean)
}

/// The percentile bootstrap interval of any statistic of `count` items, given the indices of a resample.
/// Resamples for which the statistic is not defined are left out; `None` if it is for none.
#[must_use]
pub fn bootstrap<R: Rng>(
    count: usize,
    resamples: usize,
    confidence: f64,
    random: &mut R,
    mut statistic: impl FnMut(&[usize]) -> Option<f64>,
) -> Option<Interval> {
    if count == 0 {
        return None;
    }
    let mut sample = vec![0; count];
    let mut values = Vec::with_capacity(resamples);
    for _ in 0..resamples {
        sample.iter_mut().for_each(|place| *place = random.random_range(0..count));
        values.extend(statistic(&sample));
    }
    central(values, confidence)
}

/// The percentile bootstrap interval of the difference of two means, `one` less `other`: both samples are
/// drawn independently. `None` if either is empty.
#[must_use]
pub fn bootstrap_difference<R: Rng>(
    one: &[f64],
    other: &[f64],
    resamples: usize,
    confidence: f64,
    random: &mut R,
) -> Option<Interval> {
    if one.is_empty() || other.is_empty() {
        return None;
    }
    let mut mean = |values: &[f64]| {
        let sum: f64 = values.iter().map(|_| values[random.random_range(0..values.len())]).sum();
        sum / values.len() as f64
    };
    central((0..resamples).map(|_| mean(one) - mean(other)).collect(), confidence)
}

/// The interval that holds the central share of values.
fn central(mut values: Vec<f64>, confidence: f64) -> Option<Interval> {
    values.sort_by(f64::total_cmp);
    let last = values.len().checked_sub(1)?;
    let outside = ((1.0 - confidence) / 2.0 * values.len() as f64).round() as usize;
    let outside = outside.min(last / 2);
    Some(Interval { low: values[outside], high: values[last - outside] })
}

//! Quantiles.
//!
//! Hyndman and Fan, *Sample Quantiles in Statistical Packages* (The American Statistician 50(4), 1996), list
//! nine definitions. Two are used here; they differ for samples of even size: [`percentile`] is their
//! definition 1, and [`median`] averages the two central values, as most of their definitions do at one half.

/// The percentile by nearest rank (Hyndman and Fan's definition 1, `inverted_cdf` in NumPy): the smallest
/// value that is not exceeded by at least the given share of the values (in hundredths, 0 to 100; more counts
/// as 100). So "the 90th percentile is at most x" means "at least 90 % of the values are at most x", and it
/// is always one of the values. `None` for an empty slice. NaN counts as larger than every number.
#[must_use]
pub fn percentile(values: &[f32], hundredths: usize) -> Option<f32> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f32::total_cmp);
    let rank = (sorted.len() * hundredths.min(100)).div_ceil(100);
    sorted.get(rank.saturating_sub(1)).copied()
}

/// The 25th, 50th and 75th [`percentile`], by nearest rank; `None` for an empty slice. For an even number of
/// values the second is the lower of the two central ones, unlike [`median`].
#[must_use]
pub fn quartiles(values: &[f32]) -> Option<[f32; 3]> {
    Some([percentile(values, 25)?, percentile(values, 50)?, percentile(values, 75)?])
}

/// The conventional median of counts: the central value, or the mean of the two central values if their
/// number is even. `None` for an empty slice.
#[must_use]
pub fn median(values: &[usize]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable();
    let upper = *sorted.get(sorted.len() / 2)?;
    let lower = if sorted.len().is_multiple_of(2) { sorted[sorted.len() / 2 - 1] } else { upper };
    Some((lower as f64 + upper as f64) / 2.0)
}

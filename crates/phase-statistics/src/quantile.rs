//! Quantiles.
//!
//! Hyndman and Fan, *Sample Quantiles in Statistical Packages* (The American Statistician 50(4), 1996), list nine
//! definitions. Two are in use here and differ for samples of even size: [`percentile`] is their definition 1, and
//! [`median`] averages the two central values, as most of their definitions do at one half.

/// The percentile by nearest rank (Hyndman and Fan's definition 1, `inverted_cdf` in NumPy): the smallest of the
/// values that at least a share of them (in hundredths, 0 to 100; more counts as 100) do not exceed. So "the 90th
/// percentile is at most x" means "at least 90 % of the values are at most x", and it is always one of the values.
/// `None` of no values. NaN counts as greater than everything.
#[must_use]
pub fn percentile(values: &[f32], hundredths: usize) -> Option<f32> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f32::total_cmp);
    let rank = (sorted.len() * hundredths.min(100)).div_ceil(100);
    sorted.get(rank.saturating_sub(1)).copied()
}

/// The 25th, 50th and 75th [`percentile`], by nearest rank; `None` of no values. Of an even number of values the
/// second is the lower of the two central ones, unlike [`median`].
#[must_use]
pub fn quartiles(values: &[f32]) -> Option<[f32; 3]> {
    Some([percentile(values, 25)?, percentile(values, 50)?, percentile(values, 75)?])
}

/// The conventional median of counts: the central value, or the mean of the two central values if they are even in
/// number. `None` of no values.
#[must_use]
pub fn median(values: &[usize]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable();
    let upper = *sorted.get(sorted.len() / 2)?;
    let lower = if sorted.len().is_multiple_of(2) { sorted[sorted.len() / 2 - 1] } else { upper };
    Some((lower as f64 + upper as f64) / 2.0)
}

//! Correlations of two series.

/// A series whose standard deviation is smaller than this share of its greatest value is constant but for
/// rounding errors.
const ROUNDING: f64 = 1e-12;

/// Pearson's product-moment correlation, −1 to 1. `None` if the series differ in length, have fewer than two
/// values, or one of them is constant.
#[must_use]
pub fn pearson(first: &[f64], second: &[f64]) -> Option<f64> {
    if first.len() != second.len() || first.len() < 2 {
        return None;
    }
    let count = first.len() as f64;
    let mean = |values: &[f64]| values.iter().sum::<f64>() / count;
    let first_mean = mean(first);
    let second_mean = mean(second);
    let mut product = 0.0;
    let mut first_square = 0.0;
    let mut second_square = 0.0;
    for (a, b) in first.iter().zip(second) {
        let a = a - first_mean;
        let b = b - second_mean;
        product += a * b;
        first_square += a * a;
        second_square += b * b;
    }
    let greatest = |values: &[f64]| values.iter().fold(0.0_f64, |greatest, value| greatest.max(value.abs()));
    let varies = |square: f64, values: &[f64]| libm::sqrt(square / count) > ROUNDING * greatest(values);
    let scale = libm::sqrt(first_square) * libm::sqrt(second_square);
    // The last also fails for values that are not finite.
    let defined = varies(first_square, first) && varies(second_square, second) && scale.is_finite();
    defined.then(|| (product / scale).clamp(-1.0, 1.0))
}

/// Spearman's rank correlation, −1 to 1: [`pearson`] of the ranks, where equal values share the mean of their
/// ranks. `None` if the series differ in length, have fewer than two values, or one of them is constant.
#[must_use]
pub fn spearman(first: &[f64], second: &[f64]) -> Option<f64> {
    pearson(&ranks(first), &ranks(second))
}

/// The Spearman–Brown prediction: the reliability of a whole of which two halves correlate by `correlation`
/// (above −1).
#[must_use]
pub fn spearman_brown(correlation: f64) -> f64 {
    2.0 * correlation / (1.0 + correlation)
}

/// Ranks from 1; equal values share the mean of theirs.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut ranks = vec![0.0; values.len()];
    let mut from = 0;
    while from < order.len() {
        let same = order[from..].iter().take_while(|&&k| values[k] == values[order[from]]).count().max(1);
        let mean = from as f64 + (same as f64 + 1.0) / 2.0;
        for &k in &order[from..from + same] {
            ranks[k] = mean;
        }
        from += same;
    }
    ranks
}

#[cfg(test)]
mod tests {
    use super::{pearson, ranks, spearman, spearman_brown};

    /// Anscombe's quartet: four samples with the same correlation, 0.816.
    #[test]
    fn anscombes_first_sample() {
        let x = [10.0, 8.0, 13.0, 9.0, 11.0, 14.0, 6.0, 4.0, 12.0, 7.0, 5.0];
        let y = [8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68];
        assert!((pearson(&x, &y).expect("a correlation") - 0.816_420_5).abs() < 1e-6);
        // 1 − 6 Σ d² / (n (n² − 1)) with Σ d² = 40 by hand.
        assert!((spearman(&x, &y).expect("a correlation") - (1.0 - 240.0 / 1320.0)).abs() < 1e-12);
    }

    #[test]
    fn equal_values_share_their_ranks() {
        assert_eq!(ranks(&[2.0, 1.0, 2.0, 5.0, 2.0]), [3.0, 1.0, 3.0, 5.0, 3.0]);
        assert!((spearman(&[1.0, 2.0, 3.0], &[1.0, 8.0, 27.0]).expect("a correlation") - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_has_no_correlation_has_none() {
        assert_eq!(pearson(&[1.0, 1.0], &[1.0, 2.0]), None);
        // Thirds that differ by rounding errors alone.
        assert_eq!(pearson(&[1.0 / 3.0, 1.0 - 2.0 / 3.0], &[1.0, 2.0]), None);
        assert_eq!(pearson(&[1.0], &[1.0]), None);
        assert_eq!(pearson(&[1.0, 2.0], &[1.0]), None);
        assert_eq!(pearson(&[1.0, f64::NAN], &[1.0, 2.0]), None);
        assert!((spearman_brown(0.5) - 2.0 / 3.0).abs() < 1e-12);
    }
}

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

/// Kendall's τ-b, −1 to 1: concordant less discordant pairs, over the geometric mean of the numbers of pairs
/// that are not tied in either series. `None` if the series differ in length, have fewer than two values, one
/// of them is constant, or a value is not finite.
///
/// Knight's algorithm: O(n log n).
#[must_use]
pub fn kendall(first: &[f64], second: &[f64]) -> Option<f64> {
    let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
    if first.len() != second.len() || first.len() < 2 || !finite(first) || !finite(second) {
        return None;
    }
    let mut order: Vec<usize> = (0..first.len()).collect();
    order.sort_by(|&a, &b| first[a].total_cmp(&first[b]).then(second[a].total_cmp(&second[b])));
    let pairs = |count: usize| (count * (count.saturating_sub(1)) / 2) as f64;
    let tied = |same: &dyn Fn(usize, usize) -> bool, order: &[usize]| -> f64 {
        order.chunk_by(|&a, &b| same(a, b)).map(|group| pairs(group.len())).sum()
    };
    let all = pairs(first.len());
    let tied_first = tied(&|a, b| first[a] == first[b], &order);
    let tied_both = tied(&|a, b| first[a] == first[b] && second[a] == second[b], &order);
    let mut by_second: Vec<f64> = order.iter().map(|&k| second[k]).collect();
    let exchanges = sort_counting(&mut by_second) as f64;
    let tied_second: f64 = by_second.chunk_by(|a, b| a == b).map(|group| pairs(group.len())).sum();
    let scale = libm::sqrt((all - tied_first) * (all - tied_second));
    (scale > 0.0)
        .then(|| ((all - tied_first - tied_second + tied_both - 2.0 * exchanges) / scale).clamp(-1.0, 1.0))
}

/// Sorts, and returns the number of pairs that were in the wrong order.
fn sort_counting(values: &mut [f64]) -> u64 {
    let middle = values.len() / 2;
    if middle == 0 {
        return 0;
    }
    let mut exchanges = sort_counting(&mut values[..middle]) + sort_counting(&mut values[middle..]);
    let mut sorted = Vec::with_capacity(values.len());
    let (mut left, mut right) = (0, middle);
    while left < middle && right < values.len() {
        if values[right] < values[left] {
            exchanges += (middle - left) as u64;
            sorted.push(values[right]);
            right += 1;
        } else {
            sorted.push(values[left]);
            left += 1;
        }
    }
    sorted.extend_from_slice(&values[left..middle]);
    sorted.extend_from_slice(&values[right..]);
    values.copy_from_slice(&sorted);
    exchanges
}

/// The semipartial correlation of ranks, −1 to 1: [`pearson`] of the ranks of `target` with the residuals of
/// a linear regression of the ranks of `model` on the ranks of `others`. `None` if lengths differ or all
/// residuals are 0.
#[must_use]
pub fn semipartial(target: &[f64], model: &[f64], others: &[Vec<f64>]) -> Option<f64> {
    if target.len() != model.len() || others.iter().any(|other| other.len() != model.len()) {
        return None;
    }
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    // Gram–Schmidt, twice, which is enough for orthogonality.
    let reduced = |values: &[f64], basis: &[Vec<f64>]| {
        let mut rest = centred(ranks(values));
        for axis in basis.iter().chain(basis) {
            let share = dot(&rest, axis);
            rest.iter_mut().zip(axis).for_each(|(value, axis)| *value -= share * axis);
        }
        rest
    };
    for other in others {
        let mut axis = reduced(other, &basis);
        let length = libm::sqrt(dot(&axis, &axis));
        // An axis that the others span adds nothing.
        if length > 1e-9 * axis.len() as f64 {
            axis.iter_mut().for_each(|value| *value /= length);
            basis.push(axis);
        }
    }
    let rest = reduced(model, &basis);
    if libm::sqrt(dot(&rest, &rest)) <= 1e-9 * rest.len() as f64 {
        return None;
    }
    pearson(&ranks(target), &rest)
}

fn centred(mut values: Vec<f64>) -> Vec<f64> {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    values.iter_mut().for_each(|value| *value -= mean);
    values
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
    use super::{kendall, pearson, ranks, semipartial, spearman, spearman_brown};
    use proptest::prelude::*;

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

    /// τ-b by its definition, over all pairs.
    fn kendall_by_pairs(x: &[f64], y: &[f64]) -> Option<f64> {
        let (mut agree, mut x_pairs, mut y_pairs) = (0.0, 0.0, 0.0);
        for i in 0..x.len() {
            for j in 0..i {
                let sign = |a: f64, b: f64| if a == b { 0.0 } else { (a - b).signum() };
                let (dx, dy) = (sign(x[i], x[j]), sign(y[i], y[j]));
                agree += dx * dy;
                x_pairs += dx * dx;
                y_pairs += dy * dy;
            }
        }
        let scale = libm::sqrt(x_pairs * y_pairs);
        (scale > 0.0).then_some(agree / scale)
    }

    proptest! {
        #[test]
        fn kendalls_tau_is_that_of_all_pairs(values in prop::collection::vec((0_u8..6, 0_u8..6), 2..40)) {
            let (x, y): (Vec<f64>, Vec<f64>) =
                values.iter().map(|&(x, y)| (f64::from(x), f64::from(y))).unzip();
            match (kendall(&x, &y), kendall_by_pairs(&x, &y)) {
                (Some(found), Some(wanted)) => prop_assert!((found - wanted).abs() < 1e-12),
                (found, wanted) => prop_assert_eq!(found, wanted),
            }
        }

        /// With one other series: (r_ym − r_yo r_mo) / √(1 − r_mo²), of the ranks.
        #[test]
        fn a_semipartial_correlation_of_three_follows_from_their_pairs(
            values in prop::collection::vec((-9.0_f64..9.0, -9.0_f64..9.0, -9.0_f64..9.0), 5..40)
        ) {
            let of = |k: fn(&(f64, f64, f64)) -> f64| values.iter().map(k).collect::<Vec<f64>>();
            let (y, m, o) = (of(|v| v.0), of(|v| v.1), of(|v| v.2));
            let r = |a: &[f64], b: &[f64]| spearman(a, b).unwrap();
            let (ym, yo, mo) = (r(&y, &m), r(&y, &o), r(&m, &o));
            prop_assume!(mo.abs() < 0.999);
            let wanted = (ym - yo * mo) / libm::sqrt(1.0 - mo * mo);
            prop_assert!((semipartial(&y, &m, &[o]).unwrap() - wanted).abs() < 1e-9);
        }
    }

    #[test]
    fn what_others_determine_has_no_semipartial_correlation() {
        let model = [1.0, 2.0, 3.0, 4.0];
        assert_eq!(semipartial(&[2.0, 1.0, 4.0, 3.0], &model, &[model.to_vec()]), None);
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

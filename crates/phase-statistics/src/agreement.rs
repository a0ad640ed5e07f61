//! Agreement between raters.

use std::collections::BTreeMap;

/// Krippendorff's α for nominal data, `units` being the values that the raters of each unit gave (any number of raters, in any
/// order): 1 − D_o / D_e, with the coincidences of values within units and of all values (Krippendorff, *Content Analysis*, 4th
/// edition, 2018, chapter 12; the same author's *Computing Krippendorff's Alpha-Reliability*, 2011). 1 is complete agreement,
/// 0 that of raters who draw from all values, below 0 less than that. Units with fewer than two values do not count.
///
/// `None` if fewer than two values are left, or all of them are equal, for then there is nothing to agree about.
#[must_use]
pub fn krippendorff_alpha<T: Ord>(units: &[Vec<T>]) -> Option<f64> {
    let mut totals = BTreeMap::<&T, f64>::new();
    let (mut count, mut observed) = (0.0, 0.0);
    for unit in units.iter().filter(|unit| unit.len() > 1) {
        let mut counts = BTreeMap::<&T, f64>::new();
        unit.iter().for_each(|value| *counts.entry(value).or_default() += 1.0);
        let raters = unit.len() as f64;
        // Ordered pairs of different values, each pair weighing 1 / (m − 1).
        let equal: f64 = counts.values().map(|number| number * (number - 1.0)).sum();
        observed += (raters * (raters - 1.0) - equal) / (raters - 1.0);
        count += raters;
        for (value, number) in counts {
            *totals.entry(value).or_default() += number;
        }
    }
    let equal: f64 = totals.values().map(|number| number * (number - 1.0)).sum();
    let expected = (count * (count - 1.0) - equal) / (count - 1.0);
    (totals.len() > 1).then_some(1.0 - observed / expected)
}

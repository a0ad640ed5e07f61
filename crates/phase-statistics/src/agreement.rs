//! Agreement between raters.

/// Krippendorff's α for nominal data. A unit has the number of raters who gave each value; units may have
/// different numbers of raters, and all have the same values: 1 − D_o / D_e, with the coincidences of values
/// within units and of all values (Krippendorff, *Content Analysis*, 4th edition, 2018, chapter 12; the same
/// author's *Computing Krippendorff's Alpha-Reliability*, 2011). 1 is complete agreement, 0 that of raters
/// who draw from all values, below 0 less than that. Units with fewer than two raters do not count.
///
/// `None` if there are no such units, or all raters gave the same value, for then there is nothing to agree
/// about.
#[must_use]
pub fn krippendorff_alpha<'a>(units: impl IntoIterator<Item = &'a [usize]>) -> Option<f64> {
    let mut totals = Vec::<f64>::new();
    let mut count = 0.0;
    let mut observed = 0.0;
    // Ordered pairs of equal values.
    let equal =
        |counts: &mut dyn Iterator<Item = f64>| counts.map(|number| number * (number - 1.0)).sum::<f64>();
    for unit in units {
        let raters = unit.iter().sum::<usize>() as f64;
        if raters < 2.0 {
            continue;
        }
        // Ordered pairs of different values, each pair weighing 1 / (m − 1).
        let within = equal(&mut unit.iter().map(|&number| number as f64));
        observed += (raters * (raters - 1.0) - within) / (raters - 1.0);
        count += raters;
        totals.resize(totals.len().max(unit.len()), 0.0);
        totals.iter_mut().zip(unit).for_each(|(total, &number)| *total += number as f64);
    }
    let expected = (count * (count - 1.0) - equal(&mut totals.iter().copied())) / (count - 1.0);
    (expected > 0.0).then_some(1.0 - observed / expected)
}

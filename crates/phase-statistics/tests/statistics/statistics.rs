//! Statistics compared with published tables and values derived from their definitions.

use phase_statistics::{
    Interval, bootstrap_difference, bootstrap_mean, fisher_exact_greater, krippendorff_alpha, mean, median,
    percentile, population_variance, quartiles, standard_error, wilson_interval,
};
use proptest::prelude::*;
use rand_pcg::Pcg64Mcg;

#[test]
fn wilson_intervals_are_those_of_published_tables() {
    // Newcombe (1998), Table I, method 3, and 8, 0 and 10 of 10 by the formula.
    let cases = [
        ((81, 263), (0.2553, 0.3662)),
        ((15, 148), (0.0624, 0.1605)),
        ((0, 20), (0.0, 0.1611)),
        ((1, 29), (0.0061, 0.1718)),
        ((8, 10), (0.4902, 0.9433)),
        ((0, 10), (0.0, 0.2775)),
        ((10, 10), (0.7225, 1.0)),
    ];
    for ((successes, trials), (low, high)) in cases {
        let found = wilson_interval(successes, trials);
        let near = (found.low - low).abs() < 6e-5 && (found.high - high).abs() < 6e-5;
        assert!(near, "{successes} of {trials}: {found:?}");
    }
    assert_eq!(wilson_interval(0, 0), Interval { low: 0.0, high: 1.0 });
}

#[test]
fn fisher_sums_hypergeometric_probabilities() {
    let cases = [
        // Fisher's tea-tasting experiment: 3 of 4 against 1 of 4, and all right.
        ((3, 4), (1, 4), 17.0 / 70.0),
        ((4, 4), (0, 4), 1.0 / 70.0),
        ((0, 4), (4, 4), 1.0),
        ((0, 0), (0, 0), 1.0),
        // (C(10,8) C(6,1) + C(10,9) C(6,0)) / C(16,9)
        ((8, 10), (1, 6), 280.0 / 11_440.0),
        // (C(8,6) C(5,1) + C(8,7) C(5,0)) / C(13,7)
        ((6, 8), (1, 5), 148.0 / 1_716.0),
    ];
    for (first, second, expected) in cases {
        let found = fisher_exact_greater(first, second);
        assert!((found - expected).abs() < 1e-9, "{first:?} {second:?}: {found}, not {expected}");
    }
}

#[test]
fn percentiles_are_by_nearest_rank() {
    let ten: Vec<f32> = (1..=10).rev().map(|k| k as f32).collect();
    let ten_more = [3.0, 6.0, 7.0, 8.0, 8.0, 10.0, 13.0, 15.0, 16.0, 20.0];
    // (values, hundredths, the smallest value that this share does not exceed)
    let cases: [(&[f32], usize, Option<f32>); 15] = [
        (&[], 50, None),
        (&[7.0], 0, Some(7.0)),
        (&[7.0], 99, Some(7.0)),
        (&[2.0, 1.0], 50, Some(1.0)),
        (&[3.0, 1.0, 2.0], 50, Some(2.0)),
        (&ten, 50, Some(5.0)),
        (&ten, 90, Some(9.0)),
        (&ten, 91, Some(10.0)),
        (&ten, 100, Some(10.0)),
        (&ten, 1000, Some(10.0)),
        (&[15.0, 20.0, 35.0, 40.0, 50.0], 5, Some(15.0)),
        (&[15.0, 20.0, 35.0, 40.0, 50.0], 40, Some(20.0)),
        (&ten_more, 25, Some(7.0)),
        (&ten_more, 50, Some(8.0)),
        (&ten_more, 75, Some(15.0)),
    ];
    for (values, hundredths, expected) in cases {
        assert_eq!(percentile(values, hundredths), expected, "{hundredths} of {values:?}");
    }
    // Nine good values out of eleven are less than nine in ten.
    let eleven = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0];
    assert_eq!(percentile(&eleven, 90), Some(1.0));
    assert!(percentile(&[f32::NAN, 1.0], 100).expect("a value").is_nan());
}

#[test]
fn quartiles_are_values_of_the_sample() {
    assert_eq!(quartiles(&[]), None);
    assert_eq!(quartiles(&[7.0]), Some([7.0, 7.0, 7.0]));
    assert_eq!(quartiles(&[4.0, 1.0, 3.0, 2.0]), Some([1.0, 2.0, 3.0]));
    assert_eq!(quartiles(&[5.0, 9.0, 1.0, 7.0, 3.0]), Some([3.0, 5.0, 7.0]));
}

#[test]
fn the_median_of_an_even_number_is_a_midpoint() {
    assert_eq!(median(&[]), None);
    assert_eq!(median(&[7]), Some(7.0));
    assert_eq!(median(&[9, 1, 4]), Some(4.0));
    assert_eq!(median(&[9, 1, 4, 5]), Some(4.5));
}

#[test]
fn the_variance_of_a_population_divides_by_its_size() {
    // Two squares of 4 and two of 16, by four.
    assert_eq!(population_variance(&[1.0, 3.0, 7.0, 9.0]), Some(10.0));
    assert_eq!(population_variance(&[3.0]), Some(0.0));
    assert_eq!(population_variance(&[]), None);
}

#[test]
fn a_mean_and_its_standard_error() {
    // The deviations from 5 are −3, −1, −1, −1, 0, 0, 2 and 4; their squares sum to 32.
    let sample = [2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0];
    assert_eq!(mean(&sample), Some(5.0));
    let error = standard_error(&sample).expect("eight values");
    assert!((error - (32.0_f64 / 7.0 / 8.0).sqrt()).abs() < 1e-15, "{error}");
    assert_eq!((mean(&[]), standard_error(&[]), standard_error(&[1.0])), (None, None, None));
}

#[test]
fn bootstrap_intervals_hold_the_central_resamples() {
    // Means of two draws from {0, 1} are 0, 1/2 and 1 with probabilities 1/4, 1/2 and 1/4.
    let interval = |confidence: f64| bootstrap_mean(&[0.0, 1.0], 10_000, confidence, &mut Pcg64Mcg::new(1));
    assert_eq!(interval(0.95), Some(Interval { low: 0.0, high: 1.0 }));
    assert_eq!(interval(0.4), Some(Interval { low: 0.5, high: 0.5 }));
    // A resampled share is binomial (100, 0.3) over 100, with quantiles 0.21 and 0.39 at 2.5 % and 97.5 %.
    let values: Vec<f64> = (0..100).map(|k| f64::from(u8::from(k < 30))).collect();
    for seed in 1..5 {
        let found = bootstrap_mean(&values, 10_000, 0.95, &mut Pcg64Mcg::new(seed)).expect("values");
        assert!((found.low - 0.21).abs() < 0.011 && (found.high - 0.39).abs() < 0.011, "{found:?}");
    }
}

#[test]
fn bootstrap_intervals_of_nothing_and_of_one_resample() {
    let bootstrap = |values: &[f64], resamples, confidence| {
        bootstrap_mean(values, resamples, confidence, &mut Pcg64Mcg::new(1))
    };
    assert_eq!(bootstrap(&[], 10, 0.95), None);
    assert_eq!(bootstrap(&[1.0], 0, 0.95), None);
    for confidence in [-1.0, 0.0, 0.95, 1.0, 2.0, f64::NAN] {
        assert_eq!(bootstrap(&[4.0], 1, confidence), Some(Interval { low: 4.0, high: 4.0 }));
    }
}

proptest! {
    #[test]
    fn an_interval_holds_its_rate(trials in 1_usize..200, share in 0.0_f64..=1.0) {
        let successes = (share * trials as f64) as usize;
        let rate = successes as f64 / trials as f64;
        let Interval { low, high } = wilson_interval(successes, trials);
        prop_assert!(0.0 <= low && low <= rate + 1e-12 && rate <= high + 1e-12 && high <= 1.0);
    }

    /// At least the requested share of the values does not exceed a percentile, and a smaller share is below
    /// it.
    #[test]
    fn percentiles_keep_their_promise(
        values in prop::collection::vec(-9.0_f32..9.0, 1..40),
        hundredths in 1_usize..=100,
    ) {
        let found = percentile(&values, hundredths).expect("values");
        let count = |which: &dyn Fn(f32) -> bool| 100 * values.iter().filter(|value| which(**value)).count();
        prop_assert!(count(&|value| value <= found) >= hundredths * values.len());
        prop_assert!(count(&|value| value < found) < hundredths * values.len());
    }
}

#[test]
fn krippendorffs_own_examples() {
    // Krippendorff, Computing Krippendorff's Alpha-Reliability (2011). A: two raters, ten units, two values.
    let first = [0, 1, 0, 0, 0, 0, 0, 0, 1, 0];
    let second = [1, 1, 1, 0, 0, 1, 0, 0, 0, 0];
    let units: Vec<[usize; 2]> = first.iter().zip(second).map(|(a, b)| [2 - a - b, a + b]).collect();
    let alpha = krippendorff_alpha(units.iter().map(|unit| &unit[..])).expect("values differ");
    assert!((alpha - 0.095).abs() < 5e-4, "{alpha}");

    // C: four raters, twelve units, five values, some missing (0).
    let raters = [
        [1, 2, 3, 3, 2, 1, 4, 1, 2, 0, 0, 0],
        [1, 2, 3, 3, 2, 2, 4, 1, 2, 5, 0, 3],
        [0, 3, 3, 3, 2, 3, 4, 2, 2, 5, 1, 0],
        [1, 2, 3, 3, 2, 4, 4, 1, 2, 5, 1, 0],
    ];
    let count = |k: usize, value: usize| raters.iter().filter(|rater| rater[k] == value).count();
    let units: Vec<[usize; 5]> = (0..12).map(|k| [1, 2, 3, 4, 5].map(|value| count(k, value))).collect();
    let alpha = krippendorff_alpha(units.iter().map(|unit| &unit[..])).expect("values differ");
    assert!((alpha - 0.743).abs() < 5e-4, "{alpha}");

    let of = |units: &[[usize; 2]]| krippendorff_alpha(units.iter().map(|unit| &unit[..]));
    assert_eq!(of(&[[2, 0], [0, 2]]), Some(1.0));
    assert_eq!(of(&[[2, 0], [2, 0]]), None);
    assert_eq!(of(&[]), None);
    assert_eq!(of(&[[1, 0], [0, 1]]), None);
}

#[test]
fn the_interval_of_a_difference() {
    let mut random = Pcg64Mcg::new(1);
    // Two samples of known spread: the difference of their means has the standard error √(1/400 + 4/400).
    let one: Vec<f64> = (0..400).map(|k| if k % 2 == 0 { 4.0 } else { 2.0 }).collect();
    let other: Vec<f64> = (0..400).map(|k| if k % 2 == 0 { 3.0 } else { -1.0 }).collect();
    let interval = bootstrap_difference(&one, &other, 10_000, 0.95, &mut random).expect("values");
    let half = 1.96 * (5.0_f64 / 400.0).sqrt();
    assert!(
        (interval.low - (2.0 - half)).abs() < 0.01 && (interval.high - (2.0 + half)).abs() < 0.01,
        "{interval:?}"
    );
    assert_eq!(bootstrap_difference(&[], &other, 10, 0.95, &mut random), None);
    assert_eq!(bootstrap_difference(&one, &[], 10, 0.95, &mut random), None);
}

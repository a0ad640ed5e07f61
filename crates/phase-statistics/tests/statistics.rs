//! Against published and hand-computed values.

use phase_evidence::statistics::{Quartiles, fisher, median, wilson};
use proptest::prelude::*;

#[test]
fn wilson_of_known_rates() {
    // 8 of 10: (0.4902, 0.9433); 0 of 10: (0, 0.2775); by the formula with z = 1.96.
    let cases = [((8, 10), (0.4902, 0.9433)), ((0, 10), (0.0, 0.2775)), ((10, 10), (0.7225, 1.0))];
    for ((successes, trials), (low, high)) in cases {
        let found = wilson(successes, trials);
        assert!((found.0 - low).abs() < 1e-4 && (found.1 - high).abs() < 1e-4, "{successes}: {found:?}");
    }
    assert_eq!(wilson(0, 0), (0.0, 1.0));
}

#[test]
fn fisher_of_known_tables() {
    // The lady tasting tea: 3 of 4 against 1 of 4 gives 17/70; all right gives 1/70.
    assert!((fisher((3, 4), (1, 4)) - 17.0 / 70.0).abs() < 1e-9);
    assert!((fisher((4, 4), (0, 4)) - 1.0 / 70.0).abs() < 1e-9);
    assert!((fisher((0, 4), (4, 4)) - 1.0).abs() < 1e-9);
    assert!((fisher((0, 0), (0, 0)) - 1.0).abs() < 1e-9);
}

#[test]
fn medians() {
    assert_eq!(median(&[]), None);
    assert_eq!(median(&[7]), Some(7.0));
    assert_eq!(median(&[9, 1, 4]), Some(4.0));
    assert_eq!(median(&[9, 1, 4, 5]), Some(4.5));
}

#[test]
fn quartiles_are_numbers_of_the_list() {
    let quartiles = |numbers: &[f32]| Quartiles::of(numbers).map(|it| (it.p25, it.median, it.p75));
    assert_eq!(quartiles(&[]), None);
    assert_eq!(quartiles(&[7.0]), Some((7.0, 7.0, 7.0)));
    assert_eq!(quartiles(&[4.0, 1.0, 3.0, 2.0]), Some((1.0, 2.0, 3.0)));
    assert_eq!(quartiles(&[5.0, 9.0, 1.0, 7.0, 3.0]), Some((3.0, 5.0, 7.0)));
}

proptest! {
    #[test]
    fn an_interval_holds_its_rate(trials in 1_usize..200, share in 0.0_f64..=1.0) {
        let successes = (share * trials as f64) as usize;
        let rate = successes as f64 / trials as f64;
        let (low, high) = wilson(successes, trials);
        prop_assert!(0.0 <= low && low <= rate + 1e-12 && rate <= high + 1e-12 && high <= 1.0);
    }
}

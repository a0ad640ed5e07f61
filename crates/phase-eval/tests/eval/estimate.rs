//! Bootstrap intervals, compared with known distributions.

use phase_eval::Estimate;

#[test]
fn without_spread_there_is_no_interval_and_without_events_no_mean() {
    let sure = Estimate::of(&[0.5; 9], 3).expect("events");
    assert_eq!((sure.value, sure.low, sure.high), (0.5, 0.5, 0.5));
    assert_eq!(Estimate::of(&[], 3), None);
}

#[test]
fn the_interval_of_a_share_is_that_of_the_binomial_distribution() {
    // 100 events, 30 of them correct: a resampled share is binomial (100, 0.3) over 100, whose 2.5 % and 97.5
    // % quantiles are 0.21 and 0.39; one step of 0.01 is the tolerance for the randomness of resampling.
    let values: Vec<f64> = (0..100).map(|k| if k < 30 { 1.0 } else { 0.0 }).collect();
    for seed in 0..5 {
        let estimate = Estimate::of(&values, seed).expect("events");
        assert!((estimate.value - 0.3).abs() < 1e-12);
        assert!((estimate.low - 0.21).abs() < 0.011 && (estimate.high - 0.39).abs() < 0.011, "{estimate:?}");
    }
}

#[test]
fn a_seed_makes_one_interval() {
    let values: Vec<f64> = (0..57).map(|k| f64::from(k * k % 13)).collect();
    assert_eq!(Estimate::of(&values, 1), Estimate::of(&values, 1));
    assert_ne!(Estimate::of(&values, 1), Estimate::of(&values, 2));
}

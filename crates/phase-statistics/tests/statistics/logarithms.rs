//! Probabilities and logarithms, compared with their definitions.

use phase_statistics::{entropy, log_softmax, log_sum_exp, logistic, softmax};
use proptest::prelude::*;

/// ln Σ eˣ as it is defined, for values whose exponentials are finite.
fn defined(logs: &[f64]) -> f64 {
    logs.iter().map(|log| log.exp()).sum::<f64>().ln()
}

proptest! {
    #[test]
    fn log_sum_exp_is_what_it_is_defined_as(logs in prop::collection::vec(-50.0..50.0, 1..20)) {
        let found = log_sum_exp(logs.iter().copied());
        prop_assert!((found - defined(&logs)).abs() < 1e-12 * (1.0 + found.abs()));
    }

    /// A constant added to all values is added to the result, however great it is.
    #[test]
    fn log_sum_exp_does_not_overflow(
        logs in prop::collection::vec(-5.0..5.0, 1..20),
        shift in -1e6..1e6_f64,
    ) {
        let shifted = log_sum_exp(logs.iter().map(|log| log + shift));
        prop_assert!((shifted - shift - defined(&logs)).abs() < 1e-8);
    }

    #[test]
    fn log_softmax_has_probabilities_that_sum_to_1(
        logs in prop::collection::vec(-5.0..5.0, 1..20),
        shift in -1e6..1e6_f64,
    ) {
        let whole = defined(&logs);
        let mut found: Vec<f64> = logs.iter().map(|log| log + shift).collect();
        log_softmax(&mut found);
        prop_assert!((found.iter().map(|log| log.exp()).sum::<f64>() - 1.0).abs() < 1e-12);
        for (found, log) in found.iter().zip(&logs) {
            prop_assert!((found - (log - whole)).abs() < 1e-8);
        }
    }

    #[test]
    fn softmax_is_the_exponential_of_log_softmax(a in -30.0..30.0, b in -30.0..30.0, c in -30.0..30.0) {
        let mut logs = [a, b, c];
        log_softmax(&mut logs);
        for (p, log) in softmax([a, b, c]).into_iter().zip(logs) {
            prop_assert!((p - log.exp()).abs() < 1e-12);
        }
    }

    /// Of two classes, the logistic function is the softmax.
    #[test]
    fn logistic_is_the_softmax_of_two_logits(x in -40.0..40.0) {
        let [_, p] = softmax([0.0, x]);
        prop_assert!((logistic(x) - p).abs() < 1e-12);
        prop_assert!((logistic(x) + logistic(-x) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn weights_that_are_all_zero_have_no_sum() {
    assert_eq!(log_sum_exp([]), f64::NEG_INFINITY);
    assert_eq!(log_sum_exp([f64::NEG_INFINITY; 2]), f64::NEG_INFINITY);
    assert_eq!(log_sum_exp([f64::NEG_INFINITY, 3.0]), 3.0);
    let mut logs = [f64::NEG_INFINITY; 2];
    log_softmax(&mut logs);
    assert_eq!(logs, [f64::NEG_INFINITY; 2]);
}

#[test]
fn extreme_arguments_have_limits() {
    assert_eq!([logistic(-1e4), logistic(0.0), logistic(1e4)], [0.0, 0.5, 1.0]);
    assert_eq!(softmax([1e6, 0.0]), [1.0, 0.0]);
}

#[test]
fn entropy_by_hand() {
    assert_eq!(entropy(&[1.0, 0.0]), 0.0);
    assert!((entropy(&[0.5, 0.5]) - 2.0_f64.ln()).abs() < 1e-15);
    assert!((entropy(&[0.5, 0.25, 0.25]) - 1.5 * 2.0_f64.ln()).abs() < 1e-15);
}

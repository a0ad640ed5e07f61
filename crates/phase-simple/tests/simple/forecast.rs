//! The shares of hypotheses in the weight of a forecast.

use phase_model::{Forecast, Vec2};
use phase_simple::{Continuation, ForecastSettings, Futures};

fn towards(x: f32) -> Forecast {
    vec![vec![Vec2::new(x, 0.0)]]
}

fn continuation(weight: f64, errors: &[f64], futures: &[f32]) -> Continuation {
    let futures = futures.iter().map(|&x| towards(x)).collect();
    Continuation { weight, hindcast_errors: errors.to_vec(), futures }
}

fn settings() -> ForecastSettings {
    ForecastSettings { hindcast_error_rate: 1.0, least_weight: 0.0, ..ForecastSettings::default() }
}

fn total(futures: &Futures) -> f64 {
    futures.paths.iter().map(|(_, weight)| weight).sum()
}

/// Without hindcasts the shares are the posterior's, whatever the number of futures.
#[test]
fn a_hypothesis_shares_its_weight_among_its_futures() {
    let found = [continuation(0.75, &[], &[1.0]), continuation(0.25, &[], &[2.0, 3.0])];
    let futures = Futures::of(&found, &settings());
    let shares: Vec<f64> = futures.paths.iter().map(|(_, weight)| weight / total(&futures)).collect();
    for (share, expected) in shares.iter().zip([0.75, 0.125, 0.125]) {
        assert!((share - expected).abs() < 1e-12, "{shares:?}");
    }
}

/// A hypothesis whose hindcasts err by one unit more loses a factor e at 1 nat/u.
#[test]
fn hindcasts_decide_between_equals() {
    let found = [continuation(0.5, &[1.0, 3.0], &[1.0]), continuation(0.5, &[1.0, 1.0], &[2.0])];
    let futures = Futures::of(&found, &settings());
    let ratio = futures.paths[1].1 / futures.paths[0].1;
    assert!((ratio - core::f64::consts::E).abs() < 1e-12, "{ratio}");
    // The geometric median of two places is the heavier one.
    assert!((futures.median()[0][0].x - 2.0).abs() < 1e-3);
}

#[test]
fn hypotheses_with_little_weight_are_left_out() {
    let found = [continuation(0.99, &[0.0], &[1.0]), continuation(0.01, &[0.0], &[2.0])];
    let kept = Futures::of(&found, &ForecastSettings { least_weight: 0.1, ..settings() });
    assert_eq!(kept.paths.len(), 1);
    assert_eq!(Futures::of(&found, &settings()).paths.len(), 2);
}

#[test]
fn hindcasts_begin_evenly_before_the_end() {
    let starts = |hindcasts, watched| ForecastSettings { hindcasts, ..settings() }.starts(watched);
    assert_eq!(starts(3, 20), [5, 10, 15]);
    assert_eq!(starts(0, 20), [0_usize; 0]);
    assert_eq!(starts(3, 1), [0]);
    assert_eq!(starts(3, 0), [0_usize; 0]);
}

//! Distributions of errors.

use phase_calibration::{Deviation, ErrorQuantiles, HorizonErrors, RunReport};

#[test]
fn spreads_and_horizons() {
    let values: Vec<f32> = (1..=200).map(|k| k as f32).collect();
    assert_eq!(ErrorQuantiles::of(&values), Some(ErrorQuantiles { median: 100.0, p90: 180.0, max: 200.0 }));
    assert_eq!(
        HorizonErrors::of(&values),
        Some(HorizonErrors { n: 200, median: 100.0, p90: 180.0, p99: 198.0 })
    );
    assert_eq!((ErrorQuantiles::of(&[]), HorizonErrors::of(&[])), (None, None));
}

#[test]
fn a_run_is_followed_until_it_is_first_lost() {
    let report = |positions: &[f32]| {
        let deviations: Vec<Deviation> =
            positions.iter().map(|&position| Deviation { position, angle: 0.0 }).collect();
        RunReport::of("run", &deviations, None)
    };
    for (positions, within) in
        [(&[0.1, 0.5, 0.51, 0.1][..], 2), (&[0.6, 0.0], 0), (&[0.0, 0.5], 2), (&[0.0, f32::INFINITY], 1)]
    {
        assert_eq!(report(positions).expect("steps").steps_within_0_5, within, "{positions:?}");
    }
    assert_eq!(report(&[]), None);
}

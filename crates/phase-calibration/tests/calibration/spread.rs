use phase_calibration::{Ahead, Deviation, RunReport, Spread, percentile};

#[test]
fn percentiles_are_by_nearest_rank() {
    let ten: Vec<f32> = (1..=10).rev().map(|k| k as f32).collect();
    // (values, hundredths, the smallest value that so many do not exceed)
    let cases: [(&[f32], usize, Option<f32>); 10] = [
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
fn spreads_and_horizons() {
    let values: Vec<f32> = (1..=200).map(|k| k as f32).collect();
    assert_eq!(Spread::of(&values), Some(Spread { median: 100.0, p90: 180.0, max: 200.0 }));
    assert_eq!(Ahead::of(&values), Some(Ahead { n: 200, median: 100.0, p90: 180.0, p99: 198.0 }));
    assert_eq!((Spread::of(&[]), Ahead::of(&[])), (None, None));
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

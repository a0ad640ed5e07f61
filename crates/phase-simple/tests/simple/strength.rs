//! Strength from motion: features and the network's arithmetic by hand, and invalid input.

use phase_model::{AgentBody, AgentId, Body, MAX_ENTITIES, Size, Strength, Vec2, physics::GROUND_FRICTION};
use phase_simple::{
    StrengthCue, StrengthRegressor,
    strength::{FEATURES, STRENGTH_FORMAT, Weights, WeightsError, features},
};
use phase_tensors::{Dense, TensorsError};
use proptest::prelude::*;

/// Rows in which agent 1 has these velocities and everything else rests.
fn motion(velocities: &[(f32, f32)]) -> Vec<[Body; MAX_ENTITIES]> {
    let row = |&(x, y): &(f32, f32)| {
        let mut row = [Body::default(); MAX_ENTITIES];
        row[1].velocity = Vec2::new(x, y);
        row
    };
    velocities.iter().map(row).collect()
}

/// Two hidden numbers: how much the mean speed is above 1 u/s, in halves, and how much it is below; then
/// their sum and twice the first less the second; then 10 N a unit of the former, 1 N a unit of the latter,
/// from 100 N.
fn tiny() -> Weights {
    let row = |first: f32| {
        let mut row = vec![0.0; FEATURES];
        row[0] = first;
        row
    };
    Weights {
        mean: row(1.0),
        scale: vec![0.5; FEATURES],
        hidden: [
            Dense {
                inputs: FEATURES,
                outputs: 2,
                weight: [row(1.0), row(-1.0)].concat(),
                bias: vec![0.0; 2],
            },
            Dense { inputs: 2, outputs: 2, weight: vec![1.0, 1.0, 2.0, -1.0], bias: vec![0.0, 0.5] },
        ],
        output: Dense { inputs: 2, outputs: 1, weight: vec![10.0, 1.0], bias: vec![100.0] },
        rmse: 150.0,
    }
}

#[test]
fn features_of_a_small_motion() {
    // Speeds 0, 3, 5; changes of velocity (3, 0) and (0, 4) in a twelfth of a second.
    let rows = motion(&[(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)]);
    let expected = [8.0 / 3.0, 5.0, 0.0, 42.0, 48.0, 36.0, f64::from(1.2_f32)];
    for (action_likelihoods, expected) in features(&rows, AgentId::ONE, Size::Large).into_iter().zip(expected)
    {
        assert!((action_likelihoods - expected).abs() < 1e-5, "{action_likelihoods} is not {expected}");
    }
    let resting = features(&rows, AgentId::ZERO, Size::Small);
    assert_eq!(resting, [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, f64::from(0.8_f32)]);
}

#[test]
fn too_few_rows_give_zeros() {
    let radius = f64::from(1.6_f32);
    assert_eq!(
        features(&motion(&[(0.0, -2.0)]), AgentId::ONE, Size::Huge),
        [2.0, 2.0, 2.0, 0.0, 0.0, 0.0, radius]
    );
    assert_eq!(features(&[], AgentId::ONE, Size::Huge), [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, radius]);
}

#[test]
fn the_network_by_hand() {
    let regressor = StrengthRegressor::new(tiny()).unwrap();
    // Speed 3: standardised 4; hidden 4 and 0; then 4 and 8.5; 100 + 40 + 8.5.
    assert_eq!(regressor.estimate(&motion(&[(3.0, 0.0)]), AgentId::ONE, Size::Small), 148.5);
    // Speed 0: standardised −2; hidden 0 and 2; then 2 and −1.5, of which 0 is left; 100 + 20.
    assert_eq!(regressor.estimate(&motion(&[(0.0, 0.0)]), AgentId::ONE, Size::Small), 120.0);
}

#[test]
fn levels_under_the_normal_distribution_by_hand() {
    let mut weights = tiny();
    weights.output.bias = vec![251.5];
    let regressor = StrengthRegressor::new(weights).unwrap();
    // The estimate is 300 N, the spread a level: exponents −½, 0, −½ and −2.
    let logs = regressor.log_proposal(&motion(&[(3.0, 0.0)]), AgentId::ONE, Size::Small);
    let sum = 1.0 + 2.0 * (-0.5_f64).exp() + (-2.0_f64).exp();
    for (log, exponent) in logs.into_iter().zip([-0.5, 0.0, -0.5, -2.0]) {
        assert!((log - (exponent - sum.ln())).abs() < 1e-12);
    }
}

#[test]
fn what_is_no_number_says_nothing() {
    let regressor = StrengthRegressor::new(tiny()).unwrap();
    for speed in [f32::NAN, f32::INFINITY, f32::MAX] {
        let logs = regressor.log_proposal(&motion(&[(speed, 0.0), (0.0, speed)]), AgentId::ONE, Size::Small);
        let sum: f64 = logs.iter().map(|log| log.exp()).sum();
        assert!((sum - 1.0).abs() < 1e-9, "{speed}: {logs:?}");
    }
}

#[test]
fn weights_that_break_a_rule_are_refused() {
    type Break = fn(&mut Weights);
    let cases: [(Break, &str); 12] = [
        (|weights| weights.mean.truncate(3), "tensor `input.mean` must have the shape [7], not [3]"),
        (|weights| weights.scale.push(1.0), "tensor `input.scale` must have the shape [7], not [8]"),
        (|weights| weights.scale[2] = 0.0, "tensor `input.scale` must hold numbers above 0"),
        (|weights| weights.mean[6] = f32::NAN, "tensor `input.mean` must hold finite numbers"),
        (
            |weights| weights.hidden[0].inputs = 6,
            "tensor `hidden1.weight` must have the shape [2, 7], not [2, 6]",
        ),
        (
            |weights| weights.hidden[1].inputs = 3,
            "tensor `hidden2.weight` must have the shape [2, 2], not [2, 3]",
        ),
        (
            |weights| weights.hidden[1].weight.truncate(3),
            "tensor `hidden2.weight` must have the shape [4], not [3]",
        ),
        (
            |weights| weights.hidden[1].bias.truncate(1),
            "tensor `hidden2.bias` must have the shape [2], not [1]",
        ),
        (
            |weights| weights.output.outputs = 2,
            "tensor `output.weight` must have the shape [1, 2], not [2, 2]",
        ),
        (|weights| weights.output.bias[0] = f32::INFINITY, "tensor `output.bias` must hold finite numbers"),
        (|weights| weights.rmse = -1.0, "tensor `validation.rmse` must hold numbers above 0"),
        (
            |weights| {
                weights.hidden[0] =
                    Dense { inputs: FEATURES, outputs: 0, weight: Vec::new(), bias: Vec::new() };
            },
            "tensor `hidden1.weight` must have the shape [1, 7], not [0, 7]",
        ),
    ];
    for (broken, expected) in cases {
        let mut weights = tiny();
        broken(&mut weights);
        assert_eq!(StrengthRegressor::new(weights).unwrap_err().to_string(), expected);
    }
}

#[test]
fn a_file_gives_back_what_was_written() {
    let regressor = StrengthRegressor::new(tiny()).unwrap();
    let bytes = regressor.to_safetensors().unwrap();
    assert_eq!(bytes, regressor.to_safetensors().unwrap());
    assert_eq!(StrengthRegressor::from_safetensors(&bytes).unwrap(), regressor);
}

#[test]
fn the_shipped_regressor_tells_weak_from_mighty() {
    let regressor = StrengthRegressor::bundled().unwrap();
    let [first, second] = &regressor.weights().hidden;
    assert_eq!((first.outputs, second.outputs), (64, 64), "the paper's sizes");
    // An errand in the way agents run them: ten times three steps of pushing against 100 N of friction, then
    // a stop to turn for as long.
    for size in Size::ALL {
        let run = |strength: Strength| {
            let body = AgentBody { radius: size.radius(), max_force: strength.max_force() };
            let gained = (body.max_force - GROUND_FRICTION) / body.mass() / 12.0;
            let pushed = |step: u8| if step % 6 < 4 { f32::from(step % 6) } else { 0.0 };
            motion(&(0..=60).map(|step| (gained * pushed(step), 0.0)).collect::<Vec<_>>())
        };
        let estimate = |strength| regressor.estimate(&run(strength), AgentId::ONE, size);
        let weak = estimate(Strength::Weak);
        let mighty = estimate(Strength::Mighty);
        assert!(weak + 100.0 < mighty, "{size:?}: {weak} N and {mighty} N");
    }
}

#[test]
fn files_of_another_kind_are_refused() {
    let bytes = StrengthRegressor::new(tiny()).unwrap().to_safetensors().unwrap();
    // Of the same length, so that the rest of the file stays where it is.
    let replaced = |from: &str, to: &str| {
        let at = bytes.windows(from.len()).position(|part| part == from.as_bytes()).unwrap();
        let mut bytes = bytes.clone();
        bytes[at..at + to.len()].copy_from_slice(to.as_bytes());
        StrengthRegressor::from_safetensors(&bytes).unwrap_err()
    };
    let cases = [
        (STRENGTH_FORMAT, "phase-strength/9", format!("field `format` must be {STRENGTH_FORMAT:?}")),
        ("hidden2.bias", "hidden9.bias", "tensor `hidden2.bias` is missing".into()),
        ("F32", "I32", format!("tensor `{}` must hold 32-bit floats", first_tensor(&bytes))),
    ];
    for (from, to, expected) in cases {
        assert_eq!(replaced(from, to).to_string(), expected);
    }
    for length in [0, 7, 8, 20, bytes.len() - 1] {
        let error = StrengthRegressor::from_safetensors(&bytes[..length]).unwrap_err();
        assert!(matches!(error, WeightsError::Tensors(TensorsError::Container(_))), "{length}: {error}");
    }
}

/// The tensor that the file names first.
fn first_tensor(bytes: &[u8]) -> String {
    let header = String::from_utf8_lossy(&bytes[8..]).into_owned();
    let before = header.split(":{\"dtype\"").next().unwrap_or_default().to_owned();
    before.rsplit('"').nth(1).unwrap_or_default().to_owned()
}

proptest! {
    // Keep no file of past failures beside the tests.
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_files_never_panic(at in 0_usize..900, byte: u8) {
        let mut bytes = StrengthRegressor::new(tiny()).unwrap().to_safetensors().unwrap();
        let at = at % bytes.len();
        bytes[at] = byte;
        if let Ok(regressor) = StrengthRegressor::from_safetensors(&bytes) {
            let logs = regressor.log_proposal(&motion(&[(3.0, 0.0), (1.0, 1.0)]), AgentId::ONE, Size::Small);
            let sum: f64 = logs.iter().map(|log| log.exp()).sum();
            prop_assert!((sum - 1.0).abs() < 1e-9, "{logs:?}");
        }
    }
}

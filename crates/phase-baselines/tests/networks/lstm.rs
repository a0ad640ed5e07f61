//! The LSTM by itself.

use crate::support::{difference, random};
use candle_core::{Device, Tensor, Var};
use phase_baselines::lstm::Lstm;
use std::sync::Arc;

const ROWS: usize = 3;
const INPUTS: usize = 2;
const SIZE: usize = 4;

fn inputs(steps: usize) -> Vec<Tensor> {
    (0..steps)
        .map(|step| {
            let values: Vec<f32> =
                (0..ROWS * INPUTS).map(|k| ((7 * step + 3 * k) % 5) as f32 * 0.4 - 0.8).collect();
            Tensor::from_vec(values, (ROWS, INPUTS), &Device::Cpu).expect("numbers")
        })
        .collect()
}

fn sigmoid(number: f64) -> f64 {
    1.0 / (1.0 + (-number).exp())
}

#[test]
fn a_step_by_hand() {
    let lstm = Lstm::new(INPUTS, SIZE, &mut random(0)).unwrap();
    let [input, next] = &inputs(2)[..] else { unreachable!() };
    let before = lstm.step(input, &lstm.start(ROWS).unwrap(), None).unwrap();
    let after = lstm.step(next, &before, None).unwrap();
    let parameters = lstm.parameters("lstm");
    let weight: Vec<Vec<f32>> = parameters[0].1.to_vec2().unwrap();
    let bias: Vec<f32> = parameters[1].1.to_vec1().unwrap();
    let (next, before): (Vec<Vec<f32>>, Vec<Vec<f32>>) = (next.to_vec2().unwrap(), before.to_vec2().unwrap());
    let after: Vec<Vec<f32>> = after.to_vec2().unwrap();
    for row in 0..ROWS {
        let shown: Vec<f32> = next[row].iter().chain(&before[row][..SIZE]).copied().collect();
        let gate = |gate: usize, k: usize| -> f64 {
            let place = gate * SIZE + k;
            let sum: f32 = weight[place].iter().zip(&shown).map(|(weight, number)| weight * number).sum();
            f64::from(sum + bias[place])
        };
        for k in 0..SIZE {
            let memory = sigmoid(gate(1, k) + 1.0) * f64::from(before[row][SIZE + k])
                + sigmoid(gate(0, k)) * gate(2, k).tanh();
            let output = sigmoid(gate(3, k)) * memory.tanh();
            assert!((memory - f64::from(after[row][SIZE + k])).abs() < 1e-5);
            assert!((output - f64::from(after[row][k])).abs() < 1e-5);
        }
    }
}

#[test]
fn slopes_are_those_of_small_changes() {
    let lstm = Lstm::new(INPUTS, SIZE, &mut random(1)).unwrap();
    let steps = inputs(4);
    let active: Arc<[bool]> = [true, false, true].into();
    let first = Var::from_tensor(&steps[0]).unwrap();
    let loss = || {
        let mut state = lstm.start(ROWS).unwrap();
        for (k, input) in steps.iter().enumerate() {
            let input = if k == 0 { first.as_tensor() } else { input };
            // One row ends before the last step.
            state = lstm.step(input, &state, (k == 3).then(|| active.clone())).unwrap();
        }
        let weights: Vec<f32> = (0..ROWS * 2 * SIZE).map(|k| (k % 7) as f32 - 3.0).collect();
        let weights = Tensor::from_vec(weights, (ROWS, 2 * SIZE), &Device::Cpu).unwrap();
        (state * weights).unwrap().sum_all().unwrap()
    };
    let gradients = loss().backward().unwrap();
    let mut variables: Vec<Var> = lstm.parameters("lstm").into_iter().map(|(_, variable)| variable).collect();
    variables.push(first.clone());
    for variable in variables {
        let gradient: Vec<f32> = gradients.get(&variable).unwrap().flatten_all().unwrap().to_vec1().unwrap();
        let values: Vec<f32> = variable.flatten_all().unwrap().to_vec1().unwrap();
        for place in 0..values.len() {
            let at = |change: f32| {
                let mut changed = values.clone();
                changed[place] += change;
                variable.set(&Tensor::from_vec(changed, variable.shape(), &Device::Cpu).unwrap()).unwrap();
                f64::from(loss().to_scalar::<f32>().unwrap())
            };
            let expected = (at(0.01) - at(-0.01)) / 0.02;
            at(0.0);
            let found = f64::from(gradient[place]);
            assert!((found - expected).abs() < 2e-3 * (1.0 + expected.abs()), "{found} is not {expected}");
        }
    }
}

#[test]
fn rows_that_have_ended_keep_their_state() {
    let lstm = Lstm::new(INPUTS, SIZE, &mut random(2)).unwrap();
    let [first, second] = &inputs(2)[..] else { unreachable!() };
    let before = lstm.step(first, &lstm.start(ROWS).unwrap(), None).unwrap();
    let all = lstm.step(second, &before, None).unwrap();
    let some = lstm.step(second, &before, Some([false, true, false].into())).unwrap();
    let row = |state: &Tensor, k: usize| state.get(k).unwrap().to_vec1::<f32>().unwrap();
    assert_eq!(row(&some, 0), row(&before, 0));
    assert_eq!(row(&some, 1), row(&all, 1));
    assert!(difference(&row(&all, 0), &row(&before, 0)) > 1e-3);
}

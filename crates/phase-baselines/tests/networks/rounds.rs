//! The samples of a round, tested against counting: a network that only records its input.

use candle_core::{Device, Result, Tensor, Var};
use phase_baselines::{
    parameters::Parameter,
    training::{Loss, Network, TrainingRun, TrainingSettings, to_safetensors},
};
use phase_model::random::Pcg64Mcg;
use rand::RngExt;
use std::cell::RefCell;

/// Its one weight depends on the samples and its random numbers, so that it depends on the whole history.
struct Noting {
    weight: Var,
    seen: RefCell<Vec<usize>>,
    batches: RefCell<Vec<usize>>,
}

impl Network for Noting {
    type Sample = usize;
    const NAME: &'static str = "noting";
    const METRICS: &'static [&'static str] = &[];

    fn parameters(&self) -> Vec<Parameter> {
        vec![("weight".into(), self.weight.clone())]
    }

    fn loss(&self, samples: &[&usize], random: Option<&mut Pcg64Mcg>) -> Result<Loss> {
        let mut target: f64 = samples.iter().map(|&&sample| (7 * sample % 5) as f64 - 2.0).sum();
        if let Some(random) = random {
            target += random.random_range(0.0..1.0);
            self.seen.borrow_mut().extend(samples.iter().copied());
            self.batches.borrow_mut().push(samples.len());
        }
        Ok(Loss { loss: (self.weight.as_tensor() - target)?.sqr()?.sum_all()?, scores: Vec::new() })
    }
}

const SETTINGS: TrainingSettings = TrainingSettings {
    batch: 4,
    learning_rate: 0.1,
    max_gradient_norm: 10.0,
    round: 10,
    patience: 100,
    rounds: 100,
};

fn new(seed: u64, settings: TrainingSettings) -> TrainingRun<Noting> {
    let weight =
        Var::from_tensor(&Tensor::zeros(1, candle_core::DType::F32, &Device::Cpu).expect("enough memory"))
            .expect("enough memory");
    let network = Noting { weight, seen: RefCell::default(), batches: RefCell::default() };
    TrainingRun::new(network, seed, settings)
}

/// The samples of the given number of further rounds, round by round.
fn shown(run: &mut TrainingRun<Noting>, samples: usize, rounds: usize) -> Vec<Vec<usize>> {
    let samples: Vec<usize> = (0..samples).collect();
    (0..rounds)
        .map(|_| {
            run.round(&samples, &samples).expect("enough memory");
            run.network().seen.take()
        })
        .collect()
}

fn sorted(shown: &[usize]) -> Vec<usize> {
    let mut sorted = shown.to_vec();
    sorted.sort_unstable();
    sorted
}

#[test]
fn as_many_samples_as_a_round_come_once_each_in_another_order_every_time() {
    let shown = shown(&mut new(1, SETTINGS), 10, 5);
    for round in &shown {
        assert_eq!(sorted(round), Vec::from_iter(0..10));
    }
    assert!((1..5).all(|later| shown[later] != shown[0]));
}

#[test]
fn every_sample_comes_equally_often_up_to_one() {
    for samples in [1, 2, 3, 7, 9, 10, 11, 15, 23, 40] {
        let mut counts = vec![0_usize; samples];
        let mut all = Vec::new();
        for round in shown(&mut new(1, SETTINGS), samples, 9) {
            assert_eq!(round.len(), 10);
            round.iter().for_each(|&sample| counts[sample] += 1);
            let least = *counts.iter().min().unwrap();
            let most = *counts.iter().max().unwrap();
            assert!(most - least <= 1, "{samples} samples: {counts:?}");
            all.extend(round);
        }
        // Cut into passes, each has everything once.
        for pass in all.chunks_exact(samples) {
            assert_eq!(sorted(pass), Vec::from_iter(0..samples));
        }
    }
}

#[test]
fn a_round_is_as_many_batches_whatever_is_learnt_from() {
    for samples in [1, 10, 17] {
        let mut run = new(1, SETTINGS);
        shown(&mut run, samples, 2);
        assert_eq!(run.network().batches.take(), [4, 4, 2, 4, 4, 2]);
    }
}

#[test]
fn a_break_within_a_pass_changes_nothing() {
    for samples in [3, 10, 23] {
        let mut straight = new(1, SETTINGS);
        let expected = shown(&mut straight, samples, 7);
        let end = straight.checkpoint("data").unwrap();
        for stop in 1..7 {
            let mut before = new(1, SETTINGS);
            shown(&mut before, samples, stop);
            let mut after = new(1, SETTINGS);
            after.resume(&before.checkpoint("data").unwrap(), "data").unwrap();
            assert_eq!(shown(&mut after, samples, 7 - stop), expected[stop..]);
            assert!(after.checkpoint("data").unwrap() == end, "{samples} samples, after round {stop}");
        }
        // Another seed has another order and draws other numbers.
        let mut other = new(2, SETTINGS);
        assert_ne!(shown(&mut other, samples, 7), expected);
        assert_ne!(
            to_safetensors(&other.into_best().unwrap()).unwrap(),
            to_safetensors(&straight.into_best().unwrap()).unwrap()
        );
    }
}

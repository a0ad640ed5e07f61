//! Training: gradients, overfitting, determinism, resuming after an interruption.

use crate::support::{event, labelled, random, unlike, without_slope};
use phase_baselines::{
    arg::Arg,
    nodes::Nodes,
    recognition::LabelledEvent,
    social_gnn::SocialGnn,
    social_lstm::SocialLstm,
    stgat::Stgat,
    training::{
        CheckpointError, Metrics, Network, NetworkError, TrainingError, TrainingRun, TrainingSettings,
        evaluate, from_safetensors, to_safetensors,
    },
    two_level_lstm::TwoLevelLstm,
};
use phase_model::random::Pcg64Mcg;
use phase_tensors::TensorsError;

const QUICK: TrainingSettings = TrainingSettings {
    batch: 4,
    learning_rate: 4e-3,
    max_gradient_norm: 10.0,
    round: 8,
    patience: 100,
    rounds: 400,
};

fn lstm(random: &mut Pcg64Mcg) -> TwoLevelLstm {
    TwoLevelLstm::new(16, random).expect("a network")
}

fn arg(random: &mut Pcg64Mcg) -> Arg {
    Arg::new(16, 2, random).expect("a network")
}

fn run<N: Network>(new: fn(&mut Pcg64Mcg) -> N, seed: u64, settings: TrainingSettings) -> TrainingRun<N> {
    TrainingRun::new(new(&mut TrainingRun::<N>::first_weights(seed)), seed, settings)
}

fn social(random: &mut Pcg64Mcg) -> SocialLstm {
    SocialLstm::new(8, random).expect("a network")
}

fn gnn(random: &mut Pcg64Mcg) -> SocialGnn {
    SocialGnn::new(16, 8, random).expect("a network")
}

fn stgat(random: &mut Pcg64Mcg) -> Stgat {
    Stgat::new(8, 2, random).expect("a network")
}

fn every_parameter_has_a_slope<N: Network>(new: fn(&mut Pcg64Mcg) -> N, events: &[N::Sample]) {
    let network = new(&mut random(3));
    let events: Vec<&N::Sample> = events.iter().collect();
    for random in [None, Some(&mut random(4))] {
        let loss = network.loss(&events, random).expect("a loss");
        assert_eq!(loss.loss.rank(), 0);
        assert_eq!(loss.scores.len(), N::METRICS.len());
        let without = without_slope(&network.parameters(), &loss.loss);
        assert!(without.is_empty(), "{}: {without:?}", N::NAME);
    }
}

fn learns_by_heart<N: Network>(
    new: fn(&mut Pcg64Mcg) -> N,
    events: &[N::Sample],
    learnt: fn(&Metrics, &Metrics) -> bool,
) {
    let mut run = run(new, 1, QUICK);
    while !run.is_finished() {
        let validation = run.round(events, events).expect("a round").validation.clone();
        if learnt(&run.rounds()[0].validation, &validation) {
            break;
        }
    }
    // One more may be worse.
    run.round(events, events).expect("a round");
    let first = run.rounds()[0].validation.clone();
    let best = run.best_round().expect("a best one").clone();
    assert!(learnt(&first, &best.validation), "{}: {first:?} {best:?}", N::NAME);
    // The best weights are kept, whatever came after them.
    let again = evaluate(&run.into_best().expect("a network"), events, QUICK.batch).expect("a measure");
    assert_eq!(again, best.validation);
}

fn goes_on_as_if_nothing_had_happened<N: Network>(new: fn(&mut Pcg64Mcg) -> N, events: &[N::Sample]) {
    let settings = TrainingSettings { rounds: 4, ..QUICK };
    let rounds = |run: &mut TrainingRun<N>, last: usize| {
        while run.rounds().len() < last {
            run.round(events, events).expect("a round");
        }
    };
    let mut straight = run(new, 1, settings);
    let mut stopped = run(new, 1, settings);
    rounds(&mut stopped, 2);
    let training_files = stopped.checkpoint("data").expect("a checkpoint");
    let mut later = run(new, 1, settings);
    later.resume(&training_files, "data").expect("the same training");
    assert_eq!(later.checkpoint("data").expect("a checkpoint"), training_files);
    rounds(&mut straight, 4);
    rounds(&mut later, 4);
    assert!(straight.is_finished());
    assert_eq!(straight.rounds(), later.rounds());
    let bytes = |run: TrainingRun<N>| to_safetensors(&run.into_best().expect("a network")).expect("a file");
    let straight = bytes(straight);
    assert_eq!(straight, bytes(later));
    // Another seed gives another training.
    let mut other = run(new, 2, settings);
    rounds(&mut other, 1);
    assert_ne!(straight, bytes(other));
    // And loading the file restores the network.
    let read = from_safetensors(new(&mut random(9)), &straight).expect("a network");
    assert_eq!(to_safetensors(&read).expect("a file"), straight);
}

#[test]
fn gradients() {
    every_parameter_has_a_slope(lstm, &labelled());
    every_parameter_has_a_slope(arg, &labelled());
    every_parameter_has_a_slope(gnn, &labelled());
    every_parameter_has_a_slope(social, &unlike());
    every_parameter_has_a_slope(stgat, &unlike());
}

#[test]
fn recognisers_learn_a_few_labelled_events_by_heart() {
    let all_right = |_: &Metrics, best: &Metrics| best.scores == [1.0, 1.0];
    learns_by_heart(lstm, &labelled(), all_right);
    learns_by_heart(arg, &labelled(), all_right);
}

#[test]
fn forecasters_learn_a_few_trajectories_by_heart() {
    let events: Vec<Nodes> = (0..8).map(|number| Nodes::of(&event(number, 12, number % 3, 0.0))).collect();
    let near = |first: &Metrics, best: &Metrics| best.loss < 0.3 && best.loss < 0.2 * first.loss;
    learns_by_heart(social, &events, near);
    learns_by_heart(stgat, &events, near);
}

#[test]
fn breaks() {
    goes_on_as_if_nothing_had_happened(lstm, &labelled());
    goes_on_as_if_nothing_had_happened(arg, &labelled());
    goes_on_as_if_nothing_had_happened(gnn, &labelled());
    goes_on_as_if_nothing_had_happened(social, &unlike());
    goes_on_as_if_nothing_had_happened(stgat, &unlike());
}

#[test]
fn training_stops_when_nothing_is_gained() {
    let events = labelled();
    let mut run = run(lstm, 1, TrainingSettings { learning_rate: 0.0, patience: 3, ..QUICK });
    while !run.is_finished() {
        run.round(&events, &events).unwrap();
    }
    assert_eq!(run.rounds().len(), 4);
}

#[test]
fn what_cannot_be_learnt_from_is_refused() {
    let events = labelled();
    let outcome = |training: &[LabelledEvent], validation: &[LabelledEvent], learning_rate| {
        let mut run = run(lstm, 1, TrainingSettings { learning_rate, ..QUICK });
        run.round(training, validation).map(|_| ()).unwrap_err()
    };
    assert!(matches!(outcome(&[], &events, 0.1), TrainingError::NoEvents("training")));
    assert!(matches!(outcome(&events, &[], 0.1), TrainingError::NoEvents("validation")));
    assert!(matches!(outcome(&events, &events, f64::INFINITY), TrainingError::Diverged(1)));
}

#[test]
fn files_of_others_are_refused() {
    let lstm_run = run(lstm, 1, QUICK);
    let training_files = lstm_run.checkpoint("data").unwrap();
    let resumed = |seed, settings, data| run(lstm, seed, settings).resume(&training_files, data).unwrap_err();
    assert!(matches!(resumed(2, QUICK, "data"), CheckpointError::Other("seed")));
    assert!(matches!(
        resumed(1, TrainingSettings { batch: 5, ..QUICK }, "data"),
        CheckpointError::Other("settings")
    ));
    assert!(matches!(resumed(1, QUICK, "others"), CheckpointError::Other("data")));
    assert!(matches!(
        run(arg, 1, QUICK).resume(&training_files, "data"),
        Err(CheckpointError::Other("network"))
    ));
    let weights = to_safetensors(&lstm(&mut random(0))).unwrap();
    for length in [0, 1, 8, 100, weights.len() - 1] {
        let error = from_safetensors(lstm(&mut random(0)), &weights[..length]).unwrap_err();
        assert!(matches!(error, NetworkError::Tensors(TensorsError::Container(_))), "{error}");
        assert!(run(lstm, 1, QUICK).resume(&training_files[..length], "data").is_err());
    }
    let refused = |bytes: &[u8]| match from_safetensors(arg(&mut random(0)), bytes) {
        Err(NetworkError::Tensors(error)) => Some(error),
        _ => None,
    };
    assert!(matches!(refused(&weights), Some(TensorsError::Kind { field: "format", .. })));
    assert!(matches!(refused(&training_files), Some(TensorsError::Kind { field: "format", .. })));
    // A network of another size.
    let large = to_safetensors(&Arg::new(17, 2, &mut random(0)).unwrap()).unwrap();
    assert!(matches!(refused(&large), Some(TensorsError::Shape { .. })));
    let many = to_safetensors(&Arg::new(16, 3, &mut random(0)).unwrap()).unwrap();
    assert!(matches!(refused(&many), Some(TensorsError::Unknown(_))));
    let few = to_safetensors(&Arg::new(16, 1, &mut random(0)).unwrap()).unwrap();
    assert!(matches!(refused(&few), Some(TensorsError::Missing(_))));
    // The last value is replaced by NaN.
    let mut broken = to_safetensors(&arg(&mut random(0))).unwrap();
    let end = broken.len() - 4;
    broken[end..].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(matches!(refused(&broken), Some(TensorsError::NotFinite(_))));
}

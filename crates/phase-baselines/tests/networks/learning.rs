//! Learning: slopes, learning by heart, determinism, going on after a break.

use crate::support::{labelled, random, without_slope};
use phase_baselines::{
    arg::Arg,
    recognition::LabelledEvent,
    training::{
        CheckpointError, Network, Run, Settings, TensorsError, TrainingError, from_safetensors, measure,
        to_safetensors,
    },
    two_level_lstm::TwoLevelLstm,
};
use phase_model::random::Pcg64Mcg;

const QUICK: Settings =
    Settings { batch: 4, learning_rate: 4e-3, longest_slope: 10.0, patience: 100, epochs: 250 };

fn lstm(random: &mut Pcg64Mcg) -> TwoLevelLstm {
    TwoLevelLstm::new(16, random).expect("a network")
}

fn arg(random: &mut Pcg64Mcg) -> Arg {
    Arg::new(16, 2, random).expect("a network")
}

fn run<N: Network>(new: fn(&mut Pcg64Mcg) -> N, seed: u64, settings: Settings) -> Run<N> {
    Run::new(new(&mut Run::<N>::first_weights(seed)), seed, settings)
}

fn every_parameter_has_a_slope<N: Network<Sample = LabelledEvent>>(new: fn(&mut Pcg64Mcg) -> N) {
    let network = new(&mut random(3));
    let events = labelled();
    let events: Vec<&LabelledEvent> = events.iter().collect();
    for chance in [None, Some(&mut random(4))] {
        let loss = network.loss(&events, chance).expect("numbers");
        assert_eq!(loss.loss.rank(), 0);
        assert_eq!(loss.scores.len(), N::SCORES.len());
        let without = without_slope(&network.parameters(), &loss.loss);
        assert!(without.is_empty(), "{without:?}");
    }
}

fn learns_by_heart<N: Network<Sample = LabelledEvent>>(new: fn(&mut Pcg64Mcg) -> N) {
    let events = labelled();
    let mut run = run(new, 1, QUICK);
    while !run.is_finished() {
        run.epoch(&events, &events).expect("numbers");
    }
    let best = run.best_epoch().expect("numbers").clone();
    assert!(best.validation.scores == [1.0, 1.0], "{best:?}");
    // What is kept is what was best, whatever came after it.
    let again = measure(&run.into_best().expect("numbers"), &events, QUICK.batch).expect("numbers");
    assert_eq!(again, best.validation);
}

fn goes_on_as_if_nothing_had_happened<N: Network<Sample = LabelledEvent>>(new: fn(&mut Pcg64Mcg) -> N) {
    let events = labelled();
    let settings = Settings { epochs: 4, ..QUICK };
    let mut straight = run(new, 1, settings);
    let mut stopped = run(new, 1, settings);
    for _ in 0..2 {
        stopped.epoch(&events, &events).expect("numbers");
    }
    let kept = stopped.checkpoint("data").expect("numbers");
    let mut later = run(new, 1, settings);
    later.resume(&kept, "data").expect("numbers");
    assert_eq!(later.checkpoint("data").expect("numbers"), kept);
    for run in [&mut straight, &mut later] {
        while !run.is_finished() {
            run.epoch(&events, &events).expect("numbers");
        }
    }
    assert_eq!(straight.epochs(), later.epochs());
    let bytes = |run: Run<N>| to_safetensors(&run.into_best().expect("numbers")).expect("numbers");
    let straight = bytes(straight);
    assert_eq!(straight, bytes(later));
    // Another seed is another training.
    let mut other = run(new, 2, settings);
    other.epoch(&events, &events).expect("numbers");
    assert_ne!(straight, bytes(other));
    // And the file gives the network back.
    let read = from_safetensors(new(&mut random(9)), &straight).expect("numbers");
    assert_eq!(to_safetensors(&read).expect("numbers"), straight);
}

#[test]
fn slopes() {
    every_parameter_has_a_slope(lstm);
    every_parameter_has_a_slope(arg);
}

#[test]
fn by_heart() {
    learns_by_heart(lstm);
    learns_by_heart(arg);
}

#[test]
fn breaks() {
    goes_on_as_if_nothing_had_happened(lstm);
    goes_on_as_if_nothing_had_happened(arg);
}

#[test]
fn training_stops_when_nothing_is_gained() {
    let events = labelled();
    let mut run = run(lstm, 1, Settings { learning_rate: 0.0, patience: 3, ..QUICK });
    while !run.is_finished() {
        run.epoch(&events, &events).unwrap();
    }
    assert_eq!(run.epochs().len(), 4);
}

#[test]
fn what_cannot_be_learnt_from_is_refused() {
    let events = labelled();
    let outcome = |training: &[LabelledEvent], validation: &[LabelledEvent], learning_rate| {
        let mut run = run(lstm, 1, Settings { learning_rate, ..QUICK });
        run.epoch(training, validation).map(|_| ()).unwrap_err()
    };
    assert!(matches!(outcome(&[], &events, 0.1), TrainingError::NoEvents("training")));
    assert!(matches!(outcome(&events, &[], 0.1), TrainingError::NoEvents("validation")));
    assert!(matches!(outcome(&events, &events, f64::INFINITY), TrainingError::Apart(1)));
}

#[test]
fn files_of_others_are_refused() {
    let lstm_run = run(lstm, 1, QUICK);
    let kept = lstm_run.checkpoint("data").unwrap();
    let resumed = |seed, settings, data| run(lstm, seed, settings).resume(&kept, data).unwrap_err();
    assert_eq!(resumed(2, QUICK, "data"), CheckpointError::Other("seed"));
    assert_eq!(resumed(1, Settings { batch: 5, ..QUICK }, "data"), CheckpointError::Other("settings"));
    assert_eq!(resumed(1, QUICK, "others"), CheckpointError::Other("dataset"));
    assert_eq!(run(arg, 1, QUICK).resume(&kept, "data").unwrap_err(), CheckpointError::Other("network"));
    let weights = to_safetensors(&lstm(&mut random(0))).unwrap();
    for length in [0, 1, 8, 100, weights.len() - 1] {
        let error = from_safetensors(lstm(&mut random(0)), &weights[..length]).unwrap_err();
        assert!(matches!(error, TensorsError::Container(_)), "{error}");
        assert!(run(lstm, 1, QUICK).resume(&kept[..length], "data").is_err());
    }
    let refused = |bytes: &[u8]| from_safetensors(arg(&mut random(0)), bytes).map(|_| ()).unwrap_err();
    assert!(matches!(refused(&weights), TensorsError::Kind { field: "format", .. }));
    assert!(matches!(refused(&kept), TensorsError::Kind { field: "format", .. }));
    // A network of another size.
    let large = to_safetensors(&Arg::new(17, 2, &mut random(0)).unwrap()).unwrap();
    assert!(matches!(refused(&large), TensorsError::Shape { .. }));
    let many = to_safetensors(&Arg::new(16, 3, &mut random(0)).unwrap()).unwrap();
    assert!(matches!(refused(&many), TensorsError::Unknown(_)));
    let few = to_safetensors(&Arg::new(16, 1, &mut random(0)).unwrap()).unwrap();
    assert!(matches!(refused(&few), TensorsError::Missing(_)));
    // The last number is made one that is none.
    let mut broken = to_safetensors(&arg(&mut random(0))).unwrap();
    let end = broken.len() - 4;
    broken[end..].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(matches!(refused(&broken), TensorsError::NotFinite(_)));
}

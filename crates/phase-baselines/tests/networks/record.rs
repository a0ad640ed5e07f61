//! Records of trainings: what they aggregate, how they resume, what is rejected.

use crate::support::{labelled, random};
use phase_baselines::{
    training::{
        DataSource, Final, NamedMetrics, TrainingRecord, TrainingRecordError, TrainingRun, TrainingSettings,
        to_safetensors,
    },
    two_level_lstm::TwoLevelLstm,
};
use serde_json::{Value, json};

const SETTINGS: TrainingSettings = TrainingSettings {
    batch: 4,
    learning_rate: 1e-3,
    max_gradient_norm: 10.0,
    round: 5,
    patience: 9,
    rounds: 9,
};

/// Makes a record another one.
type Change = fn(&mut TrainingRecord);

fn run(seed: u64) -> TrainingRun<TwoLevelLstm> {
    TrainingRun::new(TwoLevelLstm::new(4, &mut random(seed)).expect("a network"), seed, SETTINGS)
}

fn source(events: usize) -> DataSource {
    DataSource { folder: "events".into(), sha256: "0".repeat(64), events }
}

fn record(run: &TrainingRun<TwoLevelLstm>) -> TrainingRecord {
    TrainingRecord::new(run, source(8), Vec::new(), source(2))
}

/// Runs the given number of rounds, each of 2 s on two threads.
fn go_on(run: &mut TrainingRun<TwoLevelLstm>, record: &mut TrainingRecord, rounds: usize) {
    let events = labelled();
    for _ in 0..rounds {
        record.add::<TwoLevelLstm>(run.round(&events, &events).expect("a round"), 4.0, 2.0);
    }
}

fn text(record: &TrainingRecord) -> String {
    record.to_json().expect("JSON")
}

#[test]
fn what_is_written_is_read() {
    let mut run = run(1);
    let mut record = record(&run);
    assert_eq!((record.best_round, &record.finished), (None, &None));
    assert_eq!(TrainingRecord::parse(text(&record).as_bytes()).expect("our own record"), record);
    go_on(&mut run, &mut record, 3);
    assert_eq!((record.cpu_seconds, record.seconds), (12.0, 6.0));
    assert_eq!(record.best_round, run.best_round().map(|round| round.number));
    let last = run.rounds().last().expect("a round");
    assert_eq!(record.rounds[2].validation.loss, last.validation.loss);
    assert_eq!(record.rounds[2].validation.scores["relation"], last.validation.scores[1]);
    let evaluate = NamedMetrics::of::<TwoLevelLstm>(&last.validation);
    record.finished = Some(Final { train: evaluate.clone(), validation: evaluate, test: None });
    assert_eq!(TrainingRecord::parse(text(&record).as_bytes()).expect("our own record"), record);
    // Every weight in the file counts: four bytes each, after the header.
    let network = run.into_best().expect("a network");
    let file = to_safetensors(&network).expect("a file");
    let header = u64::from_le_bytes(*file.first_chunk().expect("a length")) as usize;
    assert_eq!(record.weights, (file.len() - 8 - header) / 4);
}

#[test]
fn times_add_up_after_a_break() {
    let mut before = run(1);
    let mut after = run(1);
    let mut earlier = record(&before);
    go_on(&mut before, &mut earlier, 2);
    let training_files = before.checkpoint("data").expect("a checkpoint");
    // The record is written first, so it may contain a round more than the checkpoint.
    go_on(&mut before, &mut earlier, 1);
    after.resume(&training_files, "data").expect("the same training");
    let mut later = record(&after);
    later.resume(earlier.clone(), &after).expect("the same training");
    assert_eq!((later.rounds.len(), later.cpu_seconds, later.seconds), (2, 8.0, 4.0));
    go_on(&mut after, &mut later, 1);
    assert_eq!(later, earlier);
}

#[test]
fn records_of_others_are_refused() {
    let mut ours = run(1);
    let mut earlier = record(&ours);
    go_on(&mut ours, &mut earlier, 2);
    let refused = |change: Change| {
        let mut other = earlier.clone();
        change(&mut other);
        record(&ours).resume(other, &ours).expect_err("another training")
    };
    let cases: [(Change, &str); 8] = [
        (|record| record.network = "arg".into(), "network"),
        (|record| record.seed = 2, "seed"),
        (|record| record.settings.rounds = 8, "settings"),
        (|record| record.data.events = 7, "data"),
        (|record| record.data.folder = "others".into(), "data"),
        (|record| record.validation.sha256 = "1".repeat(64), "validation"),
        (|record| record.rounds.truncate(1), "course"),
        (|record| record.rounds[1].training.loss += 1e-9, "course"),
    ];
    for (change, what) in cases {
        assert!(matches!(refused(change), TrainingRecordError::Other(found) if found == what));
    }
}

#[test]
fn what_is_no_record_is_refused() {
    let mut run = run(1);
    let mut record = record(&run);
    go_on(&mut run, &mut record, 2);
    let text = text(&record);
    for length in [0, 1, text.len() / 2, text.len() - 3] {
        assert!(matches!(
            TrainingRecord::parse(&text.as_bytes()[..length]),
            Err(TrainingRecordError::Text(_))
        ));
    }
    let refused = |pointer: &str, value: Value| {
        let mut changed: Value = serde_json::from_str(&text).expect("JSON");
        let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
        match changed.pointer_mut(parent).expect("the field's parent") {
            Value::Array(items) => items[key.parse::<usize>().expect("an index")] = value,
            parent => parent[key] = value,
        }
        TrainingRecord::parse(changed.to_string().as_bytes()).expect_err("no record")
    };
    let cases = [
        ("/format", json!("phase-training/2")),
        ("/colour", json!("red")),
        ("/settings/colour", json!("red")),
        ("/rounds/0/colour", json!("red")),
        ("/rounds/0/validation/loss", Value::Null),
        ("/data/events", json!(-1)),
        ("/weights", json!("many")),
    ];
    for (pointer, value) in cases {
        let error = refused(pointer, value);
        assert!(matches!(error, TrainingRecordError::Text(_)), "{pointer}: {error}");
    }
    assert!(matches!(refused("/rounds/0/number", json!(2)), TrainingRecordError::Order));
    assert!(matches!(refused("/best_round", Value::Null), TrainingRecordError::Best));
    assert!(matches!(refused("/cpu_seconds", json!(-1.0)), TrainingRecordError::Time("cpu_seconds")));
    assert!(matches!(refused("/rounds/1/seconds", json!(-1.0)), TrainingRecordError::Time("seconds")));
}

//! What is written down of a training: on what, how, how well and how long.

use super::{Measure, Network, Round, Run, Settings};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use thiserror::Error;

/// A training from its first round on; `docs/formats.md` has the file.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    format: Format,
    /// The network's name.
    pub network: String,
    /// Numbers that it learns.
    pub weights: usize,
    /// The seed.
    pub seed: u64,
    /// The settings.
    pub settings: Settings,
    /// What is learnt from.
    pub data: Source,
    /// What is validated on.
    pub validation: Source,
    /// All rounds so far.
    pub rounds: Vec<RecordedRound>,
    /// The number of the best one; `None` before the first.
    pub best_round: Option<usize>,
    /// Processor time of all rounds (s).
    pub cpu_seconds: f64,
    /// What a clock showed for them (s).
    pub seconds: f64,
    /// How good the weights of the best round are; `None` until training is finished.
    #[serde(rename = "final")]
    pub finished: Option<Final>,
}

/// Some events of a dataset.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// The name of the dataset's folder.
    pub folder: String,
    /// SHA-256 over ids, splits and checksums of all its events, in lower-case hexadecimal.
    pub sha256: String,
    /// Events used.
    pub events: usize,
}

/// A round and its cost.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordedRound {
    /// Its number, from 1.
    pub number: usize,
    /// On the events learnt from, while they were.
    pub training: NamedMeasure,
    /// On the validation events afterwards.
    pub validation: NamedMeasure,
    /// Whether it was the best up to then.
    pub best: bool,
    /// Processor time of learning and validation, all threads together (s).
    pub cpu_seconds: f64,
    /// What a clock showed for both (s).
    pub seconds: f64,
}

/// Means over some events, each by its name.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NamedMeasure {
    /// The loss.
    pub loss: f64,
    /// What else is measured.
    pub scores: BTreeMap<String, f64>,
}

/// The weights of the best round, measured once more after training.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Final {
    /// On the events learnt from.
    pub train: NamedMeasure,
    /// On the validation events.
    pub validation: NamedMeasure,
    /// On the test events, if that was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub test: Option<NamedMeasure>,
}

/// Why some bytes are no record, or not that of a training.
#[derive(Debug, Error)]
pub enum RecordError {
    /// They cannot be read.
    #[error("is no record of a training: {0}")]
    Text(#[from] serde_json::Error),
    /// Rounds are missing or do not stand in their order.
    #[error("field `rounds` must have the rounds 1, 2, 3 … in this order")]
    Order,
    /// A time is none.
    #[error("field `{0}` must not be negative")]
    Time(&'static str),
    /// The best round is not the last one marked as best.
    #[error("field `best_round` must be the last round with `best`")]
    Best,
    /// It is the record of another training than the one that is to go on.
    #[error("belongs to a training with another {0}")]
    Other(&'static str),
}

#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
enum Format {
    #[serde(rename = "phase-training/1")]
    Training1,
}

impl NamedMeasure {
    /// Gives what a network of this kind is measured by its names.
    #[must_use]
    pub fn of<N: Network>(measure: &Measure) -> Self {
        let names = N::SCORES.iter().map(|&name| name.to_owned());
        Self { loss: measure.loss, scores: names.zip(measure.scores.iter().copied()).collect() }
    }
}

impl Record {
    /// The record of a run before its first round.
    #[must_use]
    pub fn new<N: Network>(run: &Run<N>, data: Source, validation: Source) -> Self {
        Self {
            format: Format::Training1,
            network: N::NAME.into(),
            weights: run.network.parameters().iter().map(|(_, variable)| variable.elem_count()).sum(),
            seed: run.seed,
            settings: run.settings,
            data,
            validation,
            rounds: Vec::new(),
            best_round: None,
            cpu_seconds: 0.0,
            seconds: 0.0,
            finished: None,
        }
    }

    /// Writes down a round and what it took (s).
    pub fn add<N: Network>(&mut self, round: &Round, cpu_seconds: f64, seconds: f64) {
        self.rounds.push(RecordedRound {
            number: round.number,
            training: NamedMeasure::of::<N>(&round.training),
            validation: NamedMeasure::of::<N>(&round.validation),
            best: round.best,
            cpu_seconds,
            seconds,
        });
        self.sum_up();
    }

    /// Takes up what an earlier record of the same training says of the rounds of a run that goes on. It may have more of
    /// them, for it is written before a checkpoint is; those are dropped, since they are gone through again.
    ///
    /// # Errors
    /// [`RecordError::Other`]; this record is then as it was.
    pub fn resume<N: Network>(&mut self, earlier: Self, run: &Run<N>) -> Result<(), RecordError> {
        let differences = [
            (earlier.network != self.network, "network"),
            (earlier.seed != self.seed, "seed"),
            (earlier.settings != self.settings, "settings"),
            (earlier.data != self.data, "data"),
            (earlier.validation != self.validation, "validation"),
            (!has_rounds_of(&earlier, run), "course"),
        ];
        if let Some((_, what)) = differences.into_iter().find(|(differs, _)| *differs) {
            return Err(RecordError::Other(what));
        }
        self.rounds = earlier.rounds;
        self.rounds.truncate(run.rounds().len());
        self.sum_up();
        Ok(())
    }

    /// Reads a record.
    ///
    /// # Errors
    /// [`RecordError`], but not [`RecordError::Other`].
    pub fn parse(bytes: &[u8]) -> Result<Self, RecordError> {
        let record: Self = serde_json::from_slice(bytes)?;
        if record.rounds.iter().zip(1..).any(|(round, number)| round.number != number) {
            return Err(RecordError::Order);
        }
        if record.best_round != record.last_best() {
            return Err(RecordError::Best);
        }
        let rounds = || record.rounds.iter();
        if rounds().any(|round| round.cpu_seconds < 0.0) || record.cpu_seconds < 0.0 {
            return Err(RecordError::Time("cpu_seconds"));
        }
        if rounds().any(|round| round.seconds < 0.0) || record.seconds < 0.0 {
            return Err(RecordError::Time("seconds"));
        }
        Ok(record)
    }

    /// The record as a file.
    ///
    /// # Errors
    /// If it cannot be written as JSON.
    pub fn to_json(&self) -> serde_json::Result<String> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    fn sum_up(&mut self) {
        self.best_round = self.last_best();
        self.cpu_seconds = self.rounds.iter().map(|round| round.cpu_seconds).sum();
        self.seconds = self.rounds.iter().map(|round| round.seconds).sum();
    }

    fn last_best(&self) -> Option<usize> {
        self.rounds.iter().rfind(|round| round.best).map(|round| round.number)
    }
}

fn has_rounds_of<N: Network>(record: &Record, run: &Run<N>) -> bool {
    let same = |(ours, theirs): (&Round, &RecordedRound)| {
        ours.best == theirs.best
            && NamedMeasure::of::<N>(&ours.training) == theirs.training
            && NamedMeasure::of::<N>(&ours.validation) == theirs.validation
    };
    record.rounds.len() >= run.rounds().len() && run.rounds().iter().zip(&record.rounds).all(same)
}

//! The record of a training: data, settings, results and duration.

use super::{Metrics, Network, Round, TrainingRun, TrainingSettings};
use phase_model::json::parse_as;
use serde::{Deserialize, Serialize, de::Error as _};
use std::collections::BTreeMap;
use thiserror::Error;

/// A training from its first round on; `docs/reference/formats/networks.md` describes the file.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrainingRecord {
    format: Format,
    /// The network's name.
    pub network: String,
    /// Number of trainable parameters.
    pub weights: usize,
    /// The seed.
    pub seed: u64,
    /// The settings.
    pub settings: TrainingSettings,
    /// Training data.
    pub data: DataSource,
    /// Further training data.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub more: Vec<DataSource>,
    /// Validation data.
    pub validation: DataSource,
    /// All rounds so far.
    pub rounds: Vec<RecordedRound>,
    /// The number of the best one; `None` before the first.
    pub best_round: Option<usize>,
    /// Processor time of all rounds (s).
    pub cpu_seconds: f64,
    /// Wall-clock time of all rounds (s).
    pub seconds: f64,
    /// Scores of the weights of the best round; `None` until training is finished.
    #[serde(rename = "final")]
    pub finished: Option<Final>,
}

/// Some events of a dataset.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DataSource {
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
    /// On the training events, during training.
    pub training: NamedMetrics,
    /// On the validation events afterwards.
    pub validation: NamedMetrics,
    /// Whether it was the best up to then.
    pub best: bool,
    /// CPU time of training and validation, all threads together (s).
    pub cpu_seconds: f64,
    /// Wall-clock time of both (s).
    pub seconds: f64,
}

/// Means over some events, each by its name.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NamedMetrics {
    /// The loss.
    pub loss: f64,
    /// The other metrics.
    pub scores: BTreeMap<String, f64>,
}

/// The weights of the best round, evaluated once more after training.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Final {
    /// On the training events.
    pub train: NamedMetrics,
    /// On the validation events.
    pub validation: NamedMetrics,
    /// On the test events, if requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub test: Option<NamedMetrics>,
}

/// Why bytes are not a record, or not that of the given training.
#[derive(Debug, Error)]
pub enum TrainingRecordError {
    /// They cannot be read.
    #[error("is not a training record: {0}")]
    Text(#[from] serde_json::Error),
    /// Rounds are missing or out of order.
    #[error("field `rounds` must have the rounds 1, 2, 3 … in this order")]
    Order,
    /// A time is negative or not finite.
    #[error("field `{0}` must not be negative")]
    Time(&'static str),
    /// The best round is not the last one marked as best.
    #[error("field `best_round` must be the last round with `best`")]
    Best,
    /// It is the record of another training than the one to resume.
    #[error("belongs to a training with another {0}")]
    Other(&'static str),
}

#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
enum Format {
    #[serde(rename = "phase-training/1")]
    Training1,
}

impl NamedMetrics {
    /// Names the metrics of a network of this kind.
    #[must_use]
    pub fn of<N: Network>(evaluate: &Metrics) -> Self {
        let names = N::METRICS.iter().map(|&name| name.to_owned());
        Self { loss: evaluate.loss, scores: names.zip(evaluate.scores.iter().copied()).collect() }
    }
}

impl TrainingRecord {
    /// The record of a run before its first round.
    #[must_use]
    pub fn new<N: Network>(
        run: &TrainingRun<N>,
        data: DataSource,
        more: Vec<DataSource>,
        validation: DataSource,
    ) -> Self {
        Self {
            format: Format::Training1,
            network: N::NAME.into(),
            weights: run.network.parameters().iter().map(|(_, variable)| variable.elem_count()).sum(),
            seed: run.seed,
            settings: run.settings,
            data,
            more,
            validation,
            rounds: Vec::new(),
            best_round: None,
            cpu_seconds: 0.0,
            seconds: 0.0,
            finished: None,
        }
    }

    /// Records a round and its duration (s).
    pub fn add<N: Network>(&mut self, round: &Round, cpu_seconds: f64, seconds: f64) {
        self.rounds.push(RecordedRound {
            number: round.number,
            training: NamedMetrics::of::<N>(&round.training),
            validation: NamedMetrics::of::<N>(&round.validation),
            best: round.best,
            cpu_seconds,
            seconds,
        });
        self.sum_up();
    }

    /// Takes over the rounds of an earlier record of the same training for a run that resumes. It may contain
    /// more rounds, since it is written before a checkpoint is; those are dropped, since they are repeated.
    ///
    /// # Errors
    /// [`TrainingRecordError::Other`]; this record is then unchanged.
    pub fn resume<N: Network>(
        &mut self,
        earlier: Self,
        run: &TrainingRun<N>,
    ) -> Result<(), TrainingRecordError> {
        let differences = [
            (earlier.network != self.network, "network"),
            (earlier.seed != self.seed, "seed"),
            (earlier.settings != self.settings, "settings"),
            (earlier.data != self.data || earlier.more != self.more, "data"),
            (earlier.validation != self.validation, "validation"),
            (!has_rounds_of(&earlier, run), "course"),
        ];
        if let Some((_, what)) = differences.into_iter().find(|(differs, _)| *differs) {
            return Err(TrainingRecordError::Other(what));
        }
        self.rounds = earlier.rounds;
        self.rounds.truncate(run.rounds().len());
        self.sum_up();
        Ok(())
    }

    /// Reads a record.
    ///
    /// # Errors
    /// [`TrainingRecordError`], but not [`TrainingRecordError::Other`].
    pub fn parse(bytes: &[u8]) -> Result<Self, TrainingRecordError> {
        let text = str::from_utf8(bytes).map_err(serde_json::Error::custom)?;
        let record: Self = parse_as(text)?;
        if record.rounds.iter().zip(1..).any(|(round, number)| round.number != number) {
            return Err(TrainingRecordError::Order);
        }
        if record.best_round != record.last_best() {
            return Err(TrainingRecordError::Best);
        }
        let rounds = || record.rounds.iter();
        if rounds().any(|round| round.cpu_seconds < 0.0) || record.cpu_seconds < 0.0 {
            return Err(TrainingRecordError::Time("cpu_seconds"));
        }
        if rounds().any(|round| round.seconds < 0.0) || record.seconds < 0.0 {
            return Err(TrainingRecordError::Time("seconds"));
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

fn has_rounds_of<N: Network>(record: &TrainingRecord, run: &TrainingRun<N>) -> bool {
    let same = |(ours, theirs): (&Round, &RecordedRound)| {
        ours.best == theirs.best
            && NamedMetrics::of::<N>(&ours.training) == theirs.training
            && NamedMetrics::of::<N>(&ours.validation) == theirs.validation
    };
    record.rounds.len() >= run.rounds().len() && run.rounds().iter().zip(&record.rounds).all(same)
}

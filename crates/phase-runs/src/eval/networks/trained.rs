//! The networks themselves.

use super::READING;
use crate::error::RunError;
use phase_baselines::{
    TrainedNetwork,
    arg::Arg,
    belief_network::BeliefNetwork,
    intent_network::IntentNetwork,
    social_gnn::SocialGnn,
    social_lstm::SocialLstm,
    stgat::Stgat,
    training::{NamedMetrics, NetworkError, PublishedNetwork, RecordedRound, TrainingRecord},
    two_level_lstm::TwoLevelLstm,
};
use phase_eval::{
    benchmark::{Curve, Training},
    trivial::Chance,
};
use phase_event::{
    BeliefReader, Forecaster, MethodError, MethodResult, ObservedEvent, ProgressCallback, Recogniser,
};
use phase_files::{
    checksum::{hexadecimal, sha256},
    json,
};
use phase_model::Judgement;
use serde_json::Value;
use std::{
    ffi::OsString,
    path::{Path, PathBuf},
};

/// A network for goals and relations, with the weights of a file or the bundled ones; `None` if there is none
/// of this name.
pub(crate) fn recogniser(
    name: &str,
    weights: Option<&Path>,
) -> Result<Option<Box<dyn Recogniser>>, RunError> {
    Ok(match name {
        "two-level-lstm" => Some(Box::new(open::<TwoLevelLstm>(weights)?)),
        "arg" => Some(Box::new(open::<Arg>(weights)?)),
        "socialgnn" => Some(Box::new(RelationAlone(open(weights)?))),
        _ => None,
    })
}

/// A network for trajectories; see [`recogniser`].
pub(crate) fn forecaster(
    name: &str,
    weights: Option<&Path>,
) -> Result<Option<Box<dyn Forecaster>>, RunError> {
    Ok(match name {
        "social-lstm" => Some(Box::new(open::<SocialLstm>(weights)?)),
        "stgat" => Some(Box::new(open::<Stgat>(weights)?)),
        _ => None,
    })
}

/// The network for beliefs; see [`recogniser`].
pub(crate) fn belief_reader(
    name: &str,
    weights: Option<&Path>,
) -> Result<Option<Box<dyn BeliefReader>>, RunError> {
    Ok(if name == READING { Some(Box::new(open::<BeliefNetwork>(weights)?)) } else { None })
}

/// The training record of the bundled weights; `None` if there is none of this name.
pub(crate) fn training(name: &str) -> Result<Option<Training>, RunError> {
    let record = match name {
        "intent-network" => IntentNetwork::BUNDLED_RECORD,
        READING => BeliefNetwork::BUNDLED_RECORD,
        "two-level-lstm" => TwoLevelLstm::BUNDLED_RECORD,
        "arg" => Arg::BUNDLED_RECORD,
        "socialgnn" => SocialGnn::BUNDLED_RECORD,
        "social-lstm" => SocialLstm::BUNDLED_RECORD,
        "stgat" => Stgat::BUNDLED_RECORD,
        _ => return Ok(None),
    };
    record_of(Path::new(&format!("data/{name}.safetensors.training.json")), record.as_bytes()).map(Some)
}

/// The training record beside a file of weights.
pub(crate) fn training_of(file: &Path) -> Result<Training, RunError> {
    let mut beside = OsString::from(file);
    beside.push(".training.json");
    let beside = PathBuf::from(beside);
    record_of(&beside, &json::bytes(&beside)?)
}

fn record_of(file: &Path, bytes: &[u8]) -> Result<Training, RunError> {
    let record = TrainingRecord::parse(bytes)
        .map_err(|source| RunError::TrainingRecord { file: file.to_owned(), source })?;
    let measures = record.rounds.first().map(|round| round.validation.scores.keys().cloned().collect());
    let curve = |measure: String| Curve {
        training: values(&record, &measure, |round| &round.training),
        validation: values(&record, &measure, |round| &round.validation),
        measure,
    };
    let measures: Vec<String> = measures.unwrap_or_default();
    Ok(Training {
        curves: measures.into_iter().map(curve).collect(),
        network: record.network,
        weights: record.weights,
        seed: record.seed,
        dataset: match record.more.len() {
            0 => record.data.folder,
            further => format!("{} and {further} more", record.data.folder),
        },
        events: record.data.events + record.more.iter().map(|data| data.events).sum::<usize>(),
        round: record.settings.round,
        rounds: record.rounds.len(),
        best_round: record.best_round,
        cpu_seconds: record.cpu_seconds,
    })
}

/// A metric of every round.
fn values(record: &TrainingRecord, measure: &str, part: fn(&RecordedRound) -> &NamedMetrics) -> Vec<f64> {
    let score = |round| part(round).scores.get(measure).copied().unwrap_or(f64::NAN);
    record.rounds.iter().map(score).collect()
}

/// A network with the weights of a file or the bundled ones.
fn open<N: PublishedNetwork>(weights: Option<&Path>) -> Result<TrainedNetwork<N>, RunError> {
    let given = weights.map(json::bytes).transpose()?;
    let bytes = given.as_deref().unwrap_or(N::BUNDLED_WEIGHTS);
    let wrong = |source: NetworkError| RunError::Weights {
        file: weights.map_or_else(|| format!("data/{}.safetensors", N::NAME).into(), Path::to_owned),
        source,
    };
    let network = N::with_weights(bytes).map_err(wrong)?;
    Ok(TrainedNetwork::new(network, hexadecimal(&sha256(bytes))))
}

/// SocialGNN, which tells the relation and says nothing about goals.
struct RelationAlone(TrainedNetwork<SocialGnn>);

impl Recogniser for RelationAlone {
    fn settings(&self) -> Value {
        self.0.settings()
    }

    /// An answer needs goals: those of [`Chance`], all equally likely.
    fn judge(
        &self,
        observed: &ObservedEvent,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> MethodResult<Judgement> {
        let Some((judgement, details)) = Chance.judge(observed, seed, tick)? else { return Ok(None) };
        let relation = self.0.network.judge(observed).map_err(MethodError::new)?;
        Ok(Some((Judgement { relation, ..judgement }, details)))
    }
}

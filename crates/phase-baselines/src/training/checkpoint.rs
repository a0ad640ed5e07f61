//! A training between two rounds, on disk.

use super::{Network, NetworkError, Round, TrainingRun, TrainingSettings, adam::Adam};
use crate::parameters::{self, Parameter};
use phase_tensors::{NamedTensor, TensorFile, TensorsError, write};
use serde::{Deserialize, Serialize};
use thiserror::Error;

const FIELD: &str = "training";
/// Prefixes of parameter names: current values, Adam's two moments, and the values of the best round.
const PARTS: [&str; 4] = ["now.", "first.", "second.", "best."];

/// The identity of a training. Only the same training resumes from a checkpoint.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Checkpoint {
    /// The network's name.
    pub network: String,
    /// The seed.
    pub seed: u64,
    /// The settings.
    pub settings: TrainingSettings,
    /// Digest of the training and validation events.
    pub data: String,
}

/// The contents of the metadata.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct CheckpointMetadata {
    of: Checkpoint,
    steps: u32,
    rounds: Vec<Round>,
}

/// Why a training cannot resume from some bytes.
#[derive(Debug, Error)]
pub enum CheckpointError {
    /// They are not a checkpoint of this network.
    #[error(transparent)]
    Network(#[from] NetworkError),
    /// They are a checkpoint whose text cannot be read.
    #[error("field `{FIELD}` cannot be read: {0}")]
    Text(#[from] serde_json::Error),
    /// They belong to another training.
    #[error("belongs to a training with another {0}")]
    Other(&'static str),
}

impl From<TensorsError> for CheckpointError {
    fn from(error: TensorsError) -> Self {
        Self::Network(error.into())
    }
}

impl<N: Network> TrainingRun<N> {
    /// Identity of this training for the given digest of its data.
    #[must_use]
    pub fn checkpoint_of(&self, data: &str) -> Checkpoint {
        let seed = self.seed;
        let settings = self.settings;
        Checkpoint { network: N::NAME.into(), seed, settings, data: data.into() }
    }

    /// The state that the next round depends on, as a safetensors file.
    ///
    /// # Errors
    /// If it cannot be read or laid out in a file.
    pub fn checkpoint(&self, data: &str) -> Result<Vec<u8>, CheckpointError> {
        let parameters = self.network.parameters();
        let now = parameters::values(&parameters).map_err(NetworkError::from)?;
        let mut tensors = Vec::new();
        let parts = [Some(&now), Some(&self.adam.first), Some(&self.adam.second), self.best.as_ref()];
        for (part, values) in PARTS.into_iter().zip(parts) {
            for ((name, variable), values) in parameters.iter().zip(values.into_iter().flatten()) {
                let name = format!("{part}{name}");
                let shape = variable.dims().into();
                tensors.push(NamedTensor { name, shape, values: values.clone() });
            }
        }
        let said = CheckpointMetadata {
            of: self.checkpoint_of(data),
            steps: self.adam.steps,
            rounds: self.rounds.clone(),
        };
        let said = serde_json::to_string(&said)?;
        Ok(write(&tensors, FIELD, &said)?)
    }

    /// Restores the state of a run of the same kind.
    ///
    /// # Errors
    /// [`CheckpointError`]; the run is then unchanged.
    pub fn resume(&mut self, bytes: &[u8], data: &str) -> Result<(), CheckpointError> {
        let file = TensorFile::open(bytes, FIELD)?;
        let missing = || TensorsError::Kind { field: FIELD, expected: "a training's state".into() };
        let said = file.metadata_value().ok_or_else(missing)?;
        let said: CheckpointMetadata = phase_model::json::parse_as(said)?;
        let theirs = &said.of;
        let ours = self.checkpoint_of(data);
        let differences = [
            (theirs.network != ours.network, "network"),
            (theirs.seed != ours.seed, "seed"),
            (theirs.settings != ours.settings, "settings"),
            (theirs.data != ours.data, "data"),
        ];
        if let Some((_, what)) = differences.into_iter().find(|(differs, _)| *differs) {
            return Err(CheckpointError::Other(what));
        }
        let parameters = self.network.parameters();
        let [now, first, second, best] = PARTS.map(|part| part_of(&file, part, &parameters));
        let has_best = parameters.first().is_some_and(|(name, _)| file.has(&format!("{}{name}", PARTS[3])));
        let best = if has_best { Some(best?) } else { None };
        let now = now?;
        let first = first?;
        let second = second?;
        parameters::set_values(&parameters, &now).map_err(NetworkError::from)?;
        self.adam = Adam { steps: said.steps, first, second };
        self.rounds = said.rounds;
        self.best = best;
        Ok(())
    }
}

fn part_of(
    file: &TensorFile<'_>,
    part: &str,
    parameters: &[Parameter],
) -> Result<Vec<Vec<f32>>, TensorsError> {
    let values = |(name, variable): &Parameter| file.values(&format!("{part}{name}"), variable.dims());
    parameters.iter().map(values).collect()
}

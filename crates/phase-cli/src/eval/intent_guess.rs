//! SIMPLE's intent network alone, without any simulation.

use crate::error::CliError;
use phase_eval::{
    Recogniser,
    method::{MethodResult, ProgressCallback},
};
use phase_event::ObservedEvent;
use phase_files::{
    checksum::{hexadecimal, sha256},
    json,
};
use phase_model::Judgement;
use phase_simple::IntentNetwork;
use serde_json::{Value, json};
use std::path::Path;

/// Q(Y | S) as an answer.
#[derive(Clone, Debug)]
pub(super) struct IntentGuess {
    network: IntentNetwork,
    /// Digest of its weights.
    sha256: String,
}

impl IntentGuess {
    /// With the weights of a file or the bundled ones.
    ///
    /// # Errors
    /// If the file cannot be used.
    pub(super) fn open(weights: Option<&Path>) -> Result<Self, CliError> {
        let given = weights.map(json::bytes).transpose()?;
        let bytes = given.as_deref().unwrap_or(IntentNetwork::BUNDLED_WEIGHTS);
        let file = || weights.map_or_else(|| "data/intent-network.safetensors".into(), Path::to_owned);
        let network = IntentNetwork::from_safetensors(bytes)
            .map_err(|source| CliError::IntentNetwork { file: file(), source })?;
        Ok(Self { network, sha256: hexadecimal(&sha256(bytes)) })
    }
}

impl Recogniser for IntentGuess {
    fn settings(&self) -> Value {
        json!({ "weights_sha256": self.sha256 })
    }

    fn judge(
        &self,
        observed: &ObservedEvent,
        _seed: u64,
        _tick: ProgressCallback<'_>,
    ) -> MethodResult<Judgement> {
        Ok(Some((self.network.posterior(observed).judgement(), Value::Null)))
    }
}

//! SIMPLE's intent network alone, without any simulation.

use crate::IntentNetwork;
use phase_event::{MethodResult, ObservedEvent, ProgressCallback, Recogniser};
use phase_model::Judgement;
use serde_json::{Value, json};
use std::sync::Arc;

/// Q(Y | S), the intent network's guess, as an answer.
#[derive(Clone, Debug)]
pub struct IntentGuess {
    network: Arc<IntentNetwork>,
    weights_sha256: String,
}

impl IntentGuess {
    /// A method that answers with a network. `weights_sha256` is the digest of its file, to be stored with
    /// the answers.
    #[must_use]
    pub const fn new(network: Arc<IntentNetwork>, weights_sha256: String) -> Self {
        Self { network, weights_sha256 }
    }
}

impl Recogniser for IntentGuess {
    fn settings(&self) -> Value {
        json!({ "weights_sha256": self.weights_sha256 })
    }

    fn judge(
        &self,
        observed: &ObservedEvent,
        _seed: u64,
        _tick: ProgressCallback<'_>,
    ) -> MethodResult<Judgement> {
        Ok(Some((self.network.posterior(observed).judged(observed).judgement(), Value::Null)))
    }
}

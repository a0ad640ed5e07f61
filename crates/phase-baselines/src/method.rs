//! Trained networks as methods that answer to events.

use crate::{belief_network::BeliefNetwork, forecasting::Forecasting, recognition::Recognition};
use candle_core::Result;
use phase_event::{
    BeliefOrder, BeliefReader, Beliefs, Forecaster, MethodError, MethodResult, ObservedEvent, Prediction,
    ProgressCallback, Recogniser,
};
use phase_model::Judgement;
use serde_json::{Value, json};

/// A trained network, which answers to events.
#[derive(Clone, Debug)]
pub struct TrainedNetwork<N> {
    /// The network.
    pub network: N,
    weights_sha256: String,
}

impl<N> TrainedNetwork<N> {
    /// A method that answers with a network. `weights_sha256` is the digest of its file, to be stored with
    /// the answers.
    pub const fn new(network: N, weights_sha256: String) -> Self {
        Self { network, weights_sha256 }
    }

    /// The settings that are stored with the answers: `weights_sha256`.
    pub fn settings(&self) -> Value {
        json!({ "weights_sha256": self.weights_sha256 })
    }
}

impl<N: Recognition + Sync> Recogniser for TrainedNetwork<N> {
    fn settings(&self) -> Value {
        self.settings()
    }

    fn judge(
        &self,
        observed: &ObservedEvent,
        _seed: u64,
        _tick: ProgressCallback<'_>,
    ) -> MethodResult<Judgement> {
        answered(self.network.judge(observed))
    }
}

impl<N: Forecasting + Sync> Forecaster for TrainedNetwork<N> {
    fn settings(&self) -> Value {
        self.settings()
    }

    fn forecast(
        &self,
        observed: &ObservedEvent,
        steps: usize,
        _seed: u64,
        _tick: ProgressCallback<'_>,
    ) -> MethodResult<Prediction> {
        answered(self.network.forecast(observed, steps).map(Prediction::from))
    }
}

impl BeliefReader for TrainedNetwork<BeliefNetwork> {
    fn settings(&self) -> Value {
        self.settings()
    }

    /// Beliefs of the first order alone.
    fn read_beliefs(
        &self,
        observed: &ObservedEvent,
        order: BeliefOrder,
        steps: &[usize],
        _seed: u64,
        _tick: ProgressCallback<'_>,
    ) -> MethodResult<Vec<Beliefs>> {
        match order {
            BeliefOrder::First => answered(self.network.beliefs(observed, steps)),
            BeliefOrder::Second => Err(MethodError::new("the network knows no beliefs about beliefs")),
        }
    }
}

fn answered<T>(answer: Result<T>) -> MethodResult<T> {
    answer.map(|answer| Some((answer, Value::Null))).map_err(MethodError::new)
}

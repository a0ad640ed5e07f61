//! The network and its state while it watches an event.

use super::{FEATURES, GoalFeatures, IntentNetworkError};
use crate::{
    Intent, Posterior,
    intent::{WeightedIntents, joint_logs},
    physical_goals,
};
use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, AgentId, Attitude, Body, MAX_ENTITIES, Strength};
use phase_statistics::logistic;
use phase_tensors::{Dense, relu};
use std::sync::Arc;

/// Outputs for a goal: its owner pursues it, the other helps the owner, the other hinders it.
pub const OUTPUTS: usize = 3;

/// From features to a hidden layer, an LSTM of the same size over the rows, another hidden layer, and the
/// logits.
#[derive(Clone, PartialEq, Debug)]
pub struct IntentNetwork {
    /// [`FEATURES`] to the hidden units.
    pub(super) embedding: Dense,
    /// Embedding and previous output to the input, forget, new and output gates.
    pub(super) memory: Dense,
    /// From the LSTM's output to as many units.
    pub(super) hidden: Dense,
    /// To [`OUTPUTS`] logits.
    pub(super) output: Dense,
}

/// The network's state for each goal of an event that is being watched.
#[derive(Clone, Debug)]
pub struct IntentReader {
    network: Arc<IntentNetwork>,
    features: GoalFeatures,
    states: Vec<State>,
}

/// The state of an LSTM.
#[derive(Clone, Debug)]
struct State {
    output: Vec<f64>,
    cell: Vec<f64>,
}

impl IntentNetwork {
    /// The weights trained by `cargo train intent-network`; `docs/explanation/networks.md` describes the
    /// training data.
    pub const BUNDLED_WEIGHTS: &'static [u8] = phase_data::INTENT_NETWORK.weights;

    /// The network that comes with the program.
    ///
    /// # Errors
    /// [`IntentNetworkError`] if the program was built with a damaged file.
    pub fn bundled() -> Result<Self, IntentNetworkError> {
        Self::from_safetensors(Self::BUNDLED_WEIGHTS)
    }

    /// Number of units of every hidden layer.
    #[must_use]
    pub const fn units(&self) -> usize {
        self.embedding.outputs
    }

    /// ln Q of every intent of each agent after a whole event, but for a constant.
    #[must_use]
    pub fn weigh(self: &Arc<Self>, observed: &ObservedEvent) -> [WeightedIntents; AGENT_COUNT] {
        self.watched(observed).intents()
    }

    /// Watches all rows of an event that have been observed.
    #[must_use]
    pub fn watched(self: &Arc<Self>, observed: &ObservedEvent) -> IntentReader {
        let mut reader = self.watch(observed);
        observed.rows().iter().for_each(|row| reader.push(row));
        reader
    }

    /// Q(Y | S) after a whole event. It says nothing of strengths; those of its hypotheses do not matter.
    #[must_use]
    pub fn posterior(self: &Arc<Self>, observed: &ObservedEvent) -> Posterior {
        let goals = physical_goals(AgentId::ZERO, observed.object_sizes().len()).len();
        Posterior::new(joint_logs(&self.weigh(observed), [Strength::Fair; AGENT_COUNT], goals))
    }

    /// Begins to watch an event, of which no row has been seen; those of `observed` do not matter.
    #[must_use]
    pub fn watch(self: &Arc<Self>, observed: &ObservedEvent) -> IntentReader {
        let features = GoalFeatures::new(observed);
        let state = State { output: vec![0.0; self.units()], cell: vec![0.0; self.units()] };
        let states = vec![state; features.goals().len()];
        IntentReader { network: Arc::clone(self), features, states }
    }

    fn step(&self, features: &[f32; FEATURES], state: &mut State) {
        let units = self.units();
        let inputs: Vec<f64> = features.iter().map(|&feature| f64::from(feature)).collect();
        let mut inputs = relu(self.embedding.apply(&inputs));
        inputs.extend_from_slice(&state.output);
        let gates = self.memory.apply(&inputs);
        for k in 0..units {
            let input = logistic(gates[k]);
            // The forget gate has an additional bias of 1, as in training.
            let forget = logistic(gates[units + k] + 1.0);
            let new = libm::tanh(gates[2 * units + k]);
            let output = logistic(gates[3 * units + k]);
            state.cell[k] = forget * state.cell[k] + input * new;
            state.output[k] = output * libm::tanh(state.cell[k]);
        }
    }

    fn logits(&self, state: &State) -> [f64; OUTPUTS] {
        let logits = self.output.apply(&relu(self.hidden.apply(&state.output)));
        core::array::from_fn(|k| logits.get(k).copied().unwrap_or_default())
    }
}

impl IntentReader {
    /// Watches the next row.
    pub fn push(&mut self, row: &[Body; MAX_ENTITIES]) {
        for (state, features) in self.states.iter_mut().zip(self.features.of_row(row)) {
            self.network.step(&features, state);
        }
    }

    /// Activations of the last hidden layer given the rows so far: of each unit the mean over all goals of
    /// both agents, which share their weights.
    #[must_use]
    pub fn activations(&self) -> Vec<f64> {
        let mut sum = vec![0.0; self.network.units()];
        for state in &self.states {
            let active = relu(self.network.hidden.apply(&state.output));
            sum.iter_mut().zip(active).for_each(|(sum, unit)| *sum += unit);
        }
        sum.iter().map(|sum| sum / self.states.len().max(1) as f64).collect()
    }

    /// ln Q of every intent of each agent given the rows so far, but for a constant, in the order of
    /// [`Intent::all`].
    #[must_use]
    pub fn intents(&self) -> [WeightedIntents; AGENT_COUNT] {
        let logits: Vec<[f64; OUTPUTS]> =
            self.states.iter().map(|state| self.network.logits(state)).collect();
        AgentId::ALL.map(|agent| {
            let of = |owner: AgentId, attitude: Attitude, output: usize| {
                let goals = self.features.goals().iter().zip(&logits);
                let goals = goals.filter(move |((whose, _), _)| *whose == owner);
                goals.map(move |((_, goal), logits)| (Intent { attitude, goal: *goal }, logits[output]))
            };
            let own = of(agent, Attitude::Neutral, 0);
            let help = of(agent.other(), Attitude::Help, 1);
            own.chain(help).chain(of(agent.other(), Attitude::Hinder, 2)).collect()
        })
    }
}

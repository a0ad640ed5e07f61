//! The policy network: the choice of a search, without the search.
//!
//! It is distilled from root visits of whole searches (`train policy`), as in expert iteration. A mind uses
//! it as prior of the root's actions ([`Prior::Network`](crate::Prior)); inference and forecasts use it in
//! place of a search.

mod features;

use crate::search_model::{SearchModel, SearchState};
pub use features::{Features, OF_ACTION, SHARED};
use phase_model::{Action, Dynamics};
use phase_statistics::log_softmax;
use phase_tensors::{Dense, TensorFile, TensorsError, check_shape, relu};
use std::sync::LazyLock;

/// The value of the field `format` of the file's metadata.
pub const POLICY_FORMAT: &str = "phase-policy/1";
/// Most particles of which features are averaged; they are evenly spaced among all.
const SUMMARISED: usize = 2;

/// A network that scores each action of a decision by the same weights.
///
/// The features that all actions share are embedded. A hidden layer adds up what the embedding and the
/// action's own features say; another one and the output make a logit of it. Every layer but the outputs is
/// followed by max(0, ·). The value comes from the embedding.
#[derive(Clone, PartialEq, Debug)]
pub struct PolicyNetwork {
    embedding: Dense,
    context: Dense,
    action: Dense,
    hidden: Dense,
    output: Dense,
    value: Dense,
}

/// The network's answer to a decision.
#[derive(Clone, PartialEq, Debug)]
pub struct Evaluation {
    /// The probability of every action, in the order in which they were given.
    pub policy: Vec<f64>,
    /// The mean return of a search (the reward's unit).
    pub value: f64,
}

/// The network that comes with the program, parsed once.
static BUNDLED: LazyLock<PolicyNetwork> = LazyLock::new(|| {
    PolicyNetwork::from_safetensors(phase_data::POLICY.weights)
        .unwrap_or_else(|error| unreachable!("the program was built with a damaged policy network: {error}"))
});

impl PolicyNetwork {
    /// The network that comes with the program.
    #[must_use]
    pub fn bundled() -> &'static Self {
        &BUNDLED
    }

    /// Reads a file as `train policy` writes it.
    ///
    /// # Errors
    /// [`TensorsError`] for bytes that are not such a file, and tensors that are missing or of another shape.
    pub fn from_safetensors(bytes: &[u8]) -> Result<Self, TensorsError> {
        let file = TensorFile::open_as(bytes, "format", POLICY_FORMAT)?;
        let layer = |name| Dense::read(&file, name);
        let network = Self {
            embedding: layer("embedding")?,
            context: layer("context")?,
            action: layer("action")?,
            hidden: layer("hidden")?,
            output: layer("output")?,
            value: layer("value")?,
        };
        let Self { embedding, context, action, hidden, output, value } = &network;
        for (name, layer, inputs, outputs) in [
            ("embedding.weight", embedding, SHARED, embedding.outputs),
            ("context.weight", context, embedding.outputs, context.outputs),
            ("action.weight", action, OF_ACTION, context.outputs),
            ("hidden.weight", hidden, context.outputs, hidden.outputs),
            ("output.weight", output, hidden.outputs, 1),
            ("value.weight", value, embedding.outputs, 1),
        ] {
            check_shape(name, &[outputs, inputs], &[layer.outputs, layer.inputs])?;
        }
        Ok(network)
    }

    /// The policy among some actions, and the value, that a search would find.
    #[must_use]
    pub fn evaluate(&self, features: &Features, actions: &[Action]) -> Evaluation {
        let doubles = |features: &[f32]| -> Vec<f64> { features.iter().map(|&it| it.into()).collect() };
        let only = |outputs: Vec<f64>| outputs.first().copied().unwrap_or_default();
        let embedded = relu(self.embedding.apply(&doubles(&features.shared)));
        let context = self.context.apply(&embedded);
        let logit = |action: &Action| {
            let mut sums = self.action.apply(&doubles(&features.actions[action.index()]));
            sums.iter_mut().zip(&context).for_each(|(sum, context)| *sum += context);
            only(self.output.apply(&relu(self.hidden.apply(&relu(sums)))))
        };
        let mut logs: Vec<f64> = actions.iter().map(logit).collect();
        log_softmax(&mut logs);
        Evaluation {
            policy: logs.into_iter().map(libm::exp).collect(),
            value: only(self.value.apply(&embedded)),
        }
    }
}

/// The mean of the features of the states that a decision is made in.
pub(crate) fn summary<D: Dynamics>(model: &SearchModel<'_, D>, search_states: &[SearchState]) -> Features {
    let count = search_states.len().min(SUMMARISED);
    let mut mean = Features::NONE;
    for k in 0..count {
        let of_state = Features::of(model, &search_states[k * search_states.len() / count]);
        mean.add(&of_state, 1.0 / count as f32);
    }
    mean
}

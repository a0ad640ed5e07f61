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
use phase_tensors::{ChoiceNetwork, TensorFile, TensorsError};
use std::sync::LazyLock;

/// The value of the field `format` of the file's metadata.
pub const POLICY_FORMAT: &str = "phase-policy/1";
/// Visits that the network's probabilities are given as, in place of a search's.
pub(crate) const VISITS: f64 = 1000.0;
/// Most particles of which features are averaged; they are evenly spaced among all.
const SUMMARISED: usize = 2;

/// The network that says what a search by a mind of this kind would choose, and the value that it would find.
#[derive(Clone, PartialEq, Debug)]
pub struct PolicyNetwork(ChoiceNetwork);

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
        ChoiceNetwork::read(&file, SHARED, OF_ACTION).map(Self)
    }

    /// The policy among some actions, and the value, that a search would find.
    #[must_use]
    pub fn evaluate(&self, features: &Features, actions: &[Action]) -> Evaluation {
        let options = actions.iter().map(|action| &features.actions[action.index()][..]);
        let (mut logs, value) = self.0.evaluate(&features.shared, options);
        log_softmax(&mut logs);
        Evaluation { policy: logs.into_iter().map(libm::exp).collect(), value }
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

//! The policy network of published minds: what a search would choose, without the search.
//!
//! It is distilled from root visits of whole searches (`train published-policy`). Inference asks it in place
//! of searches ([`PublishedParameters::network_alone`](crate::PublishedParameters)).

mod features;
mod futures;

pub use features::{Features, OF_ACTION, SHARED};
use phase_model::Action;
use phase_statistics::log_softmax;
use phase_tensors::{ChoiceNetwork, TensorFile, TensorsError};
use std::sync::LazyLock;

/// The value of the field `format` of the file's metadata.
pub const POLICY_FORMAT: &str = "phase-published-policy/1";

/// The network that says what a search by a published mind would choose.
#[derive(Clone, PartialEq, Debug)]
pub struct PolicyNetwork(ChoiceNetwork);

/// The network that comes with the program, parsed once.
static BUNDLED: LazyLock<PolicyNetwork> = LazyLock::new(|| {
    PolicyNetwork::from_safetensors(phase_data::PUBLISHED_POLICY.weights)
        .unwrap_or_else(|error| unreachable!("the program was built with a damaged policy network: {error}"))
});

impl PolicyNetwork {
    /// The network that comes with the program.
    #[must_use]
    pub fn bundled() -> &'static Self {
        &BUNDLED
    }

    /// Reads a file as `train published-policy` writes it.
    ///
    /// # Errors
    /// [`TensorsError`] for bytes that are not such a file, and tensors that are missing or of another shape.
    pub fn from_safetensors(bytes: &[u8]) -> Result<Self, TensorsError> {
        let file = TensorFile::open_as(bytes, "format", POLICY_FORMAT)?;
        ChoiceNetwork::read(&file, SHARED, OF_ACTION).map(Self)
    }

    /// The shares of visits of some actions, in their order, and the mean return of the best (the reward's
    /// unit), that a search would find.
    #[must_use]
    pub fn evaluate(&self, features: &Features, actions: &[Action]) -> (Vec<f64>, f64) {
        let options = actions.iter().map(|action| &features.actions[action.index()][..]);
        let (mut logs, value) = self.0.evaluate(&features.shared, options);
        log_softmax(&mut logs);
        (logs.into_iter().map(libm::exp).collect(), value)
    }
}

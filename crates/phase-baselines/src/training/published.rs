//! The networks of the paper, as bundled with the program.

use super::{Network, NetworkError, TrainingRun, from_safetensors};
use candle_core::Result;
use phase_model::random::Pcg64Mcg;

/// A network of the paper's size, whose weights are bundled with the program.
pub trait PublishedNetwork: Network + Sized {
    /// The weights trained by `cargo train`; `docs/explanation/networks.md` describes the training data.
    const BUNDLED_WEIGHTS: &'static [u8];
    /// The [`TrainingRecord`](super::TrainingRecord) of that training, as a file.
    const BUNDLED_RECORD: &'static str;

    /// The untrained network of the published size: 64 hidden units in every layer unless it says otherwise.
    ///
    /// # Errors
    ///
    /// If a tensor cannot be allocated.
    fn published(random: &mut Pcg64Mcg) -> Result<Self>;

    /// The network with the weights in a file of [`to_safetensors`](super::to_safetensors), such as
    /// [`BUNDLED_WEIGHTS`](Self::BUNDLED_WEIGHTS).
    ///
    /// # Errors
    /// [`NetworkError`] if the file is not of this network.
    fn with_weights(bytes: &[u8]) -> core::result::Result<Self, NetworkError> {
        // The initial random weights are overwritten.
        from_safetensors(Self::published(&mut TrainingRun::<Self>::first_weights(0))?, bytes)
    }
}

//! The reasons why something cannot be simulated.

use phase_model::{AgentId, SceneError, setting::RangeError};
use thiserror::Error;

/// The reason why a scene could not be simulated: the scene or the settings are invalid, or a search failed.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum SimulationError {
    /// The scene is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The published simulator's minds know each other's goals and see with their own eyes.
    #[error(
        "field `agents[{0}]`: published minds know the other's goal; \
         leave out `knows`, `level`, `sees` and `waits`"
    )]
    Awareness(AgentId),
    /// A search failed.
    #[error(transparent)]
    Search(#[from] phase_pomcp::PomcpError),
    /// A setting is out of its range.
    #[error(transparent)]
    Settings(#[from] RangeError),
}

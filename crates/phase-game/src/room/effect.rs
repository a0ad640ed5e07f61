//! Effects: everything that follows from a call of a room, for its caller to carry out.

use crate::{Entry, ToPlayer, settings::SettingsError};
use phase_event::Recording;
use phase_model::AgentId;
use phase_sim::SimulationError;
use thiserror::Error;

/// Why a game cannot be played, or cannot go on.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum RoomError {
    /// There is nothing to play.
    #[error("a game needs at least one scene")]
    NoRound,
    /// A setting of the game is outside of its range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A scene or the settings of its simulation are invalid.
    #[error(transparent)]
    Simulation(#[from] SimulationError),
}

/// Something that follows from what a room was told. Effects are to be carried out in their order: an entry
/// is in the journal before anybody sees the step.
#[derive(Clone, PartialEq, Debug)]
pub enum Effect {
    /// An entry of the journal.
    Journal(Entry),
    /// A message to the player of an agent.
    Send(AgentId, ToPlayer),
    /// A round that was played to its end.
    Finished(Box<Recording>),
    /// The simulation failed, and with it the game. Players are told so; the reason is for the operator of
    /// the server.
    Failed(RoomError),
}

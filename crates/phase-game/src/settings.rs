//! Settings of a game.

use core::time::Duration;
use phase_model::AGENT_COUNT;
use phase_sim::SimulationSettings;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The time that a step takes on the screen: five frames, 20 a second.
pub const STEP: Duration = Duration::from_millis(250);

/// Longest time that a setting can have: a week.
pub const LONGEST_TIME: Duration = Duration::from_secs(7 * 24 * 3600);
/// Most steps of a practice, and most after which a goal counts as achieved: more than an hour.
pub const MOST_STEPS: usize = 20_000;

/// A setting of a game that is outside of its range.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
pub enum SettingsError {
    /// A time.
    #[error("{field}: must be at most a week")]
    Time {
        /// The setting.
        field: &'static str,
    },
    /// A number of steps.
    #[error("{field}: must be 1 to {MOST_STEPS} steps")]
    Steps {
        /// The setting.
        field: &'static str,
    },
}

/// The part of the world that a player sees.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum View {
    /// Only that which the player's agent observes (paper, appendix, "Experiment 2").
    #[default]
    Own,
    /// Everything.
    All,
}

/// The player of an agent.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Player {
    /// A person.
    Human,
    /// The agent's mind.
    Mind,
}

/// The settings of a game. Defaults are the paper's where it names them.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GameSettings {
    /// By agent, whether a person or a mind plays it.
    pub players: [Player; AGENT_COUNT],
    /// The part of the world that players see.
    pub view: View,
    /// A round also ends when both goals were achieved for this many steps in a row, so that passing over a
    /// landmark does not count (steps).
    pub achieved_steps: usize,
    /// Longest practice (steps); it ends sooner when all players are ready.
    pub practice_steps: usize,
    /// Time between the last player's being ready and the first step.
    pub countdown: Duration,
    /// Time for which a game waits for a player who has left, before it is given up.
    pub patience: Duration,
    /// Time for which a room waits for its players to come, before it is given up.
    pub lobby_patience: Duration,
    /// Engine, length of a round and parameters of minds.
    pub simulation: SimulationSettings,
}

impl Default for GameSettings {
    fn default() -> Self {
        let simulation = SimulationSettings {
            // The end of a round is decided here, and people may stop to think.
            rest_steps: usize::MAX,
            still_steps: usize::MAX,
            stop_between_steps: true,
            ..SimulationSettings::default()
        };
        Self {
            players: [Player::Human; AGENT_COUNT],
            view: View::default(),
            achieved_steps: 4,
            practice_steps: 240,
            countdown: Duration::from_secs(3),
            patience: Duration::from_secs(120),
            lobby_patience: Duration::from_secs(30 * 60),
            simulation,
        }
    }
}

impl GameSettings {
    /// Checks the settings of the game itself; those of its simulation are checked when it is made.
    ///
    /// # Errors
    /// The first setting that is outside of its range.
    pub fn validate(&self) -> Result<(), SettingsError> {
        for (field, time) in [
            ("countdown", self.countdown),
            ("patience", self.patience),
            ("lobby_patience", self.lobby_patience),
        ] {
            if time > LONGEST_TIME {
                return Err(SettingsError::Time { field });
            }
        }
        for (field, steps) in
            [("achieved_steps", self.achieved_steps), ("practice_steps", self.practice_steps)]
        {
            if !(1..=MOST_STEPS).contains(&steps) {
                return Err(SettingsError::Steps { field });
            }
        }
        Ok(())
    }
}

//! Messages between players and room, as JSON: one object a message, its kind in `type`.

use crate::{Instructions, View};
use phase_model::{AGENT_COUNT, Action, AgentId, json::parse_as};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The version of the protocol, told in the first message.
pub const PROTOCOL: &str = "phase-game/1";

/// A message of a player that cannot be understood.
#[derive(Debug, Error)]
pub enum MessageError {
    /// It is not one of the messages.
    #[error("not a message of {PROTOCOL}")]
    Malformed(#[source] serde_json::Error),
    /// The action does not exist.
    #[error("there is no action {name}")]
    Action {
        /// Its name, shortened.
        name: String,
    },
}

/// A message of a player.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FromPlayer {
    /// Begins an action, or with `stop` ceases: `{"type": "hold", "action": "up"}`.
    Hold(Action),
    /// Grabs or lets go: `{"type": "grab"}`.
    Grab,
    /// Is ready for what comes next: `{"type": "ready"}`.
    Ready,
    /// Looks elsewhere, or back: `{"type": "away", "away": true}`.
    Away(bool),
    /// Leaves for good: `{"type": "leave"}`.
    Leave,
}

#[derive(Deserialize)]
#[serde(tag = "type", rename_all = "lowercase", deny_unknown_fields)]
enum Written {
    Hold { action: String },
    Grab {},
    Ready {},
    Away { away: bool },
    Leave {},
}

impl FromPlayer {
    /// Reads a message.
    ///
    /// # Errors
    /// [`MessageError`].
    pub fn parse(text: &str) -> Result<Self, MessageError> {
        Ok(match parse_as(text).map_err(MessageError::Malformed)? {
            Written::Hold { action } => {
                let known = Action::ALL.into_iter().find(|it| it.name() == action);
                Self::Hold(
                    known.ok_or_else(|| MessageError::Action { name: action.chars().take(20).collect() })?,
                )
            }
            Written::Grab {} => Self::Grab,
            Written::Ready {} => Self::Ready,
            Written::Away { away } => Self::Away(away),
            Written::Leave {} => Self::Leave,
        })
    }
}

/// A body as it is seen: x, y (u), angle (rad), vx, vy (u/s), angular velocity (rad/s); rounded to
/// thousandths.
pub type SeenBody = [f64; 6];

/// Everything that an agent's player sees at the end of a step.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Sight {
    /// Steps of the round so far.
    pub step: usize,
    /// For each frame since the last message, oldest first, agents 0 and 1 and the objects: `[x, y, angle]`,
    /// or null if not seen.
    pub frames: Vec<Vec<Option<[f64; 3]>>>,
    /// The seen bodies at the end of the step, with velocities, in the order of `frames`.
    pub bodies: Vec<Option<SeenBody>>,
    /// By agent, the object that it is seen to hold and the side that holds it.
    pub grips: [Option<SeenGrip>; AGENT_COUNT],
    /// Pairs of bodies that are seen to touch, by the indices of `bodies`.
    pub contacts: Vec<[usize; 2]>,
    /// The cells that the player's agent sees, as 100 hexadecimal digits: bit k mod 4 of digit k/4 is cell k,
    /// row by row from the lower left. Absent where players see everything.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub visible: Option<String>,
}

/// A grip as it is seen.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct SeenGrip {
    /// The object's number.
    pub object: usize,
    /// The direction of the side in the agent's frame: x right, y ahead.
    pub side: [f32; 2],
    /// The object's angle minus the agent's (rad).
    pub angle: f32,
}

/// Everything about a round that does not change while it is played.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Stage {
    /// The round, 0 for the practice.
    pub round: usize,
    /// Rounds after the practice.
    pub rounds: usize,
    /// Longest duration (steps).
    pub steps: usize,
    /// Instructions to the player; absent in the practice, which has no goals.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub instructions: Option<Instructions>,
    /// Ends of the inner walls (u).
    pub walls: Vec<[[f32; 2]; 2]>,
    /// Centres of the landmarks (u).
    pub landmarks: Vec<[f32; 2]>,
    /// Radii of agents 0 and 1 and the objects (u).
    pub radii: Vec<f32>,
    /// Colours (`#rrggbb`) of agents, objects and landmarks.
    pub colours: Colours,
}

/// Colours as `#rrggbb`.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Colours {
    /// Of agents 0 and 1.
    pub agents: Vec<String>,
    /// Of objects 0 and 1.
    pub objects: Vec<String>,
    /// Of the landmarks.
    pub landmarks: Vec<String>,
}

/// The activity of a game.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Doing {
    /// It waits for the players to come.
    Gathering,
    /// Players read their instructions, until all are ready.
    Reading,
    /// A round is about to begin, or to go on.
    Countdown,
    /// A round is played.
    Playing,
    /// A player is absent.
    Paused,
    /// It has ended.
    Over,
}

/// Why a game is over.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Ending {
    /// All rounds were played.
    Complete,
    /// A player left.
    Left,
    /// A player was absent for too long.
    Absent,
    /// The simulation failed.
    Failed,
}

/// A message to a player.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
pub enum ToPlayer {
    /// The first message of a connection.
    Welcome {
        /// [`PROTOCOL`].
        protocol: &'static str,
        /// The agent that the player moves.
        agent: AgentId,
        /// That agent by its colour, such as `red agent`.
        you: String,
        /// The part of the world that players see.
        view: View,
        /// Whether the other agent is moved by its mind.
        mind: bool,
        /// Duration of a step on the screen (ms).
        step_ms: u64,
    },
    /// A round.
    Stage(Box<Stage>),
    /// The state of the game.
    State {
        /// Activity of the game.
        doing: Doing,
        /// By agent, whether its player is ready.
        ready: [bool; AGENT_COUNT],
        /// By agent, whether its player is present.
        present: [bool; AGENT_COUNT],
        /// Time until the first step, of a countdown (ms).
        #[serde(skip_serializing_if = "Option::is_none")]
        countdown_ms: Option<u64>,
        /// Why it is over.
        #[serde(skip_serializing_if = "Option::is_none")]
        ending: Option<Ending>,
    },
    /// Everything seen at the end of a step.
    Sight(Box<Sight>),
    /// A round is over.
    Result {
        /// By agent, whether its goal was achieved at the end of the round.
        achieved: [bool; AGENT_COUNT],
    },
    /// A message was not understood, or came too often.
    Problem {
        /// The problem, as a sentence.
        text: String,
    },
}

//! Journals: everything that has to be kept of a game so that it can go on after a crash, one entry a line.

use crate::{GameSettings, message::Ending};
use phase_model::{AGENT_COUNT, Action, Scene, json::parse_as};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};
use thiserror::Error;

/// The value of the field `format` of a journal's first entry.
pub const FORMAT: &str = "phase-game-journal/1";

/// A scene to be played, and the name of the recording that it becomes.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Round {
    /// Id of the recording that it becomes; empty for the practice.
    pub id: String,
    /// Id of the event that the scene was taken from.
    pub source: String,
    /// The scene.
    pub scene: Scene,
    /// Seed of the minds.
    pub seed: u64,
}

/// The actions of both agents in a step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Actions(pub [Action; AGENT_COUNT]);

impl Serialize for Actions {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.map(Action::name).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Actions {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let names = <[String; AGENT_COUNT]>::deserialize(deserializer)?;
        let action = |name: &String| {
            let found = Action::ALL.into_iter().find(|action| action.name() == name);
            found.ok_or_else(|| D::Error::custom(format!("there is no action {name}")))
        };
        Ok(Self([action(&names[0])?, action(&names[1])?]))
    }
}

/// An entry of a game's journal.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(tag = "entry", rename_all = "lowercase", deny_unknown_fields)]
pub enum Entry {
    /// The first one.
    Opened {
        /// [`FORMAT`].
        format: String,
        /// Name of the room.
        room: String,
        /// By agent, what its player has to know to be let in, as the server keeps it.
        keys: [Option<String>; AGENT_COUNT],
        /// The settings.
        settings: Box<GameSettings>,
        /// The practice and then the rounds.
        rounds: Vec<Round>,
    },
    /// A round has begun.
    Began {
        /// Its number, 0 for the practice.
        round: usize,
    },
    /// A step was made.
    Step {
        /// The actions of both agents.
        actions: Actions,
    },
    /// A round has ended.
    Ended {
        /// Its number.
        round: usize,
    },
    /// The game has ended.
    Over {
        /// Why.
        ending: Ending,
    },
}

/// A journal that cannot be used.
#[derive(Debug, Error)]
pub enum JournalError {
    /// An entry that cannot be read.
    #[error("entry {number} is none of a journal of {FORMAT}")]
    Entry {
        /// Its number, from 1.
        number: usize,
        /// Why.
        #[source]
        source: serde_json::Error,
    },
    /// An entry that is not text.
    #[error("entry {number} is not UTF-8")]
    NotText {
        /// Its number, from 1.
        number: usize,
    },
    /// The first entry does not open a room.
    #[error("the first entry must open a room of {FORMAT}")]
    Opening,
    /// A round that does not exist, or entries in an order that no game has.
    #[error("entry {number} does not follow from those before it")]
    Order {
        /// Its number, from 1.
        number: usize,
    },
    /// The minds act otherwise than was recorded, so it was another version of the program.
    #[error("entry {number}: the minds of this version act otherwise")]
    Minds {
        /// Its number, from 1.
        number: usize,
    },
    /// A round cannot be simulated.
    #[error(transparent)]
    Room(#[from] crate::RoomError),
}

/// The part of a journal that counts: a last line without its end does not, for the step in it was never
/// shown to anybody.
///
/// # Errors
/// [`JournalError::NotText`].
pub fn whole(bytes: &[u8]) -> Result<&str, JournalError> {
    let end = bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
    core::str::from_utf8(&bytes[..end]).map_err(|error| {
        let before = &bytes[..error.valid_up_to()];
        JournalError::NotText { number: before.iter().filter(|&&byte| byte == b'\n').count() + 1 }
    })
}

/// Reads a journal. A last line without its end is left out.
///
/// # Errors
/// [`JournalError::Entry`].
pub fn entries(text: &str) -> Result<Vec<Entry>, JournalError> {
    let Some((whole, _)) = text.rsplit_once('\n') else { return Ok(Vec::new()) };
    let entry = |(k, line): (usize, &str)| {
        parse_as(line).map_err(|source| JournalError::Entry { number: k + 1, source })
    };
    // An empty line is none of a journal, wherever it is.
    whole.split('\n').enumerate().map(entry).collect()
}

/// Whether the game of a journal is over, so that nothing of it is left to play. Only its first and last
/// entries are looked at.
#[must_use]
pub fn is_over(entries: &[Entry]) -> bool {
    match (entries.first(), entries.last()) {
        (_, Some(Entry::Over { .. })) => true,
        (Some(Entry::Opened { rounds, .. }), Some(Entry::Ended { round })) => {
            *round >= rounds.len().saturating_sub(1)
        }
        _ => false,
    }
}

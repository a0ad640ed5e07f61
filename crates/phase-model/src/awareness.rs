//! Knowledge that an agent of a scene has without finding it out.

use serde::{Deserialize, Serialize};

/// The level of reasoning (level-k) of an agent that knows nothing of the other's mind.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default, Serialize, Deserialize)]
#[serde(into = "u8", try_from = "u8")]
pub enum Level {
    /// It ignores the other's mind: every intent stays as likely as before.
    Zero,
    /// It infers the other's intent from what it sees the other do.
    #[default]
    One,
    /// It infers, and assumes that the other infers, too: a hinderer plans to be unseen.
    Two,
}

impl Level {
    /// All levels.
    pub const ALL: [Self; 3] = [Self::Zero, Self::One, Self::Two];
}

impl From<Level> for u8 {
    fn from(level: Level) -> Self {
        level as Self
    }
}

impl TryFrom<u8> for Level {
    type Error = &'static str;

    fn try_from(number: u8) -> Result<Self, Self::Error> {
        Self::ALL.get(usize::from(number)).copied().ok_or("a level of reasoning is 0, 1 or 2")
    }
}

/// An agent's knowledge of the other's mind at the start.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
pub enum Knowledge {
    /// The other's goal and strength, as the paper assumes.
    #[default]
    Goals,
    /// Nothing: goal, attitude and strength of the other are uncertain, and it reasons about them at a level.
    Nothing(Level),
}

impl Knowledge {
    /// The level of reasoning; `None` for an agent that knows.
    #[must_use]
    pub const fn level(self) -> Option<Level> {
        match self {
            Self::Goals => None,
            Self::Nothing(level) => Some(level),
        }
    }
}

/// Of which objects an agent knows the place without seeing them.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
pub enum Sight {
    /// Those in its field of view and touch, as in the paper.
    #[default]
    Own,
    /// Those in its field of view and touch, and where all of them were at the start: a move that it does
    /// not see leaves it a false belief.
    Start,
    /// All of them, as if it were told of every move: the true-belief twin of an agent that did not see one.
    Objects,
}

impl Sight {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Own, Self::Start, Self::Objects];

    /// The name used in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Own => "own",
            Self::Start => "start",
            Self::Objects => "objects",
        }
    }
}

/// Knowledge that an agent has without finding it out, and when it begins to act. The default is the paper's.
///
/// In files these are members of an agent: `knows` (`goals`, or `nothing` with a `level`), and `sees`
/// (`own`, `start` or `objects`), and `waits`. At their defaults they are left out.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
pub struct Awareness {
    /// Of the other's mind.
    pub knows: Knowledge,
    /// Of objects.
    pub sees: Sight,
    /// Steps that it watches from where it is before it acts.
    pub waits: u16,
}

/// Most steps that an agent may wait; as many as an event may have.
pub const MOST_WAITING: u16 = 10_000;

impl Awareness {
    /// An agent with its own eyes that knows nothing of the other's mind.
    #[must_use]
    pub const fn ignorant(level: Level) -> Self {
        Self { knows: Knowledge::Nothing(level), sees: Sight::Own, waits: 0 }
    }
}

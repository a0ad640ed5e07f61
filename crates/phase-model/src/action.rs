//! The fourteen actions.

use crate::Vec2;
use serde::{Deserialize, Serialize};

/// An action aᵢ of an agent in one step. Directions are in the agent's own frame: forward is its heading.
///
/// Actions have no arguments: the strength of a push is the agent's, and a diagonal push has 0.707 of it
/// along each axis. An action is therefore one byte, and the number of actions bounds the width of a search.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[repr(u8)]
pub enum Action {
    /// Torque counter-clockwise.
    TurnLeft,
    /// Torque clockwise.
    TurnRight,
    /// Push forward.
    Up,
    /// Push backward.
    Down,
    /// Push to the left.
    Left,
    /// Push to the right.
    Right,
    /// Push forward and to the left.
    UpLeft,
    /// Push forward and to the right.
    UpRight,
    /// Push backward and to the left.
    DownLeft,
    /// Push backward and to the right.
    DownRight,
    /// Lose all linear velocity.
    Stop,
    /// No force; the body slides under the ground's friction.
    NoForce,
    /// Grab the nearest object within reach of one of the four sides.
    Attach,
    /// Release the object held.
    Detach,
}

/// Component of a diagonal push along each axis, as a share of the agent's force.
const DIAGONAL: f32 = 0.707;

impl Action {
    /// All actions, in index order.
    pub const ALL: [Self; 14] = [
        Self::TurnLeft,
        Self::TurnRight,
        Self::Up,
        Self::Down,
        Self::Left,
        Self::Right,
        Self::UpLeft,
        Self::UpRight,
        Self::DownLeft,
        Self::DownRight,
        Self::Stop,
        Self::NoForce,
        Self::Attach,
        Self::Detach,
    ];

    /// The action that does in a reflected arena what this one does: left and right change places.
    #[must_use]
    pub const fn mirrored(self) -> Self {
        match self {
            Self::TurnLeft => Self::TurnRight,
            Self::TurnRight => Self::TurnLeft,
            Self::Left => Self::Right,
            Self::Right => Self::Left,
            Self::UpLeft => Self::UpRight,
            Self::UpRight => Self::UpLeft,
            Self::DownLeft => Self::DownRight,
            Self::DownRight => Self::DownLeft,
            Self::Up | Self::Down | Self::Stop | Self::NoForce | Self::Attach | Self::Detach => self,
        }
    }

    /// Position in [`Action::ALL`].
    #[must_use]
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Direction of the push in the agent's frame (x right, y forward) as a multiple of the agent's maximum
    /// force; diagonals are (±0.707, ±0.707). `None` for actions that do not push.
    #[must_use]
    pub const fn push(self) -> Option<Vec2> {
        match self {
            Self::Up => Some(Vec2::new(0.0, 1.0)),
            Self::Down => Some(Vec2::new(0.0, -1.0)),
            Self::Left => Some(Vec2::new(-1.0, 0.0)),
            Self::Right => Some(Vec2::new(1.0, 0.0)),
            Self::UpLeft => Some(Vec2::new(-DIAGONAL, DIAGONAL)),
            Self::UpRight => Some(Vec2::new(DIAGONAL, DIAGONAL)),
            Self::DownLeft => Some(Vec2::new(-DIAGONAL, -DIAGONAL)),
            Self::DownRight => Some(Vec2::new(DIAGONAL, -DIAGONAL)),
            _ => None,
        }
    }

    /// +1 for turning left, −1 for turning right, 0 for everything else.
    #[must_use]
    pub const fn turn(self) -> f32 {
        match self {
            Self::TurnLeft => 1.0,
            Self::TurnRight => -1.0,
            _ => 0.0,
        }
    }

    /// The name used in files, as the published recordings spell it (`"turnleft"`, `"noforce"` …).
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::TurnLeft => "turnleft",
            Self::TurnRight => "turnright",
            Self::Up => "up",
            Self::Down => "down",
            Self::Left => "left",
            Self::Right => "right",
            Self::UpLeft => "upleft",
            Self::UpRight => "upright",
            Self::DownLeft => "downleft",
            Self::DownRight => "downright",
            Self::Stop => "stop",
            Self::NoForce => "noforce",
            Self::Attach => "attach",
            Self::Detach => "detach",
        }
    }
}

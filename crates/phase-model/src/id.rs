//! Typed ids of agents, objects, landmarks, rooms and wall slots.
//!
//! Every kind of id has its own type, so that an object cannot be confused with an agent or a room with a
//! wall slot. A value always refers to something that a scene may have: numbers from outside are checked
//! once, when they become an id. In files an id is the bare number. Arrays with one element for each agent,
//! object, landmark, room or slot are indexed by ids.

use crate::{AGENT_COUNT, MAX_OBJECTS};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Number of landmarks, and of the rooms they mark.
pub const LANDMARK_COUNT: usize = 4;
/// Number of slots from the arena's centre to its boundary that can hold a wall.
pub const SLOT_COUNT: usize = 4;

/// An id that is out of range for its kind.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
#[error("{kind} must be 0 to {last}, not {number}")]
pub struct IdError {
    /// The kind of the id, such as `agent`.
    pub kind: &'static str,
    /// The maximum valid number.
    pub last: u8,
    /// The number.
    pub number: u64,
}

macro_rules! id {
    (
        $(#[$doc:meta])* $name:ident: $kind:literal, $count:expr;
        $($(#[$constant_doc:meta])* $constant:ident = $number:literal,)+
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
        #[serde(into = "u8", try_from = "u8")]
        pub struct $name(u8);

        impl $name {
            $($(#[$constant_doc])* pub const $constant: Self = Self($number);)+

            /// All values, in number order.
            pub const ALL: [Self; $count] = [$(Self::$constant),+];

            /// The value with a number.
            ///
            /// # Errors
            /// [`IdError`] for a number that is too large.
            pub const fn new(number: u8) -> Result<Self, IdError> {
                if (number as usize) < $count {
                    Ok(Self(number))
                } else {
                    Err(IdError { kind: $kind, last: $count as u8 - 1, number: number as u64 })
                }
            }

            /// The number, as in files.
            #[must_use]
            pub const fn number(self) -> u8 {
                self.0
            }

            /// The number as an index, the position in `ALL`.
            #[must_use]
            pub const fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl core::fmt::Display for $name {
            fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                self.0.fmt(formatter)
            }
        }

        impl From<$name> for u8 {
            fn from(id: $name) -> Self {
                id.number()
            }
        }

        impl From<$name> for usize {
            fn from(id: $name) -> Self {
                id.index()
            }
        }

        impl TryFrom<u8> for $name {
            type Error = IdError;

            fn try_from(number: u8) -> Result<Self, IdError> {
                Self::new(number)
            }
        }

        impl TryFrom<usize> for $name {
            type Error = IdError;

            fn try_from(number: usize) -> Result<Self, IdError> {
                let error = IdError { kind: $kind, last: $count as u8 - 1, number: number as u64 };
                u8::try_from(number).map_err(|_| error).and_then(Self::new)
            }
        }

        impl<T> core::ops::Index<$name> for [T; $count] {
            type Output = T;

            fn index(&self, id: $name) -> &T {
                &self[id.index()]
            }
        }

        impl<T> core::ops::IndexMut<$name> for [T; $count] {
            fn index_mut(&mut self, id: $name) -> &mut T {
                &mut self[id.index()]
            }
        }
    };
}

id! {
    /// One of the two agents.
    AgentId: "agent", AGENT_COUNT;
    /// Agent 0.
    ZERO = 0,
    /// Agent 1.
    ONE = 1,
}

id! {
    /// One of the objects that a scene may have.
    ObjectId: "object", MAX_OBJECTS;
    /// Object 0.
    ZERO = 0,
    /// Object 1.
    ONE = 1,
}

id! {
    /// One of the four landmarks.
    LandmarkId: "landmark", LANDMARK_COUNT;
    /// Landmark 0.
    TOP_LEFT = 0,
    /// Landmark 1.
    TOP_RIGHT = 1,
    /// Landmark 2.
    BOTTOM_RIGHT = 2,
    /// Landmark 3.
    BOTTOM_LEFT = 3,
}

id! {
    /// One of the four rooms. A room has the number of the landmark in it.
    RoomId: "room", LANDMARK_COUNT;
    /// Room 0.
    TOP_LEFT = 0,
    /// Room 1.
    TOP_RIGHT = 1,
    /// Room 2.
    BOTTOM_RIGHT = 2,
    /// Room 3.
    BOTTOM_LEFT = 3,
}

id! {
    /// One of the four slots from the arena's centre to its boundary that can hold a wall. The part of its
    /// slot that a wall leaves open is a door.
    SlotId: "wall slot", SLOT_COUNT;
    /// Slot 0, between rooms 0 and 1.
    UP = 0,
    /// Slot 1, between rooms 0 and 3.
    LEFT = 1,
    /// Slot 2, between rooms 3 and 2.
    DOWN = 2,
    /// Slot 3, between rooms 1 and 2.
    RIGHT = 3,
}

impl AgentId {
    /// The other agent.
    #[must_use]
    pub const fn other(self) -> Self {
        Self(1 - self.0)
    }
}

impl LandmarkId {
    /// The room that the landmark marks.
    #[must_use]
    pub const fn room(self) -> RoomId {
        RoomId(self.0)
    }
}

impl RoomId {
    /// The landmark in the room.
    #[must_use]
    pub const fn landmark(self) -> LandmarkId {
        LandmarkId(self.0)
    }
}

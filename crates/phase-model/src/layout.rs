//! The twenty-two wall layouts and their reflections.
//!
//! Up to four walls radiate from the arena's centre, one in each *slot*: up (between rooms 0 and 1), left (0
//! and 3), down (3 and 2) and right (1 and 2). The part of its slot that a wall leaves open is a door.

use crate::{Entity, LandmarkId, PhysicsConfig, RoomId, Segment, SlotId, State, Vec2, arena};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Length of a slot, from the centre to the boundary (u).
pub const SLOT_LENGTH: f32 = 10.0;
/// Clearance that ways keep between a body and the ends of a door (u); less where the door leaves no room for
/// it.
pub const DOOR_CLEARANCE: f32 = 0.1;

/// The two rooms on either side of each slot.
pub const SLOT_ROOMS: [(RoomId, RoomId); 4] = [
    (RoomId::TOP_LEFT, RoomId::TOP_RIGHT),
    (RoomId::TOP_LEFT, RoomId::BOTTOM_LEFT),
    (RoomId::BOTTOM_LEFT, RoomId::BOTTOM_RIGHT),
    (RoomId::TOP_RIGHT, RoomId::BOTTOM_RIGHT),
];

/// Unit vectors from the centre along each slot.
pub const SLOT_DIRECTIONS: [Vec2; 4] = [Vec2::Y, Vec2::NEG_X, Vec2::NEG_Y, Vec2::X];

impl SlotId {
    /// The room on the other side of the slot from a room beside it.
    #[must_use]
    pub fn beyond(self, room: RoomId) -> RoomId {
        let (a, b) = SLOT_ROOMS[self];
        if a == room { b } else { a }
    }
}

/// A wall in one slot.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Wall {
    /// No wall: the whole slot is open.
    None,
    /// From the centre outwards, this long (u).
    Inner(f32),
    /// From the boundary inwards, this long (u).
    Outer(f32),
}

use Wall::{Inner, None as Open, Outer};

/// The layouts by base number; `BASES[base][slot]`.
const BASES: [[Wall; 4]; 22] = [
    [Open, Open, Open, Open],
    [Inner(10.0), Outer(5.0), Open, Open],
    [Inner(10.0), Inner(5.0), Open, Open],
    [Inner(10.0), Outer(7.5), Open, Open],
    [Inner(10.0), Inner(7.5), Open, Open],
    [Inner(10.0), Open, Outer(5.0), Open],
    [Inner(10.0), Open, Inner(5.0), Open],
    [Inner(10.0), Inner(5.0), Inner(5.0), Open],
    [Inner(10.0), Inner(7.5), Inner(5.0), Open],
    [Inner(5.0), Inner(10.0), Inner(5.0), Open],
    [Inner(7.5), Inner(10.0), Inner(5.0), Open],
    [Inner(10.0), Open, Outer(7.5), Open],
    [Inner(10.0), Open, Inner(7.5), Open],
    [Inner(10.0), Inner(5.0), Inner(7.5), Open],
    [Inner(10.0), Inner(7.5), Inner(7.5), Open],
    [Inner(7.5), Inner(10.0), Inner(7.5), Open],
    [Inner(10.0), Inner(5.0), Inner(5.0), Inner(5.0)],
    [Inner(10.0), Inner(7.5), Inner(5.0), Inner(5.0)],
    [Inner(10.0), Inner(5.0), Inner(7.5), Inner(5.0)],
    [Inner(10.0), Inner(7.5), Inner(7.5), Inner(5.0)],
    [Inner(7.5), Inner(10.0), Inner(7.5), Inner(5.0)],
    [Inner(10.0), Inner(7.5), Inner(7.5), Inner(7.5)],
];

/// The base layouts from which events are made; 1, 3, 5 and 11 exist but no published event uses them.
pub const USED_BASES: [u8; 18] = [0, 2, 4, 6, 7, 8, 9, 10, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21];

/// A reflection of the arena about an axis through its centre; 0 to 3 in files.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(into = "u8", try_from = "u8")]
pub enum Flip {
    /// 0: swaps up and down.
    UpDown,
    /// 1: swaps left and right.
    LeftRight,
    /// 2: in the diagonal y = x through the centre.
    Diagonal,
    /// 3: in the diagonal y = −x through the centre.
    AntiDiagonal,
}

impl Flip {
    /// All flips, in number order.
    pub const ALL: [Self; 4] = [Self::UpDown, Self::LeftRight, Self::Diagonal, Self::AntiDiagonal];

    /// The image of a point (u).
    #[must_use]
    pub fn point(self, point: Vec2) -> Vec2 {
        arena::CENTRE + self.vector(point - arena::CENTRE)
    }

    /// The image of a free vector such as a velocity.
    #[must_use]
    pub const fn vector(self, vector: Vec2) -> Vec2 {
        let Vec2 { x, y } = vector;
        match self {
            Self::UpDown => Vec2::new(x, -y),
            Self::LeftRight => Vec2::new(-x, y),
            Self::Diagonal => Vec2::new(y, x),
            Self::AntiDiagonal => Vec2::new(-y, -x),
        }
    }

    /// The image of an angle (rad). Reflections turn left turns into right turns.
    #[must_use]
    pub const fn angle(self, angle: f32) -> f32 {
        use core::f32::consts::{FRAC_PI_2, PI};
        match self {
            Self::UpDown => PI - angle,
            Self::LeftRight => -angle,
            Self::Diagonal => -FRAC_PI_2 - angle,
            Self::AntiDiagonal => FRAC_PI_2 - angle,
        }
    }

    /// The image of a landmark.
    #[must_use]
    pub const fn landmark(self, landmark: LandmarkId) -> LandmarkId {
        let images = match self {
            Self::UpDown => [3, 2, 1, 0],
            Self::LeftRight => [1, 0, 3, 2],
            Self::Diagonal => [2, 1, 0, 3],
            Self::AntiDiagonal => [0, 3, 2, 1],
        };
        LandmarkId::ALL[images[landmark.index()]]
    }

    /// The image of a room.
    #[must_use]
    pub const fn room(self, room: RoomId) -> RoomId {
        self.landmark(room.landmark()).room()
    }

    /// The slot whose wall is mapped to a slot.
    const fn slot(self, slot: SlotId) -> SlotId {
        let sources = match self {
            Self::UpDown => [2, 1, 0, 3],
            Self::LeftRight => [0, 3, 2, 1],
            Self::Diagonal => [3, 2, 1, 0],
            Self::AntiDiagonal => [1, 0, 3, 2],
        };
        SlotId::ALL[sources[slot.index()]]
    }
}

impl From<Flip> for u8 {
    fn from(flip: Flip) -> Self {
        flip as Self
    }
}

impl TryFrom<u8> for Flip {
    type Error = LayoutError;

    fn try_from(number: u8) -> Result<Self, LayoutError> {
        Self::ALL.get(usize::from(number)).copied().ok_or(LayoutError::Flip(number.into()))
    }
}

/// Share of the length from an agent's base to its origin by which a place directly before a line is before
/// it.
const BEFORE_LINE: f32 = 0.01;

/// An invalid layout number.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
pub enum LayoutError {
    /// The base number is out of range.
    #[error("layout.base must be 0 to 21, not {0}")]
    Base(u64),
    /// The flip number is out of range.
    #[error("layout.flip must be null or 0 to 3, not {0}")]
    Flip(u64),
}

/// Positions of the inner walls: one of 22 base layouts, as it is or reflected.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
pub struct Layout {
    base: u8,
    flip: Option<Flip>,
}

impl Layout {
    /// Number of layouts: every base layout as it is, and in each reflection.
    pub const COUNT: usize = BASES.len() * (1 + Flip::ALL.len());

    /// A layout by its numbers.
    ///
    /// # Errors
    /// [`LayoutError::Base`] past 21.
    pub const fn new(base: u8, flip: Option<Flip>) -> Result<Self, LayoutError> {
        if (base as usize) < BASES.len() {
            Ok(Self { base, flip })
        } else {
            Err(LayoutError::Base(base as u64))
        }
    }

    /// All layouts of the paper's "90 environment layouts": 18 base layouts, each as it is and in four
    /// reflections.
    pub fn all_used() -> impl Iterator<Item = Self> {
        USED_BASES.into_iter().flat_map(|base| {
            core::iter::once(None).chain(Flip::ALL.map(Some)).map(move |flip| Self { base, flip })
        })
    }

    /// The reflection of this layout's base layout.
    #[must_use]
    pub const fn flipped(self, flip: Flip) -> Self {
        Self { base: self.base, flip: Some(flip) }
    }

    /// The base number, 0 to 21.
    #[must_use]
    pub const fn base(self) -> u8 {
        self.base
    }

    /// The reflection applied to it.
    #[must_use]
    pub const fn flip(self) -> Option<Flip> {
        self.flip
    }

    /// Its place among all layouts, below [`COUNT`](Self::COUNT), for tables.
    #[must_use]
    pub const fn index(self) -> usize {
        let flip = match self.flip {
            None => 0,
            Some(flip) => 1 + flip as usize,
        };
        self.base as usize * (1 + Flip::ALL.len()) + flip
    }

    /// The inner walls, by slot (u).
    #[must_use]
    pub fn walls(self) -> Vec<Segment> {
        SlotId::ALL
            .into_iter()
            .filter_map(|slot| {
                let (from, to) = match self.wall(slot) {
                    Open => return None,
                    Inner(length) => (0.0, length),
                    Outer(length) => (SLOT_LENGTH - length, SLOT_LENGTH),
                };
                Some(along(slot, from, to))
            })
            .collect()
    }

    /// The open part of a slot, from the end nearer to the centre to the end nearer to the boundary; `None`
    /// where a full wall closes it.
    #[must_use]
    pub fn opening(self, slot: SlotId) -> Option<Segment> {
        let (from, to) = match self.wall(slot) {
            Open => (0.0, SLOT_LENGTH),
            Inner(length) => (length, SLOT_LENGTH),
            Outer(length) => (0.0, SLOT_LENGTH - length),
        };
        (from < to).then(|| along(slot, from, to))
    }

    /// The place of an entity on its way through the rooms (u): its origin, unless an agent's origin is past
    /// the line of an opening that its base, the widest part, does not fit through. That agent is still on
    /// the side of its base, and its place is directly before the line.
    #[must_use]
    pub fn place_of(self, physics: &PhysicsConfig, state: &State, entity: Entity) -> Vec2 {
        let body = state.body(entity);
        let here = body.position;
        let Entity::Agent(agent) = entity else { return here };
        let agent = physics.agents[agent];
        let from_centre = (here - arena::CENTRE).abs();
        if from_centre.x.min(from_centre.y) > agent.radius {
            return here;
        }
        let base = here - body.forward() * agent.radius;
        let mut part = 1.0_f32;
        for (slot, direction) in SlotId::ALL.into_iter().zip(SLOT_DIRECTIONS) {
            let side = |point: Vec2| direction.perp_dot(point - arena::CENTRE);
            let of_base = side(base);
            let of_origin = side(here);
            if (of_base < 0.0) == (of_origin < 0.0) {
                continue;
            }
            let until = of_base / (of_base - of_origin);
            let is_this_half = direction.dot(base + (here - base) * until - arena::CENTRE) > 0.0;
            let is_closed = self.opening(slot).is_none_or(|opening| opening.length() < agent.width());
            if is_this_half && is_closed {
                part = part.min((until - BEFORE_LINE).max(0.0));
            }
        }
        base + (here - base) * part
    }

    fn wall(self, slot: SlotId) -> Wall {
        let slot = self.flip.map_or(slot, |flip| flip.slot(slot));
        BASES[usize::from(self.base)][slot]
    }
}

/// The part of a slot between two distances from the centre (u).
fn along(slot: SlotId, from: f32, to: f32) -> Segment {
    let direction = SLOT_DIRECTIONS[slot];
    Segment { a: arena::CENTRE + direction * from, b: arena::CENTRE + direction * to }
}

/// The room a point lies in. Points on a border belong to the right and to the bottom.
#[must_use]
pub fn room_of(point: Vec2) -> RoomId {
    match (point.x < arena::CENTRE.x, point.y > arena::CENTRE.y) {
        (true, true) => RoomId::TOP_LEFT,
        (false, true) => RoomId::TOP_RIGHT,
        (false, false) => RoomId::BOTTOM_RIGHT,
        (true, false) => RoomId::BOTTOM_LEFT,
    }
}

//! Distances through rooms and doors as the published planner measures them.
//!
//! Every layout but the open one has at most one way between two rooms, because one wall is always full; so
//! there are no ties between ways, and a reflected layout is treated as its original.

use crate::recorded::{DIAGONAL, ROOM_CORNER};
use phase_model::{
    Layout, RoomId, Segment, Vec2, arena,
    layout::{SLOT_LENGTH, room_of},
};
use phase_navigation::Map;

/// Rooms and the paths between them. Paths cross doors in their middles, and what cannot be reached is as far
/// as the arena is wide, 28.2843 u.
#[derive(Clone, Debug)]
pub struct Rooms(Map);

impl Rooms {
    /// The rooms of a layout.
    #[must_use]
    pub fn new(layout: Layout) -> Self {
        Self(Map::new(layout))
    }

    /// Whether there are no walls, so that the arena is one room.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.0.walls().is_empty()
    }

    /// The door between two rooms next to each other (u).
    #[must_use]
    pub fn door(&self, a: RoomId, b: RoomId) -> Option<Segment> {
        self.0.crossing(a, b).map(|crossing| crossing.opening)
    }

    /// The rooms on the way through the fewest of them, the first and the last included; `None` where there
    /// is no way.
    #[must_use]
    pub fn way(&self, from: RoomId, to: RoomId) -> Option<Vec<RoomId>> {
        let crossings = self.0.way(from, to, 0.0)?;
        Some(core::iter::once(from).chain(crossings.iter().map(|crossing| crossing.to)).collect())
    }

    /// The room after the first on the way; the first itself at its end or where there is no way.
    #[must_use]
    pub fn next(&self, from: RoomId, to: RoomId) -> RoomId {
        self.way(from, to).and_then(|way| way.get(1).copied()).unwrap_or(from)
    }

    /// The doors along a way (u).
    pub fn doors(&self, way: &[RoomId]) -> impl Iterator<Item = Segment> {
        way.windows(2).filter_map(|pair| self.door(pair[0], pair[1]))
    }

    /// Whether a door on the way is narrower than twice this size (u), or there is no way.
    #[must_use]
    pub fn blocked(&self, from: RoomId, to: RoomId, size: f32) -> bool {
        if self.is_open() {
            return false;
        }
        self.way(from, to).is_none_or(|way| self.doors(&way).any(|door| door.length() < 2.0 * size))
    }

    /// Length of the path between two points (u): straight within a room, otherwise through the doors'
    /// points.
    #[must_use]
    pub fn distance(&self, from: Vec2, to: Vec2) -> f32 {
        let start = room_of(from);
        let end = room_of(to);
        if self.is_open() || start == end {
            return from.distance(to);
        }
        let Some(way) = self.way(start, end) else { return DIAGONAL };
        let mut sum = 0.0;
        let mut here = from;
        for door in self.doors(&way) {
            sum += here.distance(door.middle());
            here = door.middle();
        }
        sum + here.distance(to)
    }

    /// Distance of a point from a room (u): to its corner point, straight or through the one door between;
    /// the arena's diagonal where there is none.
    #[must_use]
    pub fn room_distance(&self, from: Vec2, room: RoomId) -> f32 {
        let here = room_of(from);
        if here == room {
            return from.distance(corner(room));
        }
        match self.door(here, room) {
            Some(door) => from.distance(door.middle()) + door.middle().distance(corner(room)),
            None => DIAGONAL,
        }
    }

    /// Whether a wall stands beside the door from one room to the next.
    #[must_use]
    pub fn walled(&self, from: RoomId, to: RoomId) -> bool {
        self.door(from, to).is_none_or(|door| door.length() < SLOT_LENGTH)
    }
}

/// The point of a room near the arena's corner that room distances lead to (u).
#[must_use]
fn corner(room: RoomId) -> Vec2 {
    let towards = (arena::LANDMARKS[room.landmark()] - arena::CENTRE).signum();
    arena::CENTRE + towards * ROOM_CORNER
}

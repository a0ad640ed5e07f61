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
/// as the arena is wide, 28.284 u.
#[derive(Clone, Debug)]
pub struct Rooms {
    is_open: bool,
    doors: [[Option<Segment>; ROOM_COUNT]; ROOM_COUNT],
    ways: [[Option<Way>; ROOM_COUNT]; ROOM_COUNT],
}

const ROOM_COUNT: usize = RoomId::ALL.len();

/// The way from one room to another.
#[derive(Clone, Debug)]
struct Way {
    /// The rooms, the first and the last included.
    rooms: Vec<RoomId>,
    /// The middles of its first and its last door (u).
    ends: Option<(Vec2, Vec2)>,
    /// Length of the path between those (u).
    length: f64,
    /// The narrowest door (u).
    narrowest: f32,
}

impl Rooms {
    /// The rooms of a layout.
    #[must_use]
    pub fn new(layout: Layout) -> Self {
        let map = Map::new(layout);
        let table =
            |from: RoomId| RoomId::ALL.map(|to| map.crossing(from, to).map(|crossing| crossing.opening));
        let way = |from: RoomId, to: RoomId| {
            let crossings = map.way(from, to, 0.0)?;
            let middles: Vec<Vec2> = crossings.iter().map(|crossing| crossing.opening.middle()).collect();
            let widths = crossings.iter().map(|crossing| crossing.opening.length());
            Some(Way {
                rooms: core::iter::once(from).chain(crossings.iter().map(|crossing| crossing.to)).collect(),
                ends: middles.first().copied().zip(middles.last().copied()),
                length: middles.windows(2).map(|pair| apart(pair[0], pair[1])).sum(),
                narrowest: widths.fold(f32::INFINITY, f32::min),
            })
        };
        Self {
            is_open: map.walls().is_empty(),
            doors: RoomId::ALL.map(table),
            ways: RoomId::ALL.map(|from| RoomId::ALL.map(|to| way(from, to))),
        }
    }

    /// Whether there are no walls, so that the arena is one room.
    #[must_use]
    pub const fn is_open(&self) -> bool {
        self.is_open
    }

    /// The door between two rooms next to each other (u).
    #[must_use]
    pub fn door(&self, a: RoomId, b: RoomId) -> Option<Segment> {
        self.doors[a][b]
    }

    /// The rooms on the way through the fewest of them, the first and the last included; `None` where there
    /// is no way.
    #[must_use]
    pub fn way(&self, from: RoomId, to: RoomId) -> Option<&[RoomId]> {
        self.ways[from][to].as_ref().map(|way| way.rooms.as_slice())
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
        !self.is_open && self.ways[from][to].as_ref().is_none_or(|way| way.narrowest < 2.0 * size)
    }

    /// Length of the path between two points (u): straight within a room, otherwise through the doors'
    /// points.
    #[must_use]
    pub fn distance(&self, from: Vec2, to: Vec2) -> f64 {
        let start = room_of(from);
        let end = room_of(to);
        if self.is_open || start == end {
            return apart(from, to);
        }
        match &self.ways[start][end] {
            Some(Way { ends: Some((first, last)), length, .. }) => {
                apart(from, *first) + length + apart(*last, to)
            }
            _ => DIAGONAL,
        }
    }

    /// Distance of a point from a room (u): to its corner point, straight or through the one door between;
    /// the arena's diagonal where there is none.
    #[must_use]
    pub fn room_distance(&self, from: Vec2, room: RoomId) -> f64 {
        let here = room_of(from);
        if here == room {
            return apart(from, corner(room));
        }
        match self.door(here, room) {
            Some(door) => apart(from, door.middle()) + apart(door.middle(), corner(room)),
            None => DIAGONAL,
        }
    }

    /// Whether a wall stands beside the door from one room to the next.
    #[must_use]
    pub fn walled(&self, from: RoomId, to: RoomId) -> bool {
        self.door(from, to).is_none_or(|door| door.length() < SLOT_LENGTH)
    }
}

/// Distance of two points (u), in the precision of the original.
fn apart(a: Vec2, b: Vec2) -> f64 {
    a.as_dvec2().distance(b.as_dvec2())
}

/// The point of a room near the arena's corner that room distances lead to (u).
fn corner(room: RoomId) -> Vec2 {
    let towards = (arena::LANDMARKS[room.landmark()] - arena::CENTRE).signum();
    arena::CENTRE + towards * ROOM_CORNER
}

//! Rooms, doors and distances: the map on which the published planner thinks.
//!
//! Every layout but the open one has at most one way between two rooms, because one wall is always full; so there are no
//! ties between ways, and a reflected layout is treated as its original.

use phase_model::{
    Layout, RoomId, SlotId, Vec2, arena,
    layout::{SLOT_LENGTH, SLOT_ROOMS, room_of},
};

/// Length of the arena's diagonal (u), as the planner has it: the distance of what cannot be reached, and the scale of
/// rewards.
pub const FARTHEST: f32 = 28.284;
/// Distance along each axis of a room's corner point from the arena's centre (u).
const CORNER: f32 = 8.75;

/// The rooms of a layout and the doors between them.
#[derive(Clone, Debug)]
pub struct Rooms {
    open: bool,
    doors: [Option<Door>; 4],
}

/// A door: what a wall leaves open.
#[derive(Clone, Copy, Debug)]
pub struct Door {
    /// Where paths cross it: its middle (u).
    pub point: Vec2,
    /// How wide it is (u).
    pub width: f32,
    rooms: (RoomId, RoomId),
}

/// A way from room to room: the rooms, the first and the last included.
pub type Way = Vec<RoomId>;

impl Rooms {
    /// The rooms of a layout.
    #[must_use]
    pub fn new(layout: Layout) -> Self {
        let doors = SlotId::ALL.map(|slot| {
            let opening = layout.opening(slot)?;
            Some(Door { point: opening.middle(), width: opening.length(), rooms: SLOT_ROOMS[slot] })
        });
        Self { open: layout.walls().is_empty(), doors }
    }

    /// Whether there are no walls, so that the arena is one room.
    #[must_use]
    pub const fn is_open(&self) -> bool {
        self.open
    }

    /// The door between two rooms next to each other.
    #[must_use]
    pub fn door(&self, a: RoomId, b: RoomId) -> Option<&Door> {
        self.doors.iter().flatten().find(|door| door.rooms == (a, b) || door.rooms == (b, a))
    }

    /// The way through the fewest rooms; `None` where there is none.
    #[must_use]
    pub fn way(&self, from: RoomId, to: RoomId) -> Option<Way> {
        let mut ways = vec![vec![from]];
        // No way is longer than the number of rooms.
        for _ in RoomId::ALL {
            if let Some(way) = ways.iter().find(|way| way.last() == Some(&to)) {
                return Some(way.clone());
            }
            let longer = ways.iter().flat_map(|way| {
                let next = RoomId::ALL.into_iter().filter(|room| {
                    !way.contains(room) && way.last().is_some_and(|&last| self.door(last, *room).is_some())
                });
                next.map(|room| way.iter().copied().chain([room]).collect::<Way>())
            });
            ways = longer.collect();
        }
        None
    }

    /// The room after the first on the way; the first itself at its end or where there is no way.
    #[must_use]
    pub fn next(&self, from: RoomId, to: RoomId) -> RoomId {
        self.way(from, to).and_then(|way| way.get(1).copied()).unwrap_or(from)
    }

    /// The doors along a way.
    pub fn doors<'a>(&'a self, way: &'a [RoomId]) -> impl Iterator<Item = &'a Door> {
        way.windows(2).filter_map(|pair| self.door(pair[0], pair[1]))
    }

    /// Whether a door on the way is narrower than twice this size (u), or there is no way.
    #[must_use]
    pub fn blocked(&self, from: RoomId, to: RoomId, size: f32) -> bool {
        if self.open {
            return false;
        }
        self.way(from, to).is_none_or(|way| self.doors(&way).any(|door| door.width < 2.0 * size))
    }

    /// Length of the path between two points (u): straight within a room, otherwise through the doors' points.
    #[must_use]
    pub fn distance(&self, from: Vec2, to: Vec2) -> f32 {
        let (start, end) = (room_of(from), room_of(to));
        if self.open || start == end {
            return from.distance(to);
        }
        let Some(way) = self.way(start, end) else { return FARTHEST };
        let (mut sum, mut here) = (0.0, from);
        for door in self.doors(&way) {
            sum += here.distance(door.point);
            here = door.point;
        }
        sum + here.distance(to)
    }

    /// Distance of a point from a room (u): to its corner point, straight or through the one door between; the arena's
    /// diagonal where there is none.
    #[must_use]
    pub fn room_distance(&self, from: Vec2, room: RoomId) -> f32 {
        let here = room_of(from);
        if here == room {
            return from.distance(corner(room));
        }
        match self.door(here, room) {
            Some(door) => from.distance(door.point) + door.point.distance(corner(room)),
            None => FARTHEST,
        }
    }

    /// Whether a wall stands beside the door from one room to the next.
    #[must_use]
    pub fn walled(&self, from: RoomId, to: RoomId) -> bool {
        self.door(from, to).is_none_or(|door| door.width < SLOT_LENGTH)
    }
}

/// The point of a room near the arena's corner that room distances lead to (u).
#[must_use]
pub fn corner(room: RoomId) -> Vec2 {
    let towards = (arena::LANDMARKS[room.landmark()] - arena::CENTRE).signum();
    arena::CENTRE + towards * CORNER
}

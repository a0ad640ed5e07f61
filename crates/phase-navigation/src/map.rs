//! The rooms of a layout, the openings between them, and which part of each a mover may cross.

use crate::{
    Gaps, Mover,
    ways::{Crossing, Ways, ways},
};
use phase_model::{
    Layout, RoomId, Segment, SlotId,
    layout::{DOOR_CLEARANCE, SLOT_LENGTH},
};
use std::sync::OnceLock;

/// Rooms, inner walls and openings of a layout, and the ways from room to room.
///
/// The only home of what is known of doors: [`ways`](Self::ways) and [`way`](Self::way) say through which
/// rooms a body gets from one to another, [`route`](Self::route) how long that is, and a
/// [`Field`](crate::Field) says it around corners and obstacles.
///
/// ```
/// use phase_model::{Layout, RoomId};
/// use phase_navigation::Map;
///
/// let map = Map::new(Layout::new(4, None)?); // a full wall above the centre, a door of 2.5 u on the left
/// let rooms = |width| map.way(RoomId::TOP_RIGHT, RoomId::TOP_LEFT, width).map(|way| way.len());
/// assert_eq!(rooms(2.4), Some(3)); // all the way round
/// assert_eq!(rooms(2.6), None); // too wide for the door
/// # Ok::<(), phase_model::LayoutError>(())
/// ```
///
/// A map is a reference to what is worked out once for each layout.
#[derive(Clone, Copy, Debug)]
pub struct Map(&'static Rooms);

/// The rooms of a layout.
#[derive(Debug)]
struct Rooms {
    layout: Layout,
    walls: Vec<Segment>,
    gaps: Gaps,
    ways: Ways,
}

/// The rooms of every layout, by its index, once they are asked for.
static ROOMS: [OnceLock<Rooms>; Layout::COUNT] = [const { OnceLock::new() }; Layout::COUNT];

/// The part of a slot that a mover may pass.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Passage {
    /// A wall fills the slot.
    Wall,
    /// The opening is narrower than the mover; its middle (u from the centre).
    Closed(f32),
    /// The mover's centre may cross between these distances from the arena's centre (u).
    Open(f32, f32),
}

impl Map {
    /// The map of a layout.
    #[must_use]
    pub fn new(layout: Layout) -> Self {
        let rooms = || Rooms { layout, walls: layout.walls(), gaps: Gaps::of(layout), ways: ways(layout) };
        Self(ROOMS[layout.index()].get_or_init(rooms))
    }

    /// The layout.
    #[must_use]
    pub const fn layout(&self) -> Layout {
        self.0.layout
    }

    /// The inner walls (u).
    #[must_use]
    pub const fn walls(&self) -> &'static [Segment] {
        self.0.walls.as_slice()
    }

    /// The openings of the layout itself, without any bodies in them.
    #[must_use]
    pub const fn gaps(&self) -> &'static Gaps {
        &self.0.gaps
    }

    /// The step from a room to one next to it; `None` where a full wall is in between, and for rooms that are
    /// not next to each other.
    #[must_use]
    pub fn crossing(&self, from: RoomId, to: RoomId) -> Option<Crossing> {
        Crossing::out_of(self.0.layout, from).find(|step| step.to == to)
    }

    /// All ways from one room to another that visit no room twice, the shortest first; none from a room to
    /// itself.
    #[must_use]
    pub fn ways(&self, from: RoomId, to: RoomId) -> &'static [Vec<Crossing>] {
        &self.0.ways[from][to]
    }

    /// The way from one room to another through the fewest openings, each at least this wide (u); empty from
    /// a room to itself, `None` where there is no such way.
    #[must_use]
    pub fn way(&self, from: RoomId, to: RoomId, width: f32) -> Option<&[Crossing]> {
        if from == to {
            return Some(&[]);
        }
        let is_wide = |way: &&Vec<Crossing>| way.iter().all(|step| self.0.gaps.width(step.slot) >= width);
        self.ways(from, to).iter().find(is_wide).map(Vec::as_slice)
    }

    /// The rooms other than the given one, grouped by whether they are connected without it; the smaller
    /// groups first.
    #[must_use]
    pub fn regions_around(&self, room: RoomId) -> Vec<Vec<RoomId>> {
        let mut regions: Vec<Vec<RoomId>> = Vec::new();
        for other in RoomId::ALL.into_iter().filter(|&other| other != room) {
            let is_beside = |it: &RoomId| Crossing::out_of(self.0.layout, other).any(|step| step.to == *it);
            let (joined, apart): (Vec<_>, Vec<_>) =
                regions.into_iter().partition(|region: &Vec<RoomId>| region.iter().any(is_beside));
            regions = apart;
            regions.push(joined.into_iter().flatten().chain([other]).collect());
        }
        regions.sort_by_key(Vec::len);
        regions
    }

    /// Whether a mover is narrower than the opening of a slot.
    #[must_use]
    pub fn fits(&self, slot: SlotId, mover: Mover) -> bool {
        self.0.gaps.0[slot].is_some() && self.0.gaps.width(slot) >= 2.0 * mover.half_width
    }

    /// Whether a wall ends or passes at the arena's centre.
    fn centre_is_walled(&self) -> bool {
        self.0.gaps.0.iter().any(|opening| opening.is_none_or(|(low, _)| low > 0.0))
    }

    /// The part of a slot that a mover's centre may cross.
    ///
    /// An end of the opening keeps the mover off by its half width and [`DOOR_CLEARANCE`], except where there
    /// is no wall: at the centre of an arena without walls, and at the boundary of a slot without a wall of
    /// its own.
    pub(crate) fn passage(&self, slot: SlotId, mover: Mover) -> Passage {
        let Some((low, high)) = self.0.gaps.0[slot] else { return Passage::Wall };
        if !self.fits(slot, mover) {
            return Passage::Closed(0.5 * (low + high));
        }
        let margin = (mover.half_width + DOOR_CLEARANCE).min(0.5 * (high - low));
        let from = if self.centre_is_walled() { low + margin } else { low };
        let to = if high - low < SLOT_LENGTH { high - margin } else { high };
        Passage::Open(from, to.max(from))
    }

    /// The ends of walls around which paths bend in one slot: the position along the slot (u) of each.
    pub(crate) fn corners(&self, slot: SlotId) -> impl Iterator<Item = f32> {
        let (low, high) = self.0.gaps.0[slot].unwrap_or((SLOT_LENGTH, SLOT_LENGTH));
        let is_corner = |end: f32| end < SLOT_LENGTH && (end > 0.0 || self.centre_is_walled());
        [low, high].into_iter().filter(move |&end| is_corner(end))
    }
}

//! The doors of a layout, and which part of each a mover may cross.

use crate::Mover;
use phase_model::{
    Layout, Segment, SlotId, Vec2, arena,
    layout::{SLOT_DIRECTIONS, SLOT_LENGTH},
};

/// Clearance between a mover and the ends of a door (u); less where the door leaves no room for it.
pub const CLEARANCE: f32 = 0.1;

/// Inner walls and openings of a layout.
#[derive(Clone, Debug)]
pub struct Map {
    layout: Layout,
    walls: Vec<Segment>,
    /// The opening of each slot, as distances from the arena's centre (u).
    openings: [Option<(f32, f32)>; 4],
}

/// How a mover passes a slot.
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
        let openings = SlotId::ALL.map(|slot| {
            let along = |point: Vec2| (point - arena::CENTRE).dot(SLOT_DIRECTIONS[slot]);
            layout.opening(slot).map(|opening| (along(opening.a), along(opening.b)))
        });
        Self { layout, walls: layout.walls(), openings }
    }

    /// The layout.
    #[must_use]
    pub const fn layout(&self) -> Layout {
        self.layout
    }

    /// The inner walls (u).
    #[must_use]
    pub fn walls(&self) -> &[Segment] {
        &self.walls
    }

    /// Whether a mover is narrower than the opening of a slot.
    #[must_use]
    pub fn fits(&self, slot: SlotId, mover: Mover) -> bool {
        self.openings[slot].is_some_and(|(low, high)| high - low >= 2.0 * mover.half_width)
    }

    /// Whether a wall ends or passes at the arena's centre.
    fn centre_is_walled(&self) -> bool {
        self.openings.iter().any(|opening| opening.is_none_or(|(low, _)| low > 0.0))
    }

    /// The part of a slot that a mover's centre may cross.
    ///
    /// An end of the opening keeps the mover off by its half width and [`CLEARANCE`], except where there is no
    /// wall: at the centre of an arena without walls, and at the boundary of a slot without a wall of its own.
    pub(crate) fn passage(&self, slot: SlotId, mover: Mover) -> Passage {
        let Some((low, high)) = self.openings[slot] else { return Passage::Wall };
        if !self.fits(slot, mover) {
            return Passage::Closed(0.5 * (low + high));
        }
        let margin = (mover.half_width + CLEARANCE).min(0.5 * (high - low));
        let from = if self.centre_is_walled() { low + margin } else { low };
        let to = if high - low < SLOT_LENGTH { high - margin } else { high };
        Passage::Open(from, to.max(from))
    }

    /// The ends of walls around which paths bend in one slot: the position along the slot (u) of each.
    pub(crate) fn corners(&self, slot: SlotId) -> impl Iterator<Item = f32> {
        let (low, high) = self.openings[slot].unwrap_or((SLOT_LENGTH, SLOT_LENGTH));
        let is_corner = |end: f32| end < SLOT_LENGTH && (end > 0.0 || self.centre_is_walled());
        [low, high].into_iter().filter(move |&end| is_corner(end))
    }
}

/// The point of a slot at a distance from the centre (u).
pub(crate) fn point_in(slot: SlotId, distance: f32) -> Vec2 {
    arena::CENTRE + SLOT_DIRECTIONS[slot] * distance
}

//! The cost of a straight leg: its length, and more where it cuts a corner or crosses an obstacle.

use crate::{
    Disc, Map, Mover, NavigationParameters, accuracy::PASSAGE_TOLERANCE, gaps::point_in, map::Passage,
};
use phase_model::{
    RoomId, SlotId, Vec2, arena,
    layout::{SLOT_DIRECTIONS, SLOT_ROOMS},
};

/// Radius of a margin relative to the circle through the eight points around its corner: cos 22.5°, so that
/// the straight legs between the points do not enter the margin.
const MARGIN_RATIO: f32 = 0.923_879_5;

/// Walls, doors and obstacles as one mover meets them.
#[derive(Clone, Debug)]
pub(crate) struct Terrain {
    pub(crate) passages: [Passage; 4],
    pub(crate) corners: Vec<Corner>,
    /// Obstacles, grown by the mover's half width.
    pub(crate) obstacles: Vec<Disc>,
    obstruction: f32,
    corner_price: f32,
}

/// The end of a wall around which paths bend.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    pub(crate) position: Vec2,
    /// Radius of the circle on which paths bend (u).
    pub(crate) radius: f32,
    /// A slot that the corner belongs to; another one for the arena's centre.
    pub(crate) slot: SlotId,
    /// The rooms on both sides of its slots, one bit each. The wall hides the corner from the others.
    rooms: u8,
}

impl Terrain {
    pub(crate) fn new(map: &Map, mover: Mover, obstacles: &[Disc], parameters: NavigationParameters) -> Self {
        let passages = SlotId::ALL.map(|slot| map.passage(slot, mover));
        let mut corners: Vec<Corner> = Vec::with_capacity(passages.len());
        for slot in SlotId::ALL {
            let Passage::Open(from, to) = passages[slot] else { continue };
            let (a, b) = SLOT_ROOMS[slot];
            let rooms = 1 << a.index() | 1 << b.index();
            for end in map.corners(slot) {
                let position = point_in(slot, end);
                let radius = (end - from).abs().min((end - to).abs());
                match corners.iter_mut().find(|corner| corner.position == position) {
                    Some(corner) => {
                        corner.radius = corner.radius.min(radius);
                        corner.rooms |= rooms;
                    }
                    None => corners.push(Corner { position, radius, slot, rooms }),
                }
            }
        }
        let grow = |disc: &Disc| Disc { radius: disc.radius + mover.half_width, ..*disc };
        let obstacles = obstacles.iter().map(grow).collect();
        Self {
            passages,
            corners,
            obstacles,
            obstruction: parameters.obstruction,
            corner_price: parameters.corner,
        }
    }

    /// Cost of a path's only leg (u): inside one room corners do not matter.
    pub(crate) fn only_leg(&self, a: Vec2, b: Vec2) -> Option<f32> {
        if rooms_of(a) & rooms_of(b) == 0 {
            return self.leg(a, b);
        }
        Some(a.distance(b) + self.obstruction_on(a, b))
    }

    /// Cost of the straight leg between two points (u); `None` if a wall or a closed door is in between.
    pub(crate) fn leg(&self, a: Vec2, b: Vec2) -> Option<f32> {
        let p = a - arena::CENTRE;
        let q = b - arena::CENTRE;
        for [positive, negative] in [[SlotId::UP, SlotId::DOWN], [SlotId::RIGHT, SlotId::LEFT]] {
            let along = SLOT_DIRECTIONS[positive];
            let across = along.perp();
            let side_p = across.dot(p);
            let side_q = across.dot(q);
            if side_p * side_q > 0.0 {
                continue;
            }
            let at_p = along.dot(p);
            let at_q = along.dot(q);
            if side_p == 0.0 && side_q == 0.0 {
                // Along the line itself: only within one opening.
                for slot in [positive, negative] {
                    let sign = if slot == positive { 1.0 } else { -1.0 };
                    let s = sign * at_p;
                    let t = sign * at_q;
                    if s.max(t) > 0.0 && !self.is_open(slot, s.max(0.0), t.max(0.0)) {
                        return None;
                    }
                }
                continue;
            }
            let crossing = at_p + (at_q - at_p) * (side_p / (side_p - side_q));
            let slot = if crossing >= 0.0 { positive } else { negative };
            // A leg that ends on the line does not cross it.
            if side_p != 0.0 && side_q != 0.0 && !self.is_open(slot, crossing.abs(), crossing.abs()) {
                return None;
            }
        }
        let rooms = rooms_of(a) | rooms_of(b);
        let margin = |corner: &Corner| {
            Disc { centre: corner.position, radius: corner.radius * MARGIN_RATIO }.chord(a, b)
        };
        let in_margins: f32 =
            self.corners.iter().filter(|corner| corner.rooms & rooms != 0).map(margin).sum();
        Some(a.distance(b) + self.corner_price * in_margins + self.obstruction_on(a, b))
    }

    /// Length that obstacles add to the length of a leg (u).
    fn obstruction_on(&self, a: Vec2, b: Vec2) -> f32 {
        self.obstruction * self.obstacles.iter().map(|disc| disc.chord(a, b)).sum::<f32>()
    }

    fn is_open(&self, slot: SlotId, s: f32, t: f32) -> bool {
        let Passage::Open(from, to) = self.passages[slot] else { return false };
        s.min(t) >= from - PASSAGE_TOLERANCE && s.max(t) <= to + PASSAGE_TOLERANCE
    }
}

/// The rooms that a point belongs to, one bit each; two on the line between them.
fn rooms_of(point: Vec2) -> u8 {
    let Vec2 { x, y } = point - arena::CENTRE;
    let bit = |room: RoomId, is_inside: bool| u8::from(is_inside) << room.index();
    bit(RoomId::TOP_LEFT, x <= 0.0 && y >= 0.0)
        | bit(RoomId::TOP_RIGHT, x >= 0.0 && y >= 0.0)
        | bit(RoomId::BOTTOM_RIGHT, x >= 0.0 && y <= 0.0)
        | bit(RoomId::BOTTOM_LEFT, x <= 0.0 && y <= 0.0)
}

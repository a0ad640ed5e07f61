//! The points at which shortest paths can bend.

use crate::{
    Disc, Map, Mover,
    accuracy::{RING, RING_GAP},
    gaps::point_in,
    map::Passage,
    terrain::{Corner, Terrain},
};
use phase_model::{SlotId, Vec2, arena, layout::SLOT_DIRECTIONS};

/// 1 / cos(180° / [`RING`]): the straight legs between the points of a ring this much larger than the
/// obstacle do not cross it.
const RING_RATIO: f32 = 1.019_591_1;
/// cos and sin of 22.5°, the angle between neighbouring points of a ring.
const RING_TURN: Vec2 = Vec2::new(0.923_879_5, 0.382_683_43);
/// Sine and cosine of 45°.
const DIAGONAL: f32 = core::f32::consts::FRAC_1_SQRT_2;

/// A point at which a path may bend.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bend {
    /// Position (u).
    pub(crate) position: Vec2,
    /// Whether the point is in a door that is narrower than the mover.
    pub(crate) is_closed: bool,
}

/// The points in doors, around the corners of passable doors, and around obstacles that leave room.
pub(crate) fn bends(map: &Map, terrain: &Terrain, mover: Mover) -> Vec<Bend> {
    let mut bends = Vec::new();
    for slot in SlotId::ALL {
        match terrain.passages[slot] {
            Passage::Wall => {}
            Passage::Closed(middle) => {
                bends.push(Bend { position: point_in(slot, middle), is_closed: true });
            }
            Passage::Open(from, to) => {
                // In an arena without walls nothing bends.
                if !terrain.corners.is_empty() {
                    push(&mut bends, point_in(slot, from));
                    push(&mut bends, point_in(slot, to));
                }
            }
        }
    }
    for corner in &terrain.corners {
        around_corner(&mut bends, corner);
    }
    for obstacle in &terrain.obstacles {
        around_obstacle(&mut bends, map, *obstacle, mover);
    }
    bends
}

fn push(bends: &mut Vec<Bend>, position: Vec2) {
    if arena::contains(position) && !bends.iter().any(|bend| bend.position == position) {
        bends.push(Bend { position, is_closed: false });
    }
}

/// The points around the end of a wall on both sides of a slot. At the arena's centre only the diagonals are
/// free of the lines of other slots, which have points of their own.
fn around_corner(bends: &mut Vec<Bend>, corner: &Corner) {
    let along = SLOT_DIRECTIONS[corner.slot];
    let across = along.perp();
    let is_centre = corner.position == arena::CENTRE;
    for side in [across, -across] {
        for direction in [(along + side) * DIAGONAL, (side - along) * DIAGONAL] {
            push(bends, corner.position + direction * corner.radius);
        }
        if !is_centre {
            push(bends, corner.position + side * corner.radius);
        }
    }
}

/// A ring around an obstacle, without the points where the mover would not fit between obstacle and wall.
fn around_obstacle(bends: &mut Vec<Bend>, map: &Map, obstacle: Disc, mover: Mover) {
    let inset = Vec2::splat(mover.half_width);
    for point in ring(obstacle) {
        let is_inside = arena::contains(point - inset) && arena::contains(point + inset);
        if is_inside && map.walls().iter().all(|wall| wall.distance(point) >= mover.half_width) {
            push(bends, point);
        }
    }
}

/// The points around a disc at which paths bend; the straight legs between neighbours do not cross it.
pub(crate) fn ring(disc: Disc) -> impl Iterator<Item = Vec2> {
    let radius = disc.radius * RING_RATIO + RING_GAP;
    let mut direction = Vec2::X;
    (0..RING).map(move |_| {
        let point = disc.centre + direction * radius;
        direction = RING_TURN.rotate(direction);
        point
    })
}

//! The moment at which a moving body reaches a wall, so that nothing tunnels.
//!
//! The method is conservative advancement along a separating axis: find the closest features of body and wall
//! at the present time, find the latest time at which they are still apart along their axis, and repeat from
//! there.

use crate::{
    body::{BodyMotion, Shape},
    constants::{LINEAR_SLOP, SKIN},
    polygon::Polygon,
    turn::turned,
    wall::Wall,
};
use phase_model::Vec2;

/// Tolerance of the distance at which a body counts as having reached a wall (u).
const TOLERANCE: f32 = 0.25 * LINEAR_SLOP;
const AXES: usize = 20;
const DEEPER: usize = 8;
const ROOTS: usize = 50;

/// A body's path through (part of) a substep, straight and with uniform rotation, from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sweep {
    pub(crate) from: Vec2,
    pub(crate) to: Vec2,
    pub(crate) from_angle: f32,
    pub(crate) to_angle: f32,
    /// Unit vector to the body's right at the start of the path.
    pub(crate) right: Vec2,
}

impl Sweep {
    /// Removes the first share of the path.
    pub(crate) fn skip(&mut self, share: f32) {
        self.from += (self.to - self.from) * share;
        let by = (self.to_angle - self.from_angle) * share;
        self.from_angle += by;
        self.right = turned(self.right, by);
    }

    #[inline]
    fn at(&self, share: f32) -> BodyMotion {
        let by = (self.to_angle - self.from_angle) * share;
        BodyMotion {
            centre: self.from * (1.0 - share) + self.to * share,
            right: if by == 0.0 { self.right } else { turned(self.right, by) },
            ..BodyMotion::AT_REST
        }
    }
}

/// The moment at which a body on its path reaches a wall, as a share of the path; `None` if it does not, or
/// if it overlaps the wall from the start.
pub(crate) fn time_of_impact(shape: &Shape, sweep: &Sweep, wall: &Wall) -> Option<f32> {
    let polygon = shape.origin > 0.0;
    let target = target(shape);
    let corners: &[Vec2] = if polygon { &shape.corners } else { &shape.corners[..1] };
    let search = Search { shape, corners, sweep, wall, polygon };
    let mut now = 0.0;
    for _ in 0..AXES {
        let (distance, axis) = search.nearest(now)?;
        if distance < target + TOLERANCE {
            return Some(now);
        }
        let mut later = 1.0;
        for _ in 0..DEEPER {
            let (mut gap_later, corner, end) = search.deepest(&axis, later);
            if gap_later > target + TOLERANCE {
                return None;
            }
            if gap_later > target - TOLERANCE {
                now = later;
                break;
            }
            let mut gap_now = search.gap(&axis, corner, end, now);
            if gap_now < target - TOLERANCE {
                return None;
            }
            if gap_now <= target + TOLERANCE {
                return Some(now);
            }
            let mut low = now;
            let mut high = later;
            for root in 0..ROOTS {
                let t = if root % 2 == 1 {
                    low + (target - gap_now) * (high - low) / (gap_later - gap_now)
                } else {
                    0.5 * (low + high)
                };
                let gap = search.gap(&axis, corner, end, t);
                if (gap - target).abs() < TOLERANCE {
                    later = t;
                    break;
                }
                if gap > target {
                    (low, gap_now) = (t, gap);
                } else {
                    (high, gap_later) = (t, gap);
                }
            }
        }
    }
    None
}

/// The distance from a wall, without skins, at which a body counts as having reached it (u).
fn target(shape: &Shape) -> f32 {
    (shape.skin + SKIN - 3.0 * LINEAR_SLOP).max(LINEAR_SLOP)
}

/// Distance from a body's outline (or from a disc's centre) beyond which a wall cannot be reached (u).
fn clearance(shape: &Shape) -> f32 {
    target(shape) + TOLERANCE
}

/// The margin around its box within which a body has to be free of overlaps to be clear (u).
pub(crate) fn room(shape: &Shape) -> f32 {
    let inside = if shape.origin > 0.0 { 0.0 } else { shape.radius };
    target(shape) + TOLERANCE - inside
}

/// A body's outlines at the two ends of its path, by which most walls can be excluded at once.
pub(crate) struct SweepEnds {
    pub(crate) centres: [Vec2; 2],
    /// An agent's outlines.
    pub(crate) polygons: Option<[Polygon; 2]>,
    /// Distance from the outline (or from a disc's centre) within which walls are not excluded (u).
    pub(crate) clear: f32,
}

impl SweepEnds {
    pub(crate) fn new(shape: &Shape, sweep: &Sweep) -> Self {
        let polygons = (shape.origin > 0.0)
            .then(|| [Polygon::new(shape, &sweep.at(0.0)), Polygon::new(shape, &sweep.at(1.0))]);
        Self { centres: [sweep.from, sweep.to], polygons, clear: clearance(shape) }
    }

    /// Whether some axis separates body and wall at both ends of the path: the wall's normal, also for bodies
    /// that lean on it, or the normal of one of the body's sides.
    #[inline]
    pub(crate) fn clear_of(&self, wall: &Wall) -> bool {
        let side = |centre: Vec2| wall.normal.dot(centre - wall.a);
        let before = side(self.centres[0]);
        let after = side(self.centres[1]);
        let Some(polygons) = &self.polygons else {
            return before * after > 0.0 && before.abs() > self.clear && after.abs() > self.clear;
        };
        if before * after > 0.0 {
            let normal = if before > 0.0 { wall.normal } else { -wall.normal };
            let limit = normal.dot(wall.a) + self.clear;
            if polygons.iter().all(|polygon| polygon.corners.iter().all(|c| normal.dot(*c) > limit)) {
                return true;
            }
        }
        (0..4).any(|side| {
            polygons.iter().all(|polygon| {
                let normal = polygon.normals[side];
                let limit = normal.dot(polygon.corners[side]) + self.clear;
                normal.dot(wall.a) > limit && normal.dot(wall.b) > limit
            })
        })
    }
}

/// An axis that separates body and wall.
enum Axis {
    /// From a wall's end to a corner, fixed.
    Points(Vec2),
    /// The wall's normal, on the body's side.
    Wall(Vec2),
    /// A side of the body, which turns with it: normal and a point, in its frame.
    Side(Vec2, Vec2),
}

struct Search<'a> {
    shape: &'a Shape,
    corners: &'a [Vec2],
    sweep: &'a Sweep,
    wall: &'a Wall,
    polygon: bool,
}

impl Search<'_> {
    /// Distance without skins and the axis of the closest features; `None` where body and wall overlap.
    fn nearest(&self, share: f32) -> Option<(f32, Axis)> {
        let motion = self.sweep.at(share);
        let wall = self.wall;
        let side = if wall.normal.dot(motion.centre - wall.a) >= 0.0 { wall.normal } else { -wall.normal };
        if self.polygon && self.overlap(&motion, side) {
            return None;
        }
        let mut best = (f32::MAX, Axis::Points(Vec2::ZERO));
        let along = wall.b - wall.a;
        for corner in self.corners {
            let point = motion.place(*corner);
            let before = along.dot(point - wall.a);
            let after = along.dot(wall.b - point);
            if before > 0.0 && after > 0.0 {
                let gap = side.dot(point - wall.a).abs();
                if gap < best.0 {
                    best = (gap, Axis::Wall(side));
                }
            } else {
                let away = point - if before <= 0.0 { wall.a } else { wall.b };
                let gap = away.length();
                if gap < best.0 {
                    best = (gap, Axis::Points(away.normalize_or_zero()));
                }
            }
        }
        if self.polygon {
            for k in 0..4 {
                let from = self.corners[k];
                let to = self.corners[(k + 1) % 4];
                for end in [wall.a, wall.b] {
                    let end = motion.local_vector(end - motion.centre);
                    if (end - from).dot(to - from) > 0.0 && (end - to).dot(from - to) > 0.0 {
                        let gap = self.shape.normals[k].dot(end - from);
                        if gap >= 0.0 && gap < best.0 {
                            best = (gap, Axis::Side(self.shape.normals[k], (from + to) * 0.5));
                        }
                    }
                }
            }
        }
        (best.0 > 0.0).then_some(best)
    }

    /// Whether neither a side of the body nor the wall itself separates the two.
    fn overlap(&self, motion: &BodyMotion, side: Vec2) -> bool {
        let polygon = Polygon::new(self.shape, motion);
        let a = self.wall.a;
        let b = self.wall.b;
        polygon.corners.iter().any(|corner| side.dot(*corner - a) <= 0.0)
            && (0..4).all(|k| {
                let normal = polygon.normals[k];
                let corner = polygon.corners[k];
                normal.dot(a - corner).min(normal.dot(b - corner)) <= 0.0
            })
    }

    /// The minimum gap along an axis, and the corner and the wall's end between which it is attained.
    fn deepest(&self, axis: &Axis, share: f32) -> (f32, Vec2, Vec2) {
        let motion = self.sweep.at(share);
        let end_along = |axis: Vec2| {
            if axis.dot(self.wall.b) > axis.dot(self.wall.a) { self.wall.b } else { self.wall.a }
        };
        let (corner, end) = match *axis {
            Axis::Points(axis) => (self.corner_against(motion.local_vector(axis)), end_along(axis)),
            Axis::Wall(normal) => (self.corner_against(motion.local_vector(normal)), self.wall.a),
            Axis::Side(normal, _) => (Vec2::ZERO, end_along(-motion.turn(normal))),
        };
        (gap(axis, &motion, corner, end), corner, end)
    }

    fn gap(&self, axis: &Axis, corner: Vec2, end: Vec2, share: f32) -> f32 {
        gap(axis, &self.sweep.at(share), corner, end)
    }

    fn corner_against(&self, direction: Vec2) -> Vec2 {
        let mut best = (f32::MAX, Vec2::ZERO);
        for &corner in self.corners {
            let along = corner.dot(direction);
            if along < best.0 {
                best = (along, corner);
            }
        }
        best.1
    }
}

/// The gap along an axis between a corner of a body and an end of a wall.
fn gap(axis: &Axis, motion: &BodyMotion, corner: Vec2, end: Vec2) -> f32 {
    match *axis {
        Axis::Points(axis) => axis.dot(motion.place(corner) - end),
        Axis::Wall(normal) => normal.dot(motion.place(corner) - end),
        Axis::Side(normal, middle) => motion.turn(normal).dot(end - motion.place(middle)),
    }
}

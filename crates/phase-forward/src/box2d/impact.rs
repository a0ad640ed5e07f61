//! The time at which a moving shape first touches another, found along separating axes.

use super::{
    LINEAR_SLOP,
    distance::{Cache, Corners, distance},
    math::{Sweep, normalised, right_of},
};
use phase_model::Vec2;

/// A shape in motion: corners, thickness of the skin or radius (u), and motion.
pub(super) struct Moving<'a> {
    pub(super) corners: &'a Corners,
    pub(super) radius: f32,
    pub(super) sweep: Sweep,
}

/// An axis along which two shapes are apart.
struct Axis<'a> {
    moving: [&'a Moving<'a>; 2],
    kind: Kind,
    axis: Vec2,
    anchor: Vec2,
}

#[derive(Clone, Copy)]
enum Kind {
    Points,
    /// A side of this shape.
    Side(usize),
}

impl<'a> Axis<'a> {
    /// The axis between the parts that are nearest at a share of the motion.
    fn new(cache: &Cache, moving: [&'a Moving<'a>; 2], share: f32) -> Self {
        let poses = moving.map(|it| it.sweep.at(share));
        let name = |side: usize, k: usize| if side == 0 { cache.names[k].0 } else { cache.names[k].1 };
        let corner = |side: usize, k: usize| moving[side].corners.corners[name(side, k)];
        if cache.count == 1 {
            let between = poses[1].apply(corner(1, 0)) - poses[0].apply(corner(0, 0));
            return Self { moving, kind: Kind::Points, axis: normalised(between).0, anchor: Vec2::ZERO };
        }
        let side = usize::from(name(0, 0) == name(0, 1));
        let from = corner(side, 0);
        let to = corner(side, 1);
        let axis = normalised(right_of(to - from)).0;
        let anchor = 0.5 * (from + to);
        let other = poses[1 - side].apply(corner(1 - side, 0));
        let gap = (other - poses[side].apply(anchor)).dot(poses[side].rotation.turn(axis));
        Self { moving, kind: Kind::Side(side), axis: if gap < 0.0 { -axis } else { axis }, anchor }
    }

    /// The corners that are nearest along the axis at a share of the motion, and their distance.
    fn nearest(&self, share: f32) -> ([usize; 2], f32) {
        let poses = self.moving.map(|it| it.sweep.at(share));
        let farthest = |side: usize, direction: Vec2| {
            self.moving[side].corners.farthest(poses[side].rotation.turn_back(direction))
        };
        let corners = match self.kind {
            Kind::Points => [farthest(0, self.axis), farthest(1, -self.axis)],
            Kind::Side(side) => [farthest(1 - side, -poses[side].rotation.turn(self.axis)); 2],
        };
        (corners, self.gap(corners, share))
    }

    /// The distance of two corners along the axis at a share of the motion.
    fn gap(&self, corners: [usize; 2], share: f32) -> f32 {
        let poses = self.moving.map(|it| it.sweep.at(share));
        let place = |side: usize| poses[side].apply(self.moving[side].corners.corners[corners[side]]);
        match self.kind {
            Kind::Points => (place(1) - place(0)).dot(self.axis),
            Kind::Side(side) => {
                let normal = poses[side].rotation.turn(self.axis);
                (place(1 - side) - poses[side].apply(self.anchor)).dot(normal)
            }
        }
    }
}

/// The share of the motion at which the shapes touch, or `None` if they do not, or overlap.
pub(super) fn time_of_impact(a: &Moving<'_>, b: &Moving<'_>) -> Option<f32> {
    const MAX_ITERATIONS: usize = 20;
    const MAX_PUSHES: usize = 16;
    let a = &Moving { sweep: a.sweep.normalised(), ..*a };
    let b = &Moving { sweep: b.sweep.normalised(), ..*b };
    let target = LINEAR_SLOP.max(a.radius + b.radius - 3.0 * LINEAR_SLOP);
    let tolerance = 0.25 * LINEAR_SLOP;
    let mut cache = Cache::EMPTY;
    let mut share = 0.0;
    for _ in 0..MAX_ITERATIONS {
        let pose_a = a.sweep.at(share);
        let pose_b = b.sweep.at(share);
        let gap = distance((a.corners, &pose_a), (b.corners, &pose_b), &mut cache);
        if gap <= 0.0 {
            return None;
        }
        if gap < target + tolerance {
            return Some(share);
        }
        let axis = Axis::new(&cache, [a, b], share);
        let mut end = 1.0;
        for _ in 0..MAX_PUSHES {
            let (corners, at_end) = axis.nearest(end);
            if at_end > target + tolerance {
                return None;
            }
            if at_end > target - tolerance {
                share = end;
                break;
            }
            let at_start = axis.gap(corners, share);
            if at_start < target - tolerance {
                return None;
            }
            if at_start <= target + tolerance {
                return Some(share);
            }
            end = root(&axis, corners, (share, at_start), (end, at_end), target, tolerance);
        }
    }
    None
}

/// The share of the motion at which two corners are at a distance, between two shares of which the first is
/// before it and the second behind it; the second if it is not found.
fn root(
    axis: &Axis<'_>,
    corners: [usize; 2],
    mut before: (f32, f32),
    behind: (f32, f32),
    target: f32,
    tolerance: f32,
) -> f32 {
    const MAX_ITERATIONS: usize = 50;
    let end = behind.0;
    let mut behind = behind;
    for iteration in 0..MAX_ITERATIONS {
        let share = if iteration % 2 == 1 {
            before.0 + (target - before.1) * (behind.0 - before.0) / (behind.1 - before.1)
        } else {
            0.5 * (before.0 + behind.0)
        };
        let gap = axis.gap(corners, share);
        if (gap - target).abs() < tolerance {
            return share;
        }
        if gap > target {
            before = (share, gap);
        } else {
            behind = (share, gap);
        }
    }
    end
}

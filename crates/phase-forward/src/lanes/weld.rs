//! A grip as a constraint, in each lane; see [`crate::weld`].

use super::{
    motion::{Motions, inverse_mass},
    real::{LaneSet, Real, Twists, Vector, add, at_most, equal, lanes, larger, mask, pick, set, splat},
    worlds::Worlds,
};
use crate::{
    body::Shape,
    constants::{ANGULAR_SLOP, LINEAR_SLOP},
};
use phase_model::Vec2;

/// The grip of one agent of the same object in every lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Welds {
    pub(crate) agent: usize,
    pub(crate) object: usize,
    /// The object's place in the agent's frame, from its centre of mass (u).
    anchor: Vector,
    relative_angle: Real,
    offset: Vector,
    inverse: Symmetric,
    /// Accumulated impulse (N s) and angular impulse (N u s).
    pub(crate) impulse: (Vector, Real),
}

impl Welds {
    /// The constraint of an agent's grip, with the impulse of the substep before.
    pub(crate) fn new(worlds: &Worlds<'_>, agent: usize, object: usize) -> Self {
        let (holder, held) = (&worlds.model.shapes[agent], &worlds.model.shapes[object]);
        let reach = worlds.grip_direction(agent) * splat(holder.radius + held.radius);
        let mut relative_angle = Real::ZERO;
        for (lane, grips) in worlds.grips.iter().enumerate() {
            if let Some(grip) = grips[agent] {
                set(&mut relative_angle, lane, grip.relative_angle);
            }
        }
        Self {
            agent,
            object,
            anchor: reach + Vector::splat(Vec2::new(0.0, holder.origin)),
            relative_angle,
            offset: Vector::ZERO,
            inverse: Symmetric::ZERO,
            impulse: worlds.grasps[agent],
        }
    }

    /// Computes the effect of impulses at the present poses, and applies the accumulated ones in some lanes.
    pub(crate) fn prepare(
        &mut self,
        mask: Real,
        shapes: &[Shape; 5],
        motions: &[Motions; 4],
        twists: &mut [Twists; 4],
    ) {
        self.offset = motions[self.agent].turn(self.anchor);
        self.inverse = response(&shapes[self.agent], &shapes[self.object], self.offset).inverse();
        let (impulse, twist) = self.impulse;
        self.apply(mask, shapes, twists, impulse, twist);
    }

    /// One iteration of the velocity solver in some lanes. Returns the maximum change of an impulse.
    #[inline]
    pub(crate) fn solve(&mut self, mask: Real, shapes: &[Shape; 5], twists: &mut [Twists; 4]) -> Real {
        let (agent, object) = (twists[self.agent], twists[self.object]);
        let slip = object.linear() - agent.linear() - self.offset.perp() * agent.spin;
        let (impulse, twist) = self.inverse.times(-slip, agent.spin - object.spin);
        self.impulse.0.add(mask, impulse);
        add(&mut self.impulse.1, mask, twist);
        self.apply(mask, shapes, twists, impulse, twist);
        mask & larger(larger(impulse.x.abs(), impulse.y.abs()), twist.abs())
    }

    /// One iteration of the position solver. Returns the lanes among the given ones in which the error was negligible.
    pub(crate) fn join(&self, set: LaneSet, shapes: &[Shape; 5], motions: &mut [Motions; 4]) -> LaneSet {
        let mask = mask(set);
        let (shape_a, shape_b) = (&shapes[self.agent], &shapes[self.object]);
        let (agent, object) = (&motions[self.agent], &motions[self.object]);
        let offset = agent.turn(self.anchor);
        let separation = object.centre - agent.centre - offset;
        let twisted = object.angle - agent.angle - self.relative_angle;
        let (impulse, twist) = response(shape_a, shape_b, offset).inverse().times(-separation, -twisted);
        motions[self.agent].shift(mask, shape_a, offset, -impulse, -twist);
        motions[self.object].shift(mask, shape_b, Vector::ZERO, impulse, twist);
        let near = at_most(separation.length_squared(), splat(LINEAR_SLOP * LINEAR_SLOP));
        set & lanes(near & at_most(twisted.abs(), splat(ANGULAR_SLOP)))
    }

    #[inline]
    fn apply(&self, mask: Real, shapes: &[Shape; 5], twists: &mut [Twists; 4], impulse: Vector, twist: Real) {
        let on_agent = Twists::new(impulse, self.offset.perp_dot(impulse) + twist);
        twists[self.agent].push(mask, on_agent, splat(-1.0), inverse_mass(&shapes[self.agent]));
        let on_object = Twists::new(impulse, twist);
        twists[self.object].push(mask, on_object, splat(1.0), inverse_mass(&shapes[self.object]));
    }
}

/// The effect of a unit impulse and a unit twist between an agent, at an offset, and an object's centre.
fn response(agent: &Shape, object: &Shape, offset: Vector) -> Symmetric {
    let mass = splat(agent.inverse_mass + object.inverse_mass);
    let inertia = splat(agent.inverse_inertia);
    Symmetric {
        xx: mass + offset.y * offset.y * inertia,
        xy: -offset.y * offset.x * inertia,
        xz: -offset.y * inertia,
        yy: mass + offset.x * offset.x * inertia,
        yz: offset.x * inertia,
        zz: splat(agent.inverse_inertia + object.inverse_inertia),
    }
}

/// A symmetric 3×3 matrix over (x, y, turn).
#[derive(Clone, Copy, Debug)]
struct Symmetric {
    xx: Real,
    xy: Real,
    xz: Real,
    yy: Real,
    yz: Real,
    zz: Real,
}

impl Symmetric {
    const ZERO: Self = Self {
        xx: Real::ZERO,
        xy: Real::ZERO,
        xz: Real::ZERO,
        yy: Real::ZERO,
        yz: Real::ZERO,
        zz: Real::ZERO,
    };

    /// The inverse, or zero for a singular matrix.
    fn inverse(&self) -> Self {
        let Self { xx, xy, xz, yy, yz, zz } = *self;
        let minors = (yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);
        let determinant = xx * minors.0 + xy * minors.1 + xz * minors.2;
        let singular = equal(determinant, Real::ZERO);
        let scale = pick(singular, Real::ZERO, splat(1.0) / determinant);
        Self {
            xx: scale * minors.0,
            xy: scale * minors.1,
            xz: scale * minors.2,
            yy: scale * (xx * zz - xz * xz),
            yz: scale * (xz * xy - xx * yz),
            zz: scale * (xx * yy - xy * xy),
        }
    }

    #[inline]
    fn times(&self, v: Vector, z: Real) -> (Vector, Real) {
        (
            Vector {
                x: self.xx * v.x + self.xy * v.y + self.xz * z,
                y: self.xy * v.x + self.yy * v.y + self.yz * z,
            },
            self.xz * v.x + self.yz * v.y + self.zz * z,
        )
    }
}

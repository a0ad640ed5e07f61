//! One contact as a constraint, in each lane; see [`crate::contact`].

use super::{
    manifold::{Manifolds, Side},
    motion::Motions,
    real::{
        LaneSet, Real, Twists, Vector, add, at_least, differ, equal, get, lanes, larger, less, mask, pick,
        put, set, smaller, splat,
    },
};
use crate::{
    body::{STATIC, Shape},
    constants::{LINEAR_SLOP, MAX_CORRECTION},
    contact::MAX_CONDITION_NUMBER,
    touching::CachedContact,
};

/// A contact and all data for its solution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contacts {
    /// The key of its pair of shapes.
    pub(crate) key: u8,
    /// First body; [`STATIC`] for walls.
    pub(crate) a: usize,
    /// Second body, never static.
    pub(crate) b: usize,
    pub(crate) manifolds: Manifolds,
    /// Accumulated impulse at each point (N s).
    pub(crate) impulses: [Real; 2],
    skins: Real,
    /// The lanes in which two points are solved together.
    pair: Real,
    /// The twist of a unit impulse at each point for the first and for the second body.
    rows: [[Twists; 2]; 2],
    response: [Real; 3],
    inverse: [Real; 3],
}

/// What is kept of a contact for the next substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trace {
    pub(crate) key: u8,
    live: LaneSet,
    two: LaneSet,
    names: [Real; 2],
    impulses: [Real; 2],
}

impl Trace {
    /// Nothing in any lane.
    pub(crate) fn none(key: u8) -> Self {
        Self { key, live: 0, two: 0, names: [Real::ZERO; 2], impulses: [Real::ZERO; 2] }
    }

    /// Takes over what was kept in one lane.
    pub(crate) fn set(&mut self, lane: usize, kept: &CachedContact) {
        self.live |= 1 << lane;
        self.two |= u8::from(kept.count == 2) << lane;
        for point in 0..2 {
            set(&mut self.names[point], lane, f32::from(kept.names[point]));
            set(&mut self.impulses[point], lane, kept.impulses[point]);
        }
    }

    /// What is kept of one lane; `None` if there is no contact.
    pub(crate) fn get(&self, lane: usize) -> Option<CachedContact> {
        let has = |set: LaneSet| set & 1 << lane != 0;
        if !has(self.live) {
            return None;
        }
        let mut kept = CachedContact { key: self.key, count: 1, ..CachedContact::NONE };
        for point in 0..if has(self.two) { 2 } else { 1 } {
            kept.count = point as u8 + 1;
            kept.names[point] = get(&self.names[point], lane) as u16;
            kept.impulses[point] = get(&self.impulses[point], lane);
        }
        Some(kept)
    }
}

/// The effect of impulses on the two sides of a contact: [`Shape::inverse_mass_vector`] of each.
pub(crate) type Yields = [Twists; 2];

impl Contacts {
    /// A contact that resists only overlaps beyond a tolerated one (u), with zero initial impulses.
    pub(crate) fn new(
        key: usize,
        (a, b): (usize, usize),
        manifolds: Manifolds,
        shapes: &[Shape; 5],
        tolerated: Real,
    ) -> Self {
        Self {
            key: key as u8,
            a,
            b,
            manifolds,
            impulses: [Real::ZERO; 2],
            skins: splat(shapes[a].skin + shapes[b].skin) - tolerated,
            pair: Real::ZERO,
            rows: [[Twists::ZERO; 2]; 2],
            response: [Real::ZERO; 3],
            inverse: [Real::ZERO; 3],
        }
    }

    /// The lanes in which the two touch.
    #[inline(always)]
    pub(crate) fn live(&self) -> LaneSet {
        self.manifolds.live
    }

    /// Whether the first shape is a wall.
    #[inline(always)]
    pub(crate) fn with_wall(&self) -> bool {
        self.a == STATIC
    }

    fn sides<'m>(&self, motions: &'m [Motions; 4]) -> (Side<'m>, &'m Motions) {
        let a = if self.with_wall() { Side::Wall } else { Side::Body(&motions[self.a]) };
        (a, &motions[self.b])
    }

    /// Restores the impulses of points from the substep before.
    pub(crate) fn warm_start(&mut self, before: &Trace) {
        let both = self.live() & before.live;
        if both == 0 {
            return;
        }
        for point in 0..2 {
            let name = self.manifolds.names[point];
            let here = self.having(both, point);
            // The first of the old points with this name.
            let first = mask(here) & equal(before.names[0], name);
            let second = mask(here & before.two) & equal(before.names[1], name) & !first;
            put(&mut self.impulses[point], first, before.impulses[0]);
            put(&mut self.impulses[point], second, before.impulses[1]);
        }
    }

    /// What is kept for the next substep.
    pub(crate) fn trace(&self) -> Trace {
        let Manifolds { live, two, names, .. } = self.manifolds;
        Trace { key: self.key, live, two, names, impulses: self.impulses }
    }

    /// Computes the points of application and the effect of impulses at the present poses, for bodies or rigid groups with the
    /// given centres of mass.
    #[inline]
    pub(crate) fn prepare(
        &mut self,
        shapes: &[Shape; 5],
        motions: &[Motions; 4],
        centres: [Vector; 2],
        yields: &Yields,
    ) {
        let (a, b) = self.sides(motions);
        let (normal, middles) = self.manifolds.middles(a, b, [&shapes[self.a], &shapes[self.b]]);
        let with_wall = self.with_wall();
        for (row, middle) in self.rows.iter_mut().zip(middles) {
            if !with_wall {
                row[0] = Twists::of_impulse(-normal, middle - centres[0]);
            }
            row[1] = Twists::of_impulse(normal, middle - centres[1]);
        }
        let first = self.respond(0, 0, yields);
        self.response[0] = first;
        self.pair = Real::ZERO;
        if self.manifolds.two != 0 {
            let (cross, second) = (self.respond(0, 1, yields), self.respond(1, 1, yields));
            let determinant = first * second - cross * cross;
            let regular = less(first * first, splat(MAX_CONDITION_NUMBER) * determinant);
            self.pair = mask(self.manifolds.two) & regular;
            let scale = splat(1.0) / determinant;
            self.response = [first, cross, second];
            self.inverse = [second * scale, -cross * scale, first * scale];
        }
    }

    #[inline(always)]
    fn respond(&self, i: usize, j: usize, yields: &Yields) -> Real {
        let on_b = self.rows[i][1].through(self.rows[j][1], yields[1]);
        if self.with_wall() { on_b } else { self.rows[i][0].through(self.rows[j][0], yields[0]) + on_b }
    }

    /// Applies the accumulated impulses, those of the preceding substep as an initial value.
    #[inline]
    pub(crate) fn apply_warm(&self, set: LaneSet, yields: &Yields, twists: &mut [Twists; 4]) {
        let live = mask(set & self.live());
        self.apply(live, yields, twists, 0, self.impulses[0]);
        if self.manifolds.two != 0 {
            self.apply(live & self.pair, yields, twists, 1, self.impulses[1]);
        }
    }

    #[inline(always)]
    fn apply(&self, mask: Real, yields: &Yields, twists: &mut [Twists; 4], point: usize, impulse: Real) {
        if !self.with_wall() {
            twists[self.a].push(mask, self.rows[point][0], impulse, yields[0]);
        }
        twists[self.b].push(mask, self.rows[point][1], impulse, yields[1]);
    }

    /// One iteration of the velocity solver in some lanes, for the twists and inverse masses of bodies or groups with the given
    /// names. Returns the maximum change of an impulse (N s) in each lane.
    #[inline]
    pub(crate) fn solve(
        &mut self,
        set: LaneSet,
        names: (usize, usize),
        yields: &Yields,
        twists: &mut [Twists; 4],
    ) -> Real {
        let live = set & self.live();
        if live == 0 {
            return Real::ZERO;
        }
        let speed = |point: usize| {
            let on_b = self.rows[point][1].dot(twists[names.1]);
            if self.with_wall() { on_b } else { self.rows[point][0].dot(twists[names.0]) + on_b }
        };
        let before = self.impulses;
        let speeds = speed(0);
        let single = larger(before[0] - speeds / self.response[0], Real::ZERO) - before[0];
        let mut changes = [single, Real::ZERO];
        let pair = mask(live) & self.pair;
        if pair.any() {
            let [first, cross, second] = self.response;
            // The speeds without the accumulated impulses.
            let free = [
                speeds - first * before[0] - cross * before[1],
                speed(1) - cross * before[0] - second * before[1],
            ];
            let after = self.solve_lcp(pair, free, before);
            for point in 0..2 {
                put(&mut changes[point], pair, after[point] - before[point]);
            }
        }
        let live = mask(live);
        for point in 0..2 {
            let change = changes[point];
            let changed = live & differ(change, Real::ZERO);
            if point == 1 && !changed.any() {
                break;
            }
            add(&mut self.impulses[point], changed, change);
            if !self.with_wall() {
                twists[names.0].push(changed, self.rows[point][0], change, yields[0]);
            }
            twists[names.1].push(changed, self.rows[point][1], change, yields[1]);
        }
        live & larger(changes[0].abs(), changes[1].abs())
    }

    /// See [`crate::contact`]: the complementarity problem of two points. Where it has no solution, impulses stay.
    #[inline]
    fn solve_lcp(&self, pair: Real, free: [Real; 2], before: [Real; 2]) -> [Real; 2] {
        let [first, cross, second] = self.response;
        let [inverse_first, inverse_cross, inverse_second] = self.inverse;
        let both = [
            -(inverse_first * free[0] + inverse_cross * free[1]),
            -(inverse_cross * free[0] + inverse_second * free[1]),
        ];
        let mut solved = at_least(both[0], Real::ZERO) & at_least(both[1], Real::ZERO);
        let mut after = [pick(solved, both[0], before[0]), pick(solved, both[1], before[1])];
        if lanes(pair & !solved) == 0 {
            return after;
        }
        let alone = -free[0] / first;
        let fits = !solved & at_least(alone, Real::ZERO) & at_least(cross * alone + free[1], Real::ZERO);
        after = [pick(fits, alone, after[0]), pick(fits, Real::ZERO, after[1])];
        solved |= fits;
        let alone = -free[1] / second;
        let fits = !solved & at_least(alone, Real::ZERO) & at_least(cross * alone + free[0], Real::ZERO);
        after = [pick(fits, Real::ZERO, after[0]), pick(fits, alone, after[1])];
        solved |= fits;
        let parts = !solved & at_least(free[0], Real::ZERO) & at_least(free[1], Real::ZERO);
        [pick(parts, Real::ZERO, after[0]), pick(parts, Real::ZERO, after[1])]
    }

    /// The normal at one of the points, its position, and the gap there, negative where shapes overlap (u).
    #[inline]
    pub(crate) fn gap(&self, motions: &[Motions; 4], point: usize) -> (Vector, Vector, Real) {
        let (a, b) = self.sides(motions);
        self.manifolds.gap(a, b, self.skins, point)
    }

    /// The lanes among the given ones that have a point of this number.
    #[inline(always)]
    pub(crate) fn having(&self, set: LaneSet, point: usize) -> LaneSet {
        set & if point == 0 { self.manifolds.live } else { self.manifolds.two }
    }

    /// One iteration of the position solver for single bodies, which corrects a share of the overlap. Returns the lanes among the
    /// given ones in which the gap before the correction was at least `tolerance` (u).
    #[inline]
    pub(crate) fn separate(
        &self,
        set: LaneSet,
        shapes: &[Shape; 5],
        motions: &mut [Motions; 4],
        share: f32,
        tolerance: f32,
    ) -> LaneSet {
        let mut settled = set;
        for point in 0..2 {
            let set = self.having(set, point);
            if set == 0 {
                continue;
            }
            let (normal, at, gap) = self.gap(motions, point);
            let fine = lanes(at_least(gap, splat(tolerance)));
            settled &= fine | !set;
            let overlap = set & !lanes(at_least(gap, splat(-LINEAR_SLOP)));
            if overlap == 0 {
                continue;
            }
            let overlap = mask(overlap);
            let (shape, offset) = (&shapes[self.b], at - motions[self.b].centre);
            if self.with_wall() {
                let arm = offset.perp_dot(normal);
                let response = splat(shape.inverse_mass) + splat(shape.inverse_inertia) * arm * arm;
                let impulse = normal * (correction(share, gap) / response);
                motions[self.b].shift(overlap, shape, offset, impulse, Real::ZERO);
            } else {
                let (other, other_offset) = (&shapes[self.a], at - motions[self.a].centre);
                let (other_arm, arm) = (other_offset.perp_dot(normal), offset.perp_dot(normal));
                let response = splat(other.inverse_mass + shape.inverse_mass)
                    + splat(other.inverse_inertia) * other_arm * other_arm
                    + splat(shape.inverse_inertia) * arm * arm;
                let impulse = normal * (correction(share, gap) / response);
                motions[self.a].shift(overlap, other, other_offset, -impulse, Real::ZERO);
                motions[self.b].shift(overlap, shape, offset, impulse, Real::ZERO);
            }
        }
        settled
    }
}

/// Distance by which one iteration of the position solver separates overlapping bodies (u).
#[inline(always)]
pub(crate) fn correction(share: f32, gap: Real) -> Real {
    smaller(splat(-share) * (gap + splat(LINEAR_SLOP)), splat(MAX_CORRECTION))
}

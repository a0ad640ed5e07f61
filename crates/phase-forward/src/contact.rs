//! One contact as a constraint: bodies may not approach each other at its points.

use crate::{
    body::{BodyMotion, STATIC, Shape, Twist},
    constants::{LINEAR_SLOP, MAX_CORRECTION},
    manifold::Manifold,
};
use glam::Vec3;
use phase_model::Vec2;

/// Two points whose effective masses differ by more than this are solved as one.
const MAX_CONDITION_NUMBER: f32 = 1000.0;

/// A touching contact and all data for its solution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    /// The key of its pair of shapes.
    pub(crate) key: u8,
    /// First body; [`STATIC`] for walls.
    pub(crate) a: usize,
    /// Second body, never static.
    pub(crate) b: usize,
    /// The groups that it acts on: the bodies themselves, unless they are solved as part of a rigid group.
    pub(crate) groups: (usize, usize),
    pub(crate) manifold: Manifold,
    /// Accumulated impulse at each point (N s).
    pub(crate) impulses: [f32; 2],
    /// Overlap that it does not resist (u).
    tolerated: f32,
    skins: f32,
    /// Number of points the velocity solver uses.
    count: usize,
    /// The twist of a unit impulse at each point for the first and for the second body.
    rows: [(Twist, Twist); 2],
    /// Effect of a unit impulse at point i on the speed at point j: (0, 0), (0, 1) and (1, 1).
    response: [f32; 3],
    /// The inverse of the same matrix, if both points are solved together.
    inverse: [f32; 3],
}

impl Contact {
    pub(crate) const NONE: Self = Self {
        key: 0,
        a: STATIC,
        b: 0,
        groups: (STATIC, 0),
        manifold: Manifold::NONE,
        impulses: [0.0; 2],
        tolerated: 0.0,
        skins: 0.0,
        count: 0,
        rows: [(Twist::ZERO, Twist::ZERO); 2],
        response: [0.0; 3],
        inverse: [0.0; 3],
    };

    /// A contact of two bodies with zero initial impulses.
    pub(crate) fn new(key: u8, (a, b): (usize, usize), manifold: Manifold) -> Self {
        Self { key, a, b, groups: (a, b), manifold, ..Self::NONE }
    }

    /// This contact, resisting only overlaps beyond a tolerated one (u).
    pub(crate) fn tolerating(self, tolerated: f32) -> Self {
        Self { tolerated, ..self }
    }

    /// Computes the points of application and the effect of impulses, at the present poses.
    pub(crate) fn prepare(&mut self, shapes: &[Shape; 5], motions: &[BodyMotion; 5]) {
        let a = &motions[self.a];
        let b = &motions[self.b];
        self.place(&shapes[self.a], &shapes[self.b], a, b, [a.centre, b.centre], false);
        self.compute_response(shapes[self.a].inverse_mass_vector, shapes[self.b].inverse_mass_vector, false);
    }

    /// [`Contact::prepare`] where the two bodies are parts of rigid groups with these names, centres of mass
    /// (u) and [`Shape::inverse_mass_vector`].
    #[inline]
    pub(crate) fn prepare_rigid(
        &mut self,
        names: (usize, usize),
        centres: [Vec2; 2],
        inverse_mass_vector: [Vec3; 2],
        shapes: &[Shape; 5],
        motions: &[BodyMotion; 5],
    ) {
        self.groups = names;
        let a = &motions[self.a];
        let b = &motions[self.b];
        self.place(&shapes[self.a], &shapes[self.b], a, b, centres, self.a == STATIC);
        self.compute_response(inverse_mass_vector[0], inverse_mass_vector[1], self.a == STATIC);
    }

    /// [`Contact::prepare`] for a contact with a wall, where only the second body moves.
    pub(crate) fn prepare_alone(&mut self, shapes: &[Shape; 5], motion: &BodyMotion) {
        let wall = &shapes[STATIC];
        let shape = &shapes[self.b];
        self.place(wall, shape, &BodyMotion::AT_REST, motion, [Vec2::ZERO, motion.centre], true);
        self.compute_response(wall.inverse_mass_vector, shape.inverse_mass_vector, true);
    }

    /// Computes the points of application and the twist of a unit impulse for each side, about its centre of
    /// mass.
    #[inline(always)]
    fn place(
        &mut self,
        shape_a: &Shape,
        shape_b: &Shape,
        a: &BodyMotion,
        b: &BodyMotion,
        centres: [Vec2; 2],
        alone: bool,
    ) {
        self.skins = shape_a.skin + shape_b.skin - self.tolerated;
        let (normal, middles) = self.manifold.middles(a, b, shape_a.skin, shape_b.skin);
        self.count = self.manifold.count;
        for (row, middle) in self.rows.iter_mut().zip(middles).take(self.count) {
            if !alone {
                row.0 = Twist::of_impulse(-normal, middle - centres[0]);
            }
            row.1 = Twist::of_impulse(normal, middle - centres[1]);
        }
    }

    /// Computes the effect of impulses on both sides, of which the first may be a wall.
    #[inline(always)]
    fn compute_response(&mut self, yielding_a: Vec3, yielding_b: Vec3, alone: bool) {
        let rows = &self.rows;
        let compute_response = |i: usize, j: usize| {
            let on_b = rows[i].1.through(rows[j].1, yielding_b);
            if alone { on_b } else { rows[i].0.through(rows[j].0, yielding_a) + on_b }
        };
        self.response[0] = compute_response(0, 0);
        if self.count == 2 {
            let [first, cross, second] = [self.response[0], compute_response(0, 1), compute_response(1, 1)];
            let determinant = first * second - cross * cross;
            if first * first < MAX_CONDITION_NUMBER * determinant {
                let scale = 1.0 / determinant;
                self.response = [first, cross, second];
                self.inverse = [second * scale, -cross * scale, first * scale];
            } else {
                self.count = 1;
            }
        }
    }

    /// Applies the accumulated impulses, those of the preceding substep as an initial value.
    pub(crate) fn warm_start(&self, shapes: &[Shape; 5], twists: &mut [Twist; 5]) {
        for point in 0..self.count {
            self.apply(|body| shapes[body].inverse_mass_vector, twists, point, self.impulses[point]);
        }
    }

    /// [`Contact::warm_start`] for a contact with a wall.
    #[inline]
    pub(crate) fn warm_start_alone(&self, shape: &Shape, twist: &mut Twist) {
        for point in 0..self.count {
            twist.push(self.rows[point].1, self.impulses[point], shape.inverse_mass_vector);
        }
    }

    /// One iteration of the velocity solver, for bodies or groups with the given inverse masses
    /// ([`Shape::inverse_mass_vector`]). Returns the maximum change of an impulse (N s).
    #[inline]
    pub(crate) fn solve(
        &mut self,
        inverse_mass_vector: impl Fn(usize) -> Vec3,
        twists: &mut [Twist; 5],
    ) -> f32 {
        let changes = self
            .changes(|(row_a, row_b)| row_a.dot(twists[self.groups.0]) + row_b.dot(twists[self.groups.1]));
        for (point, &change) in changes.iter().enumerate().take(self.count) {
            if change != 0.0 {
                self.impulses[point] += change;
                self.apply(&inverse_mass_vector, twists, point, change);
            }
        }
        changes[0].abs().max(changes[1].abs())
    }

    /// [`Contact::solve`] for a contact with a wall.
    #[inline]
    pub(crate) fn solve_alone(&mut self, shape: &Shape, twist: &mut Twist) -> f32 {
        let changes = self.changes(|(_, row)| row.dot(*twist));
        for (point, &change) in changes.iter().enumerate().take(self.count) {
            if change != 0.0 {
                self.impulses[point] += change;
                twist.push(self.rows[point].1, change, shape.inverse_mass_vector);
            }
        }
        changes[0].abs().max(changes[1].abs())
    }

    /// The changes of the impulses at the points, for the given separating speeds.
    #[inline(always)]
    fn changes(&self, speed: impl Fn(&(Twist, Twist)) -> f32) -> [f32; 2] {
        let before = self.impulses;
        if self.count == 1 {
            let speed = speed(&self.rows[0]);
            return [(before[0] - speed / self.response[0]).max(0.0) - before[0], 0.0];
        }
        let [first, cross, second] = self.response;
        // The speeds without the accumulated impulses.
        let free_speeds = [
            speed(&self.rows[0]) - first * before[0] - cross * before[1],
            speed(&self.rows[1]) - cross * before[0] - second * before[1],
        ];
        self.solve_lcp(free_speeds).map_or([0.0; 2], |after| [after[0] - before[0], after[1] - before[1]])
    }

    /// The normal at one of the points, its position, and the gap there, negative where shapes overlap (u).
    #[inline]
    pub(crate) fn gap(&self, motions: &[BodyMotion; 5], point: usize) -> (Vec2, Vec2, f32) {
        if self.a == STATIC {
            self.manifold.gap_to_wall(&motions[self.b], self.skins, point)
        } else {
            self.manifold.gap(&motions[self.a], &motions[self.b], self.skins, point)
        }
    }

    /// One iteration of the position solver, which corrects a share of the overlap. Returns the gap before
    /// the correction, negative where shapes overlap (u).
    pub(crate) fn separate(&self, shapes: &[Shape; 5], motions: &mut [BodyMotion; 5], share: f32) -> f32 {
        if self.a == STATIC {
            return self.separate_alone(&shapes[self.b], &mut motions[self.b], share);
        }
        let shape_a = &shapes[self.a];
        let shape_b = &shapes[self.b];
        let mut least = f32::MAX;
        for point in 0..self.manifold.count {
            let a = &motions[self.a];
            let b = &motions[self.b];
            let (normal, at, gap) = self.manifold.gap(a, b, self.skins, point);
            least = least.min(gap);
            if gap >= -LINEAR_SLOP {
                continue;
            }
            let offset_a = at - a.centre;
            let offset_b = at - b.centre;
            let arm_a = offset_a.perp_dot(normal);
            let arm_b = offset_b.perp_dot(normal);
            let response = shape_a.inverse_mass
                + shape_b.inverse_mass
                + shape_a.inverse_inertia * arm_a * arm_a
                + shape_b.inverse_inertia * arm_b * arm_b;
            let impulse = normal * (correction(share, gap) / response);
            motions[self.a].shift(shape_a, offset_a, -impulse, 0.0);
            motions[self.b].shift(shape_b, offset_b, impulse, 0.0);
        }
        least
    }

    /// [`Contact::separate`] for a contact with a wall.
    #[inline]
    pub(crate) fn separate_alone(&self, shape: &Shape, motion: &mut BodyMotion, share: f32) -> f32 {
        let mut least = f32::MAX;
        for point in 0..self.manifold.count {
            let (normal, at, gap) = self.manifold.gap_to_wall(motion, self.skins, point);
            least = least.min(gap);
            if gap >= -LINEAR_SLOP {
                continue;
            }
            let offset = at - motion.centre;
            let arm = offset.perp_dot(normal);
            let response = shape.inverse_mass + shape.inverse_inertia * arm * arm;
            motion.shift(shape, offset, normal * (correction(share, gap) / response), 0.0);
        }
        least
    }

    #[inline]
    fn apply(
        &self,
        inverse_mass_vector: impl Fn(usize) -> Vec3,
        twists: &mut [Twist; 5],
        point: usize,
        impulse: f32,
    ) {
        let (row_a, row_b) = self.rows[point];
        let (a, b) = self.groups;
        twists[a].push(row_a, impulse, inverse_mass_vector(a));
        twists[b].push(row_b, impulse, inverse_mass_vector(b));
    }

    /// Impulses at both points such that the bodies do not approach, no impulse is negative, and no impulse
    /// acts where the bodies separate: a complementarity problem small enough to try all four cases. Takes
    /// the speeds without any impulse.
    #[inline]
    fn solve_lcp(&self, free_speeds: [f32; 2]) -> Option<[f32; 2]> {
        let [first, cross, second] = self.response;
        let [inverse_first, inverse_cross, inverse_second] = self.inverse;
        let both = [
            -(inverse_first * free_speeds[0] + inverse_cross * free_speeds[1]),
            -(inverse_cross * free_speeds[0] + inverse_second * free_speeds[1]),
        ];
        if both[0] >= 0.0 && both[1] >= 0.0 {
            return Some(both);
        }
        let alone = -free_speeds[0] / first;
        if alone >= 0.0 && cross * alone + free_speeds[1] >= 0.0 {
            return Some([alone, 0.0]);
        }
        let alone = -free_speeds[1] / second;
        if alone >= 0.0 && cross * alone + free_speeds[0] >= 0.0 {
            return Some([0.0, alone]);
        }
        (free_speeds[0] >= 0.0 && free_speeds[1] >= 0.0).then_some([0.0, 0.0])
    }
}

/// Distance by which one iteration of the position solver separates overlapping bodies (u).
#[inline]
pub(crate) fn correction(share: f32, gap: f32) -> f32 {
    (-share * (gap + LINEAR_SLOP)).min(MAX_CORRECTION)
}

//! Contacts: their points, and the impulses that keep two bodies from approaching each other there.

use super::{
    BODIES, ITERATIONS, LINEAR_SLOP, MAX_CORRECTION, WARM,
    collide::{Manifold, Reference, collide},
    math::{Rotation, Transform, normalised, spun},
    shape::Shape,
};
use phase_model::Vec2;

/// A pair of shapes that may touch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// Numbers of the shapes, the walls first.
    pub(super) shapes: (usize, usize),
    pub(super) bodies: (usize, usize),
    pub(super) manifold: Manifold,
    /// Impulses at the points, with which the next substep begins (N s).
    pub(super) impulses: [f32; 2],
    pub(super) enabled: bool,
    /// Impacts of this substep, and when the next comes, if that is known.
    pub(super) impacts: u32,
    pub(super) impact: Option<f32>,
}

impl Contact {
    pub(super) const fn new(shapes: (usize, usize), bodies: (usize, usize)) -> Self {
        let manifold = Manifold::NONE;
        Self { shapes, bodies, manifold, impulses: [0.0; 2], enabled: true, impacts: 0, impact: None }
    }

    pub(super) const fn is_touching(&self) -> bool {
        self.manifold.count > 0
    }

    /// Whether it takes part in solving.
    pub(super) const fn acts(&self) -> bool {
        self.enabled && self.is_touching()
    }

    /// Ends the touch, if there is one.
    pub(super) const fn part(&mut self) {
        self.enabled = true;
        self.manifold.count = 0;
        self.impulses = [0.0; 2];
    }

    /// Finds the points anew. Points with known names keep their impulses.
    pub(super) fn update(&mut self, a: (&Shape, &Transform), b: (&Shape, &Transform)) {
        let before = (self.manifold, self.impulses);
        self.enabled = true;
        self.manifold = collide(a.0, a.1, b.0, b.1);
        self.impulses = [0.0; 2];
        for point in 0..self.manifold.count {
            let name = self.manifold.names[point];
            if let Some(known) = (0..before.0.count).find(|&k| before.0.names[k] == name) {
                self.impulses[point] = before.1[known];
            }
        }
    }
}

/// Masses, positions and velocities of all bodies while they are solved.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solved {
    pub(super) inverse_mass: [f32; BODIES],
    pub(super) inverse_inertia: [f32; BODIES],
    pub(super) local_centre: [Vec2; BODIES],
    pub(super) centre: [Vec2; BODIES],
    pub(super) angle: [f32; BODIES],
    pub(super) velocity: [Vec2; BODIES],
    pub(super) spin: [f32; BODIES],
    /// The last rotation asked for, with its angle.
    pub(super) rotations: [(f32, Rotation); BODIES],
}

impl Solved {
    pub(super) fn rotation(&mut self, body: usize) -> Rotation {
        let (angle, rotation) = &mut self.rotations[body];
        if *angle != self.angle[body] {
            (*angle, *rotation) = (self.angle[body], Rotation::new(self.angle[body]));
        }
        *rotation
    }

    pub(super) fn pose(&mut self, body: usize) -> Transform {
        let rotation = self.rotation(body);
        Transform { place: self.centre[body] - rotation.turn(self.local_centre[body]), rotation }
    }

    /// Applies an impulse at two points given from the centres of mass, to the first body the other way, and
    /// a turning impulse.
    pub(super) fn apply(&mut self, (a, b): (usize, usize), arms: (Vec2, Vec2), impulse: Vec2, twist: f32) {
        self.velocity[a] -= self.inverse_mass[a] * impulse;
        self.spin[a] -= self.inverse_inertia[a] * (arms.0.perp_dot(impulse) + twist);
        self.velocity[b] += self.inverse_mass[b] * impulse;
        self.spin[b] += self.inverse_inertia[b] * (arms.1.perp_dot(impulse) + twist);
    }

    /// Moves the second body away from the first as such an impulse would change velocities.
    fn shift(&mut self, (a, b): (usize, usize), arms: (Vec2, Vec2), impulse: Vec2) {
        self.centre[a] -= self.inverse_mass[a] * impulse;
        self.angle[a] -= self.inverse_inertia[a] * arms.0.perp_dot(impulse);
        self.centre[b] += self.inverse_mass[b] * impulse;
        self.angle[b] += self.inverse_inertia[b] * arms.1.perp_dot(impulse);
    }

    /// The velocity of the second body relative to the first, at a point of each.
    pub(super) fn slip(&self, (a, b): (usize, usize), arms: (Vec2, Vec2)) -> Vec2 {
        self.velocity[b] + spun(self.spin[b], arms.1) - self.velocity[a] - spun(self.spin[a], arms.0)
    }

    /// Moves a body on by some seconds at its velocity, which is limited.
    pub(super) fn advance(&mut self, body: usize, seconds: f32) {
        const FARTHEST: f32 = 2.0;
        const MOST: f32 = 0.5 * super::PI;
        let sweep = seconds * self.velocity[body];
        if sweep.dot(sweep) > FARTHEST * FARTHEST {
            self.velocity[body] *= FARTHEST / sweep.length();
        }
        let turn = seconds * self.spin[body];
        if turn * turn > MOST * MOST {
            self.spin[body] *= MOST / turn.abs();
        }
        self.centre[body] += seconds * self.velocity[body];
        self.angle[body] += seconds * self.spin[body];
    }
}

/// A contact while it is solved.
#[derive(Clone, Copy, Debug)]
pub(super) struct Constraint {
    bodies: (usize, usize),
    radii: (f32, f32),
    manifold: Manifold,
    pub(super) impulses: [f32; 2],
    normal: Vec2,
    arms: [(Vec2, Vec2); 2],
    /// Effective mass at each point (kg).
    masses: [f32; 2],
    /// Points that are solved.
    count: usize,
    /// Effect of impulses on speeds, (0, 0), (0, 1) and (1, 1), and the inverse of that matrix.
    response: [f32; 3],
    inverse: [f32; 3],
}

impl Constraint {
    /// That of a touching contact; impulses of the substep before count if it is warm.
    pub(super) fn new(contact: &Contact, radii: (f32, f32), warmth: f32) -> Self {
        Self {
            bodies: contact.bodies,
            radii,
            manifold: contact.manifold,
            impulses: contact.impulses.map(|impulse| warmth * impulse),
            normal: Vec2::ZERO,
            arms: [(Vec2::ZERO, Vec2::ZERO); 2],
            masses: [0.0; 2],
            count: contact.manifold.count,
            response: [0.0; 3],
            inverse: [0.0; 3],
        }
    }

    /// The factor for impulses of the substep before: none in the first.
    pub(super) const fn warmth(is_first: bool) -> f32 {
        if is_first { 0.0 } else { WARM }
    }

    /// Computes the effects of impulses at the present poses.
    pub(super) fn prepare(&mut self, solved: &mut Solved) {
        const MAX_CONDITION_NUMBER: f32 = 1000.0;
        let (a, b) = self.bodies;
        let (normal, points) = self.world_points(&solved.pose(a), &solved.pose(b));
        self.normal = normal;
        let mass_a = solved.inverse_mass[a];
        let mass_b = solved.inverse_mass[b];
        let inertia_a = solved.inverse_inertia[a];
        let inertia_b = solved.inverse_inertia[b];
        let mut levers = [(0.0, 0.0); 2];
        for point in 0..self.count {
            let arms = (points[point] - solved.centre[a], points[point] - solved.centre[b]);
            self.arms[point] = arms;
            levers[point] = (arms.0.perp_dot(normal), arms.1.perp_dot(normal));
        }
        let effect = |i: usize, j: usize| {
            mass_a + mass_b + inertia_a * levers[i].0 * levers[j].0 + inertia_b * levers[i].1 * levers[j].1
        };
        for point in 0..self.count {
            let effect = effect(point, point);
            self.masses[point] = if effect > 0.0 { 1.0 / effect } else { 0.0 };
        }
        if self.count == 2 {
            let [first, second, cross] = [effect(0, 0), effect(1, 1), effect(0, 1)];
            if first * first < MAX_CONDITION_NUMBER * (first * second - cross * cross) {
                self.response = [first, cross, second];
                self.inverse = inverse(self.response);
            } else {
                self.count = 1;
            }
        }
    }

    /// The normal from the first body to the second, and the middles between both surfaces.
    fn world_points(&self, a: &Transform, b: &Transform) -> (Vec2, [Vec2; 2]) {
        let Manifold { reference, normal, anchor, points, count, .. } = self.manifold;
        let mut middles = [Vec2::ZERO; 2];
        let (radius_a, radius_b) = self.radii;
        if reference == Reference::Points {
            let from = a.apply(anchor);
            let to = b.apply(points[0]);
            let between = to - from;
            let apart = between.dot(between) > f32::EPSILON * f32::EPSILON;
            let normal = if apart { normalised(between).0 } else { Vec2::X };
            middles[0] = 0.5 * ((from + radius_a * normal) + (to - radius_b * normal));
            return (normal, middles);
        }
        let by_first = reference == Reference::First;
        let (base, other) = if by_first { (a, b) } else { (b, a) };
        let (radius, radius_other) = if by_first { (radius_a, radius_b) } else { (radius_b, radius_a) };
        let normal = base.rotation.turn(normal);
        let plane = base.apply(anchor);
        for point in 0..count {
            let at = other.apply(points[point]);
            let near = at + (radius - (at - plane).dot(normal)) * normal;
            let far = at - radius_other * normal;
            middles[point] = 0.5 * (near + far);
        }
        (if by_first { normal } else { -normal }, middles)
    }

    /// Applies the impulses with which the substep begins.
    pub(super) fn warm_start(&self, solved: &mut Solved) {
        for point in 0..self.count {
            solved.apply(self.bodies, self.arms[point], self.impulses[point] * self.normal, 0.0);
        }
    }

    /// One iteration of the velocity solver. Returns whether it changed anything.
    pub(super) fn solve(&mut self, solved: &mut Solved) -> bool {
        let speed = |point: usize| solved.slip(self.bodies, self.arms[point]).dot(self.normal);
        if self.count == 1 {
            let change = -self.masses[0] * speed(0);
            let after = (self.impulses[0] + change).max(0.0);
            let change = after - self.impulses[0];
            self.impulses[0] = after;
            solved.apply(self.bodies, self.arms[0], change * self.normal, 0.0);
            return change != 0.0;
        }
        let before = self.impulses;
        let [first, cross, second] = self.response;
        let free = [
            speed(0) - (first * before[0] + cross * before[1]),
            speed(1) - (cross * before[0] + second * before[1]),
        ];
        let Some(after) = self.complementary(free) else { return false };
        let changes = [after[0] - before[0], after[1] - before[1]];
        let p = changes[0] * self.normal;
        let q = changes[1] * self.normal;
        let (a, b) = self.bodies;
        let [(arm_a, arm_b), (other_a, other_b)] = self.arms;
        solved.velocity[a] -= solved.inverse_mass[a] * (p + q);
        solved.spin[a] -= solved.inverse_inertia[a] * (arm_a.perp_dot(p) + other_a.perp_dot(q));
        solved.velocity[b] += solved.inverse_mass[b] * (p + q);
        solved.spin[b] += solved.inverse_inertia[b] * (arm_b.perp_dot(p) + other_b.perp_dot(q));
        self.impulses = after;
        changes != [0.0; 2]
    }

    /// Impulses without approach, none of them negative or where the bodies part, if there are any.
    fn complementary(&self, free: [f32; 2]) -> Option<[f32; 2]> {
        let [_, cross, _] = self.response;
        let [a, b, c] = self.inverse;
        let both = [-(a * free[0] + b * free[1]), -(b * free[0] + c * free[1])];
        if both[0] >= 0.0 && both[1] >= 0.0 {
            return Some(both);
        }
        let alone = -self.masses[0] * free[0];
        if alone >= 0.0 && cross * alone + free[1] >= 0.0 {
            return Some([alone, 0.0]);
        }
        let alone = -self.masses[1] * free[1];
        if alone >= 0.0 && cross * alone + free[0] >= 0.0 {
            return Some([0.0, alone]);
        }
        (free[0] >= 0.0 && free[1] >= 0.0).then_some([0.0; 2])
    }

    /// One iteration of the position solver, which corrects a share of the overlap. Returns the gap before
    /// it, 0 or negative (u).
    pub(super) fn separate(&self, solved: &mut Solved, share: f32) -> f32 {
        let (a, b) = self.bodies;
        let mass_a = solved.inverse_mass[a];
        let mass_b = solved.inverse_mass[b];
        let inertia_a = solved.inverse_inertia[a];
        let inertia_b = solved.inverse_inertia[b];
        let mut least = 0.0_f32;
        for point in 0..self.manifold.count {
            let (normal, at, gap) = self.gap(&solved.pose(a), &solved.pose(b), point);
            least = least.min(gap);
            let arms = (at - solved.centre[a], at - solved.centre[b]);
            let correction = (share * (gap + LINEAR_SLOP)).clamp(-MAX_CORRECTION, 0.0);
            let lever_a = arms.0.perp_dot(normal);
            let lever_b = arms.1.perp_dot(normal);
            let effect = mass_a + mass_b + inertia_a * lever_a * lever_a + inertia_b * lever_b * lever_b;
            let impulse = if effect > 0.0 { -correction / effect } else { 0.0 };
            solved.shift(self.bodies, arms, impulse * normal);
        }
        least
    }

    /// The normal, the place and the gap at a point, negative where shapes overlap (u).
    fn gap(&self, a: &Transform, b: &Transform, point: usize) -> (Vec2, Vec2, f32) {
        let Manifold { reference, normal, anchor, points, .. } = self.manifold;
        let (radius_a, radius_b) = self.radii;
        if reference == Reference::Points {
            let from = a.apply(anchor);
            let to = b.apply(points[0]);
            let normal = normalised(to - from).0;
            return (normal, 0.5 * (from + to), (to - from).dot(normal) - radius_a - radius_b);
        }
        let by_first = reference == Reference::First;
        let (base, other) = if by_first { (a, b) } else { (b, a) };
        let normal = base.rotation.turn(normal);
        let plane = base.apply(anchor);
        let at = other.apply(points[point]);
        let gap = (at - plane).dot(normal) - radius_a - radius_b;
        (if by_first { normal } else { -normal }, at, gap)
    }
}

/// The inverse of a symmetric matrix, given as (0, 0), (0, 1) and (1, 1).
pub(super) fn inverse([first, cross, second]: [f32; 3]) -> [f32; 3] {
    let determinant = first * second - cross * cross;
    let scale = if determinant == 0.0 { 0.0 } else { 1.0 / determinant };
    [scale * second, -scale * cross, scale * first]
}

/// Runs the velocity solver until an iteration changes nothing, or has been done often enough.
pub(super) fn iterate(mut once: impl FnMut() -> bool) {
    for _ in 0..ITERATIONS {
        if !once() {
            break;
        }
    }
}

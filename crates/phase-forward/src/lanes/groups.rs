//! Bodies that hold each other, treated as one rigid body, in each lane; see [`crate::group`].

use super::{
    contact::{Contacts, Yields, correction},
    motion::{inverse_mass, turned_lanes},
    reach::BodyLanes,
    real::{
        LaneSet, Real, Twists, Vector, at_least, at_most, differ, greater, lanes, less, mask, pick, put,
        splat,
    },
    worlds::Worlds,
};
use crate::{
    body::{STATIC, Shape},
    constants::LINEAR_SLOP,
    group::{Groups, MAX_SPEED, MAX_SPIN},
    key::PAIRS,
};
use glam::Vec3;
use phase_model::{AGENT_COUNT, Vec2, physics::GROUND_FRICTION};

/// All bodies in rigid groups, which are the same in every lane.
#[derive(Clone, Debug)]
pub(crate) struct LaneGroups {
    /// For each body, the body that names its group: the one of lowest index in it.
    pub(crate) names: [usize; 5],
    /// Pairs of bodies that belong to the same group, and so cannot touch.
    pub(crate) within: [bool; PAIRS.len()],
    /// Inverse masses of groups, by name.
    pub(crate) inverse_mass: [Twists; 4],
    /// Centres of mass of groups, by name (u).
    pub(crate) centres: [Vector; 4],
    /// Velocities of groups, by name.
    pub(crate) twists: [Twists; 4],
}

impl LaneGroups {
    /// The groups that grips make.
    pub(crate) fn new(worlds: &Worlds<'_>) -> Self {
        let mut names = [0, 1, 2, 3, STATIC];
        for agent in 0..AGENT_COUNT {
            if let Some(held) = worlds.held[agent] {
                let (kept, given_up) = (names[agent].min(names[held]), names[agent].max(names[held]));
                for name in &mut names {
                    if *name == given_up {
                        *name = kept;
                    }
                }
            }
        }
        let shapes = &worlds.model.shapes;
        let mut groups = Self {
            names,
            within: PAIRS.map(|(a, b)| names[a] == names[b]),
            inverse_mass: [0, 1, 2, 3].map(|body: usize| inverse_mass(&shapes[body])),
            centres: [Vector::ZERO; 4],
            twists: [Twists::ZERO; 4],
        };
        for name in 0..worlds.model.count {
            if groups.is_joint(name) {
                groups.compute_mass(name, worlds);
            }
        }
        groups
    }

    /// The indices of a group's bodies.
    pub(crate) fn bodies_of(&self, name: usize) -> impl Iterator<Item = usize> + use<> {
        let names = self.names;
        (0..4).filter(move |&body| names[body] == name)
    }

    /// Whether a group has several bodies.
    pub(crate) fn is_joint(&self, name: usize) -> bool {
        self.bodies_of(name).count() > 1
    }

    /// For each group, the lanes in which one of its bodies belongs to a set.
    pub(crate) fn named(&self, bodies: &BodyLanes) -> BodyLanes {
        let mut named = [0; 4];
        for (body, &set) in bodies.iter().enumerate() {
            named[self.names[body]] |= set;
        }
        named
    }

    /// Computes mass, centre and moment of inertia of a group of several bodies.
    fn compute_mass(&mut self, name: usize, worlds: &Worlds<'_>) {
        let shapes = &worlds.model.shapes;
        let (mut mass, mut moment) = (0.0, Vector::ZERO);
        for body in self.bodies_of(name) {
            mass += shapes[body].mass;
            moment += worlds.motions[body].centre * splat(shapes[body].mass);
        }
        let centre = Vector { x: moment.x / splat(mass), y: moment.y / splat(mass) };
        let mut inertia = Real::ZERO;
        for body in self.bodies_of(name) {
            let arm = worlds.motions[body].centre.distance_squared(centre);
            inertia += splat(1.0 / shapes[body].inverse_inertia) + splat(shapes[body].mass) * arm;
        }
        self.centres[name] = centre;
        let linear = splat(1.0 / mass);
        self.inverse_mass[name] = Twists { x: linear, y: linear, spin: splat(1.0) / inertia };
    }

    /// Takes over the velocities of a group's bodies: total momentum and angular momentum are conserved.
    pub(crate) fn gather_momentum(&mut self, name: usize, worlds: &Worlds<'_>) {
        if !self.is_joint(name) {
            self.centres[name] = worlds.motions[name].centre;
            self.twists[name] = worlds.motions[name].twist();
            return;
        }
        let mut sum = Twists::ZERO;
        for body in self.bodies_of(name) {
            let (shape, motion) = (&worlds.model.shapes[body], &worlds.motions[body]);
            let momentum = motion.velocity * splat(shape.mass);
            sum = sum.plus(Twists::of_impulse(momentum, motion.centre - self.centres[name]));
            sum.spin += motion.spin / splat(shape.inverse_inertia);
        }
        self.twists[name] = sum.times(self.inverse_mass[name]);
    }

    /// Gives a group's bodies the group's velocity.
    pub(crate) fn distribute_velocity(&self, name: usize, set: LaneSet, worlds: &mut Worlds<'_>) {
        let (twist, mask) = (self.twists[name], mask(set));
        for body in self.bodies_of(name) {
            let motion = &mut worlds.motions[body];
            let around = (motion.centre - self.centres[name]).perp() * twist.spin;
            motion.velocity.put(mask, twist.linear() + around);
            put(&mut motion.spin, mask, twist.spin);
        }
    }

    /// Applies `stop` to a body in some lanes, for a number of substeps that differs between them.
    pub(crate) fn stop(&mut self, body: usize, set: LaneSet, worlds: &Worlds<'_>, substeps: Real) {
        let name = self.names[body];
        let mass = splat(worlds.model.shapes[body].mass);
        let share = mass * self.inverse_mass[name].x;
        let mut left = splat(1.0);
        for substep in 0..phase_model::arena::SUBSTEPS {
            let more = less(splat(substep as f32), substeps);
            left = pick(more, left * (splat(1.0) - share), left);
        }
        let arm = worlds.motions[body].centre - self.centres[name];
        let twist = self.twists[name];
        let own = twist.linear() + arm.perp() * twist.spin;
        let impulse = own * (-mass * (splat(1.0) - left) / share);
        let inverse_mass = self.inverse_mass[name];
        self.twists[name].push(mask(set), Twists::of_impulse(impulse, arm), splat(1.0), inverse_mass);
    }

    /// Applies an agent's push or turn for some seconds, in some lanes.
    pub(crate) fn act(&mut self, body: usize, set: LaneSet, worlds: &Worlds<'_>, seconds: Real) {
        let (name, act) = (self.names[body], &worlds.acts[body]);
        let (shape, motion) = (&worlds.model.shapes[body], &worlds.motions[body]);
        let at = motion.place(Vector::splat(Vec2::new(0.0, shape.push_point)));
        let force = motion.turn(act.push * (act.max_force * seconds));
        let push = Twists::of_impulse(force, at - self.centres[name]);
        let torque = act.turn * splat(shape.turn_torque) * seconds;
        let turn = Twists { x: Real::ZERO, y: Real::ZERO, spin: torque };
        let impulse = Twists::pick(act.pushes, push, turn);
        let inverse_mass = self.inverse_mass[name];
        self.twists[name].push(mask(set), impulse, splat(1.0), inverse_mass);
    }

    /// Limits a group's velocity.
    pub(crate) fn limit(&mut self, name: usize, set: LaneSet) {
        let twist = self.twists[name];
        let length_squared = twist.linear().length_squared();
        let spin = twist.spin;
        let fast = greater(length_squared, splat(MAX_SPEED * MAX_SPEED));
        let fine = at_most(spin.abs(), splat(MAX_SPIN)) & !fast;
        if set & !lanes(fine) == 0 {
            return;
        }
        let length = length_squared.sqrt();
        let limited =
            Vector { x: splat(MAX_SPEED) * (twist.x / length), y: splat(MAX_SPEED) * (twist.y / length) };
        let slow = pick(less(spin, splat(-MAX_SPIN)), splat(-MAX_SPIN), spin);
        let slow = pick(greater(slow, splat(MAX_SPIN)), splat(MAX_SPIN), slow);
        let velocity = Vector::pick(fast, limited, twist.linear());
        self.twists[name].put(mask(set), Twists::new(velocity, slow));
    }

    /// Moves and turns a group in the lanes of a mask.
    pub(crate) fn shift(
        &mut self,
        name: usize,
        mask: Real,
        worlds: &mut Worlds<'_>,
        sweep: Vector,
        turn: Real,
    ) {
        let centre = self.centres[name];
        let set = lanes(mask);
        if self.is_joint(name) {
            let right = turned_lanes(set, Vector { x: Real::ONE, y: Real::ZERO }, turn);
            for body in self.bodies_of(name) {
                let motion = &mut worlds.motions[body];
                let there = centre + sweep + right.rotate(motion.centre - centre);
                motion.centre.put(mask, there);
                motion.rotate(mask, turn, &worlds.model.shapes[body]);
                worlds.outlines.moved(body, set);
            }
        } else {
            let motion = &mut worlds.motions[name];
            motion.centre.add(mask, sweep);
            motion.rotate(mask, turn, &worlds.model.shapes[name]);
            worlds.outlines.moved(name, set);
        }
        self.centres[name].add(mask, sweep);
    }

    /// The groups that a contact acts on.
    pub(crate) fn names_of(&self, contact: &Contacts) -> (usize, usize) {
        (self.names[contact.a], self.names[contact.b])
    }

    /// Their inverse masses.
    pub(crate) fn yields(&self, (a, b): (usize, usize)) -> Yields {
        [if a == STATIC { Twists::ZERO } else { self.inverse_mass[a] }, self.inverse_mass[b]]
    }

    /// Computes the effect of a contact's impulses on the groups that it acts on.
    pub(crate) fn prepare(&self, contact: &mut Contacts, worlds: &Worlds<'_>) {
        let (a, b) = self.names_of(contact);
        let centres = [if a == STATIC { Vector::ZERO } else { self.centres[a] }, self.centres[b]];
        let yields = self.yields((a, b));
        contact.prepare(&worlds.model.shapes, &worlds.motions, centres, &yields);
    }

    /// Corrects a share of the overlap at a contact. Returns the lanes among the given ones in which the gap before the correction
    /// was at least `tolerance` (u).
    pub(crate) fn separate(
        &mut self,
        contact: &Contacts,
        set: LaneSet,
        worlds: &mut Worlds<'_>,
        share: f32,
        tolerance: f32,
    ) -> LaneSet {
        let (a, b) = self.names_of(contact);
        let mut settled = set;
        for point in 0..2 {
            let set = contact.having(set, point);
            if set == 0 {
                continue;
            }
            let (normal, at, gap) = contact.gap(&worlds.motions, point);
            settled &= lanes(at_least(gap, splat(tolerance))) | !set;
            let overlap = set & !lanes(at_least(gap, splat(-LINEAR_SLOP)));
            if overlap == 0 {
                continue;
            }
            let on_b = Twists::of_impulse(normal, at - self.centres[b]);
            let mut response = on_b.through(on_b, self.inverse_mass[b]);
            let on_a = if a == STATIC {
                Twists::ZERO
            } else {
                let on_a = Twists::of_impulse(normal, at - self.centres[a]);
                response = on_a.through(on_a, self.inverse_mass[a]) + response;
                on_a
            };
            // Where two centres coincide no direction separates the bodies.
            let mask = mask(overlap) & !at_most(response, Real::ZERO);
            let impulse = correction(share, gap) / response;
            if a != STATIC {
                let moved = on_a.times(self.inverse_mass[a]).scaled(splat(-1.0) * impulse);
                self.shift(a, mask, worlds, moved.linear(), moved.spin);
            }
            let moved = on_b.times(self.inverse_mass[b]).scaled(splat(1.0) * impulse);
            self.shift(b, mask, worlds, moved.linear(), moved.spin);
        }
        settled
    }

    /// The groups of one lane, for the scalar kernel.
    pub(crate) fn get(&self, lane: usize) -> Groups {
        let vector = |twist: &Twists| {
            let number = |numbers: &Real| super::real::get(numbers, lane);
            Vec3::new(number(&twist.x), number(&twist.y), number(&twist.spin))
        };
        let mut groups = Groups::NONE;
        groups.names = self.names;
        for (body, &name) in self.names.iter().enumerate() {
            groups.bodies[name] |= 1 << body;
        }
        for name in 0..4 {
            groups.inverse_mass_vector[name] = vector(&self.inverse_mass[name]);
            groups.centres[name] = self.centres[name].get(lane);
            groups.twists[name] = crate::body::Twist(vector(&self.twists[name]));
        }
        groups
    }
}

/// Ground friction on one body of a group in each lane, which acts at the body's origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grounds {
    /// From the group's centre of mass to the body's origin (u).
    offset: Vector,
    /// The impulse per unit of slip: (xx, xy, yy).
    mass: [Real; 3],
    impulse: Vector,
    greatest: Real,
}

impl Grounds {
    pub(crate) const NONE: Self =
        Self { offset: Vector::ZERO, mass: [Real::ZERO; 3], impulse: Vector::ZERO, greatest: Real::ZERO };

    /// Friction on a body for some seconds.
    pub(crate) fn new(
        body: usize,
        groups: &LaneGroups,
        shape: &Shape,
        worlds: &Worlds<'_>,
        seconds: Real,
    ) -> Self {
        let name = groups.names[body];
        let origin = worlds.motions[body].place(Vector::splat(Vec2::new(0.0, shape.origin)));
        let offset = origin - groups.centres[name];
        let Twists { x: m, spin: i, .. } = groups.inverse_mass[name];
        let xx = m + i * offset.y * offset.y;
        let xy = -i * offset.x * offset.y;
        let yy = m + i * offset.x * offset.x;
        let scale = splat(1.0) / (xx * yy - xy * xy);
        Self {
            offset,
            mass: [yy * scale, -xy * scale, xx * scale],
            impulse: Vector::ZERO,
            greatest: splat(GROUND_FRICTION) * seconds,
        }
    }

    /// One iteration in some lanes. Returns the maximum change of the impulse (N s) in each.
    #[inline]
    pub(crate) fn solve(&mut self, set: LaneSet, twist: &mut Twists, inverse_mass: Twists) -> Real {
        let mask = mask(set);
        let slip = twist.linear() + self.offset.perp() * twist.spin;
        let [xx, xy, yy] = self.mass;
        let wanted = self.impulse - Vector { x: xx * slip.x + xy * slip.y, y: xy * slip.x + yy * slip.y };
        let length_squared = wanted.length_squared();
        let slides = greater(length_squared, self.greatest * self.greatest);
        let limited = wanted * (self.greatest / length_squared.sqrt());
        let given = Vector::pick(slides, limited, wanted);
        let change = given - self.impulse;
        self.impulse.put(mask, given);
        twist.push(mask, Twists::of_impulse(change, self.offset), splat(1.0), inverse_mass);
        mask & change.max_abs()
    }
}

/// The lanes in which something moves.
pub(crate) fn moving(linear: Vector, spin: Real) -> Real {
    differ(linear.x, Real::ZERO) | differ(linear.y, Real::ZERO) | differ(spin, Real::ZERO)
}

//! Bodies that hold each other, treated as one rigid body.

use crate::{
    body::{BodyMotion, STATIC, Shape, Twist},
    constants::LINEAR_SLOP,
    contact::{Contact, correction},
    key::{BodyMask, KeySet, PAIRS, bit, pair_key},
    turn::turned,
    world::World,
};
use glam::Vec3;
use phase_model::{
    AGENT_COUNT, Action, Vec2,
    physics::{GROUND_FRICTION, MAX_SPEED, MAX_SPIN},
};

/// All bodies of a step in rigid groups. A body that neither holds nor is held is a group of one.
#[derive(Clone, Debug)]
pub(crate) struct Groups {
    /// For each body, the body that names its group: the one of lowest index in it.
    pub(crate) names: [usize; 5],
    /// The bodies of each group, by name.
    pub(crate) bodies: [BodyMask; 5],
    /// Pairs of bodies that belong to the same group, and so cannot touch.
    pub(crate) within: KeySet,
    /// Inverse masses of groups, by name; see [`Shape::inverse_mass_vector`].
    pub(crate) inverse_mass_vector: [Vec3; 5],
    /// Centres of mass of groups, by name (u).
    pub(crate) centres: [Vec2; 5],
    /// Velocities of groups, by name.
    pub(crate) twists: [Twist; 5],
}

impl Groups {
    /// The groups that grips make.
    pub(crate) fn new(world: &World<'_>) -> Self {
        let mut names = [0, 1, 2, 3, STATIC];
        for agent in 0..AGENT_COUNT {
            if let Some(held) = world.held(agent) {
                let kept = names[agent].min(names[held]);
                let given_up = names[agent].max(names[held]);
                for name in &mut names {
                    if *name == given_up {
                        *name = kept;
                    }
                }
            }
        }
        let mut bodies = [0; 5];
        for (body, &name) in names.iter().enumerate() {
            bodies[name] |= 1 << body;
        }
        let mut within = 0;
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            if names[a] == names[b] {
                within |= bit(pair_key(pair));
            }
        }
        let mut groups = Self {
            names,
            bodies,
            within,
            inverse_mass_vector: world.model.shapes.each_ref().map(|shape| shape.inverse_mass_vector),
            centres: [Vec2::ZERO; 5],
            twists: [Twist::ZERO; 5],
        };
        for name in 0..world.model.count {
            groups.compute_mass(name, world);
        }
        groups
    }

    /// The indices of a group's bodies.
    pub(crate) fn bodies_of(&self, name: usize) -> impl Iterator<Item = usize> + use<> {
        let bodies = self.bodies[name];
        (0..4).filter(move |body| bodies & 1 << body != 0)
    }

    /// The names of the groups that some bodies belong to, as a set.
    pub(crate) fn names_of(&self, bodies: BodyMask) -> BodyMask {
        (0..4).filter(|body| bodies & 1 << body != 0).fold(0, |names, body| names | 1 << self.names[body])
    }

    /// Computes mass, centre and moment of inertia of a group of several bodies.
    fn compute_mass(&mut self, name: usize, world: &World<'_>) {
        if self.bodies[name].count_ones() < 2 {
            return;
        }
        let shapes = &world.model.shapes;
        let mut mass = 0.0;
        let mut moment = Vec2::ZERO;
        for body in self.bodies_of(name) {
            mass += shapes[body].mass;
            moment += world.motions[body].centre * shapes[body].mass;
        }
        let centre = moment / mass;
        let mut inertia = 0.0;
        for body in self.bodies_of(name) {
            let arm = world.motions[body].centre.distance_squared(centre);
            inertia += 1.0 / shapes[body].inverse_inertia + shapes[body].mass * arm;
        }
        self.centres[name] = centre;
        self.inverse_mass_vector[name] = Vec3::new(1.0 / mass, 1.0 / mass, 1.0 / inertia);
    }

    /// Takes over the velocities of a group's bodies: total momentum and angular momentum are conserved.
    pub(crate) fn gather_momentum(&mut self, name: usize, world: &World<'_>) {
        if self.bodies[name].count_ones() < 2 {
            let motion = &world.motions[name];
            self.centres[name] = motion.centre;
            self.twists[name] = motion.twist();
            return;
        }
        let mut sum = Twist::ZERO;
        for body in self.bodies_of(name) {
            let shape = &world.model.shapes[body];
            let motion = &world.motions[body];
            let momentum = motion.velocity * shape.mass;
            sum.0 += Twist::of_impulse(momentum, motion.centre - self.centres[name]).0;
            sum.0.z += motion.spin / shape.inverse_inertia;
        }
        self.twists[name] = Twist(sum.0 * self.inverse_mass_vector[name]);
    }

    /// Gives a group's bodies the group's velocity.
    pub(crate) fn distribute_velocity(&self, name: usize, world: &mut World<'_>) {
        let (velocity, spin) = self.twists[name].parts();
        for body in self.bodies_of(name) {
            let motion = &mut world.motions[body];
            motion.velocity = velocity + (motion.centre - self.centres[name]).perp() * spin;
            motion.spin = spin;
        }
    }

    /// Applies `stop` to a body for some substeps. It sets the agent's own velocity to zero in every substep,
    /// and the object it holds transfers some of its velocity back each time.
    pub(crate) fn stop(&mut self, body: usize, world: &World<'_>, substeps: u8) {
        let name = self.names[body];
        let shape = &world.model.shapes[body];
        let motion = &world.motions[body];
        let share = shape.mass * self.inverse_mass_vector[name].x;
        let mut left = 1.0;
        for _ in 0..substeps {
            left *= 1.0 - share;
        }
        let arm = motion.centre - self.centres[name];
        let (velocity, spin) = self.twists[name].parts();
        let own = velocity + arm.perp() * spin;
        let impulse = own * (-shape.mass * (1.0 - left) / share);
        self.twists[name].push(Twist::of_impulse(impulse, arm), 1.0, self.inverse_mass_vector[name]);
    }

    /// Applies an agent's push or turn for some seconds.
    pub(crate) fn act(&mut self, body: usize, world: &World<'_>, seconds: f32) {
        let action = world.actions[body];
        let name = self.names[body];
        let shape = &world.model.shapes[body];
        let motion = &world.motions[body];
        let impulse = if let Some(push) = action.push() {
            let at = motion.place(Vec2::new(0.0, shape.push_point));
            Twist::of_impulse(motion.turn(push * (shape.max_force * seconds)), at - self.centres[name])
        } else {
            Twist(Vec3::new(0.0, 0.0, action.turn() * shape.turn_torque * seconds))
        };
        self.twists[name].push(impulse, 1.0, self.inverse_mass_vector[name]);
    }

    /// Whether a body's action moves anything.
    pub(crate) fn acts(action: Action) -> bool {
        action.push().is_some() || action.turn() != 0.0
    }

    /// Limits a group's velocity.
    pub(crate) fn limit(&mut self, name: usize) {
        let (velocity, spin) = self.twists[name].parts();
        let velocity = velocity.clamp_length_max(MAX_SPEED);
        self.twists[name] = Twist(velocity.extend(spin.clamp(-MAX_SPIN, MAX_SPIN)));
    }

    /// Moves and turns a group.
    pub(crate) fn shift(&mut self, name: usize, world: &mut World<'_>, sweep: Vec2, turn: f32) {
        let centre = self.centres[name];
        let alone = self.bodies[name].count_ones() < 2;
        let right = if alone { Vec2::X } else { turned(Vec2::X, turn) };
        for body in self.bodies_of(name) {
            let shape = &world.model.shapes[body];
            let motion = &mut world.motions[body];
            motion.centre = if alone {
                motion.centre + sweep
            } else {
                centre + sweep + right.rotate(motion.centre - centre)
            };
            motion.rotate(turn, shape);
            world.moved(body);
        }
        self.centres[name] += sweep;
    }

    /// Computes the effect of a contact's impulses on the groups that it acts on.
    pub(crate) fn prepare(&self, contact: &mut Contact, shapes: &[Shape; 5], motions: &[BodyMotion; 5]) {
        let names = (self.names[contact.a], self.names[contact.b]);
        let centres = [self.centres[names.0], self.centres[names.1]];
        let inverse_mass_vector = [self.inverse_mass_vector[names.0], self.inverse_mass_vector[names.1]];
        contact.prepare_rigid(names, centres, inverse_mass_vector, shapes, motions);
    }

    /// Corrects a share of the overlap at a contact. Returns the gap before the correction, negative where
    /// shapes overlap (u).
    pub(crate) fn separate(&mut self, contact: &Contact, world: &mut World<'_>, share: f32) -> f32 {
        let (a, b) = contact.groups;
        let mut least = f32::MAX;
        for point in 0..contact.manifold.count {
            let (normal, at, gap) = contact.gap(&world.motions, point);
            least = least.min(gap);
            if gap >= -LINEAR_SLOP {
                continue;
            }
            let arms = [a, b].map(|name| Twist::of_impulse(normal, at - self.centres[name]));
            let response = arms[0].through(arms[0], self.inverse_mass_vector[a])
                + arms[1].through(arms[1], self.inverse_mass_vector[b]);
            // Where two centres coincide no direction separates the bodies.
            if response <= 0.0 {
                continue;
            }
            let impulse = correction(share, gap) / response;
            for (name, arm, sign) in [(a, arms[0], -1.0), (b, arms[1], 1.0)] {
                if name != STATIC {
                    let (sweep, turn) =
                        Twist(arm.0 * self.inverse_mass_vector[name] * (sign * impulse)).parts();
                    self.shift(name, world, sweep, turn);
                }
            }
        }
        least
    }
}

/// Ground friction on one body of a group, which acts at the body's origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GroundFriction {
    /// From the group's centre of mass to the body's origin (u).
    offset: Vec2,
    /// The impulse per unit of slip: (xx, xy, yy).
    mass: [f32; 3],
    impulse: Vec2,
    greatest: f32,
}

impl GroundFriction {
    pub(crate) const NONE: Self =
        Self { offset: Vec2::ZERO, mass: [0.0; 3], impulse: Vec2::ZERO, greatest: 0.0 };

    /// Friction on a body for some seconds.
    pub(crate) fn new(
        body: usize,
        groups: &Groups,
        shape: &Shape,
        motion: &BodyMotion,
        seconds: f32,
    ) -> Self {
        let name = groups.names[body];
        let offset = motion.place(Vec2::new(0.0, shape.origin)) - groups.centres[name];
        let Vec3 { x: m, z: i, .. } = groups.inverse_mass_vector[name];
        let xx = m + i * offset.y * offset.y;
        let xy = -i * offset.x * offset.y;
        let yy = m + i * offset.x * offset.x;
        let scale = 1.0 / (xx * yy - xy * xy);
        Self {
            offset,
            mass: [yy * scale, -xy * scale, xx * scale],
            impulse: Vec2::ZERO,
            greatest: GROUND_FRICTION * seconds,
        }
    }

    /// One iteration. Returns the maximum change of the impulse (N s).
    #[inline]
    pub(crate) fn solve_friction(&mut self, twist: &mut Twist, inverse_mass_vector: Vec3) -> f32 {
        let (velocity, spin) = twist.parts();
        let slip = velocity + self.offset.perp() * spin;
        let [xx, xy, yy] = self.mass;
        let wanted = self.impulse - Vec2::new(xx * slip.x + xy * slip.y, xy * slip.x + yy * slip.y);
        let length_squared = wanted.length_squared();
        let given = if length_squared > self.greatest * self.greatest {
            wanted * (self.greatest / length_squared.sqrt())
        } else {
            wanted
        };
        let change = given - self.impulse;
        self.impulse = given;
        twist.push(Twist::of_impulse(change, self.offset), 1.0, inverse_mass_vector);
        change.abs().max_element()
    }
}

//! Bodies that touch or hold each other, solved together for one substep.

use super::{
    ANGULAR_SLOP, BODIES, DT, ITERATIONS, LINEAR_SLOP, MAX_JOINTS, WALLS,
    contact::{Constraint, Solved, iterate},
    joint::{Friction, Joint, Solving},
    world::World,
};
use phase_model::Vec2;

/// Share of an overlap that one position iteration corrects.
const BAUMGARTE: f32 = 0.2;
/// Share of an overlap that one position iteration corrects after an impact.
const IMPACT_BAUMGARTE: f32 = 0.75;
const IMPACT_POSITION_ITERATIONS: usize = 20;

impl World {
    /// Solves all islands of a substep.
    pub(super) fn solve(&mut self, is_first: bool) {
        let warmth = Constraint::warmth(is_first);
        let mut linked = [false; BODIES];
        for contact in self.contacts.iter().filter(|contact| contact.acts()) {
            let (a, b) = contact.bodies;
            (linked[a], linked[b]) = (true, true);
        }
        for (a, b) in self.joints.iter().filter_map(Joint::bodies) {
            (linked[a], linked[b]) = (true, true);
        }
        let mut known = [false; BODIES];
        let asleep = self.asleep;
        for seed in (0..self.count()).rev().filter(|&body| !asleep[body]) {
            if !linked[seed] {
                self.solve_alone(seed, warmth);
            } else if !known[seed] {
                self.solve_island(seed, &mut known, warmth);
                known[WALLS] = false;
            }
        }
    }

    /// Solves a body that touches and holds nothing.
    fn solve_alone(&mut self, body: usize, warmth: f32) {
        self.begin(body);
        let Joint::Friction { impulse, .. } = self.joints[body] else { return };
        let at_rest = self.bodies.velocity[body] == Vec2::ZERO && self.bodies.spin[body] == 0.0;
        let idle = self.forces[body] == Vec2::ZERO && self.torques[body] == 0.0;
        if at_rest && idle && impulse == Vec2::ZERO {
            self.place(body);
            return self.fall_asleep(&[body], true);
        }
        self.accelerate(body);
        let mut friction = Friction::new(body, impulse * warmth, &mut self.bodies);
        let mut velocity = self.bodies.velocity[body];
        let mut spin = self.bodies.spin[body];
        iterate(|| friction.rub(&mut velocity, &mut spin));
        (self.bodies.velocity[body], self.bodies.spin[body]) = (velocity, spin);
        self.joints[body] = Joint::Friction { body, impulse: friction.impulse() };
        self.bodies.advance(body, DT);
        self.place(body);
        self.fall_asleep(&[body], true);
    }

    /// Lets bodies that were solved together sleep once all of them have rested long enough.
    fn fall_asleep(&mut self, bodies: &[usize], settled: bool) {
        const LONG_ENOUGH: f32 = 0.5;
        const SLOW: f32 = 0.01;
        let mut least = f32::MAX;
        let moving = |&&body: &&usize| body != WALLS;
        for &body in bodies.iter().filter(moving) {
            let Solved { velocity, spin, .. } = &self.bodies;
            let moves = spin[body] * spin[body] > ANGULAR_SLOP * ANGULAR_SLOP
                || velocity[body].dot(velocity[body]) > SLOW * SLOW;
            self.rest[body] = if moves { 0.0 } else { self.rest[body] + DT };
            least = least.min(self.rest[body]);
        }
        if settled && least >= LONG_ENOUGH {
            for &body in bodies.iter().filter(moving) {
                (self.asleep[body], self.rest[body]) = (true, 0.0);
                (self.bodies.velocity[body], self.bodies.spin[body]) = (Vec2::ZERO, 0.0);
            }
        }
    }

    /// Solves all bodies that are connected with one by contacts and grips.
    fn solve_island(&mut self, seed: usize, known: &mut [bool; BODIES], warmth: f32) {
        let mut constraints = core::mem::take(&mut self.constraints);
        let mut solving = core::mem::take(&mut self.solving);
        let mut joints_known = [false; MAX_JOINTS];
        let mut contacts_known: u64 = 0;
        let mut bodies = [seed; BODIES];
        let mut body_count = 0;
        let mut stack = [seed; BODIES];
        let mut height = 1;
        known[seed] = true;
        while height > 0 {
            height -= 1;
            let body = stack[height];
            bodies[body_count] = body;
            body_count += 1;
            if body == WALLS {
                continue;
            }
            self.wake((body, WALLS));
            let mut reach = |(a, b): (usize, usize)| {
                let other = if a == body { b } else { a };
                if !core::mem::replace(&mut known[other], true) {
                    stack[height] = other;
                    height += 1;
                }
            };
            for (index, contact) in self.contacts.iter().enumerate().rev() {
                let (a, b) = contact.bodies;
                if contacts_known & 1 << index == 0 && (a == body || b == body) && contact.acts() {
                    contacts_known |= 1 << index;
                    constraints.push((index, self.constraint(index, warmth)));
                    reach((a, b));
                }
            }
            for (index, joint) in self.joints.iter().enumerate().rev() {
                if !joints_known[index] && joint.acts_on(body) {
                    joints_known[index] = true;
                    solving.push((index, Solving::NONE));
                    if let Some(bodies) = joint.bodies() {
                        reach(bodies);
                    }
                }
            }
        }
        let bodies = &bodies[..body_count];
        for &body in bodies {
            self.begin(body);
            self.accelerate(body);
        }
        let solved = &mut self.bodies;
        for (_, contact) in &mut constraints {
            contact.prepare(solved);
        }
        for (_, contact) in &constraints {
            contact.warm_start(solved);
        }
        for (index, joint) in &mut solving {
            *joint = Solving::new(&self.joints[*index], solved, warmth);
        }
        iterate(|| {
            let mut changed = false;
            for (_, joint) in &mut solving {
                changed |= joint.solve(solved);
            }
            for (_, contact) in &mut constraints {
                changed |= contact.solve(solved);
            }
            changed
        });
        for &body in bodies {
            solved.advance(body, DT);
        }
        let mut settled = false;
        for _ in 0..ITERATIONS {
            settled = true;
            for (_, contact) in &constraints {
                settled &= contact.separate(solved, BAUMGARTE) >= -3.0 * LINEAR_SLOP;
            }
            for (_, joint) in &solving {
                settled &= joint.join(solved);
            }
            if settled {
                break;
            }
        }
        for (index, contact) in constraints.drain(..) {
            self.contacts[index].impulses = contact.impulses;
        }
        for (index, joint) in solving.drain(..) {
            joint.store(&mut self.joints[index]);
        }
        for &body in bodies {
            self.place(body);
        }
        self.fall_asleep(bodies, settled);
        (self.constraints, self.solving) = (constraints, solving);
    }

    /// Lets a motion begin where a body is.
    fn begin(&mut self, body: usize) {
        self.before[body] = self.bodies.pose(body);
        let sweep = &mut self.sweeps[body];
        (sweep.from, sweep.from_angle) = (self.bodies.centre[body], self.bodies.angle[body]);
    }

    /// Applies the forces of a substep to a body.
    fn accelerate(&mut self, body: usize) {
        let bodies = &mut self.bodies;
        bodies.velocity[body] += DT * (bodies.inverse_mass[body] * self.forces[body]);
        bodies.spin[body] += DT * bodies.inverse_inertia[body] * self.torques[body];
    }

    /// Solves an impact of a body on walls, for the rest of a substep (s).
    pub(super) fn solve_impact(&mut self, body: usize, touching: &[usize], rest: f32) {
        let mut contacts: Vec<Constraint> =
            touching.iter().map(|&index| self.constraint(index, 0.0)).collect();
        let solved = &mut self.bodies;
        for _ in 0..IMPACT_POSITION_ITERATIONS {
            let mut settled = true;
            for contact in &contacts {
                settled &= contact.separate(solved, IMPACT_BAUMGARTE) >= -1.5 * LINEAR_SLOP;
            }
            if settled {
                break;
            }
        }
        self.begin(WALLS);
        self.begin(body);
        let solved = &mut self.bodies;
        for contact in &mut contacts {
            contact.prepare(solved);
        }
        iterate(|| contacts.iter_mut().fold(false, |changed, contact| changed | contact.solve(solved)));
        for body in [WALLS, body] {
            self.bodies.advance(body, rest);
            self.place(body);
        }
    }

    fn constraint(&self, index: usize, warmth: f32) -> Constraint {
        let contact = &self.contacts[index];
        let (a, b) = contact.shapes;
        Constraint::new(contact, (self.shape(a).radius, self.shape(b).radius), warmth)
    }
}

//! One substep of 1/60 s: find contacts, solve velocities, move, solve positions.

use crate::{
    body::{STATIC, Twist},
    constants::{BAUMGARTE, H, IMPULSE_TOLERANCE, LINEAR_SLOP, POSITION_ITERATIONS},
    contact::Contact,
    key::BodyMask,
    touching::{ContactSet, MAX_CONTACTS},
    weld::Weld,
    world::World,
};
use phase_model::AGENT_COUNT;

/// A joint: ground friction of one of four bodies (0 to 3), or the grip of an agent (4 and 5).
type Joint = u8;

impl World<'_> {
    /// Applies forces and solves all given bodies, group by group.
    pub(crate) fn solve(&mut self, reachable_bodies: BodyMask, touching: &mut ContactSet) {
        let mut grasps: [Option<Weld>; AGENT_COUNT] = [None; AGENT_COUNT];
        // Bodies that lean on walls, and bodies that are connected with others.
        let mut leaning: BodyMask = 0;
        let mut linked: BodyMask = 0;
        for (agent, grasp) in grasps.iter_mut().enumerate() {
            if let (Some(grip), Some(held)) = (&self.grips[agent], self.held(agent)) {
                linked |= 1 << agent | 1 << held;
                let impulse = self.impulses.grasps[agent];
                *grasp = Some(Weld::new(agent, grip, &self.model.shapes, impulse));
            }
        }
        for contact in touching.current() {
            if contact.a == STATIC {
                leaning |= 1 << contact.b;
            } else {
                linked |= 1 << contact.a | 1 << contact.b;
            }
        }
        let mut still: BodyMask = 0;
        for body in 0..self.model.count {
            if reachable_bodies & 1 << body == 0 {
                continue;
            }
            let shape = &self.model.shapes[body];
            let motion = &mut self.motions[body];
            self.starts[body] = (motion.centre, motion.angle, motion.right);
            still |= u8::from(motion.is_at_rest()) << body;
            if body < AGENT_COUNT {
                motion.act(shape, self.actions[body], self.max_forces[body]);
                still &= !(u8::from(!motion.is_at_rest()) << body);
            }
            if linked & 1 << body != 0 {
                continue;
            }
            if leaning & 1 << body == 0 {
                self.impulses.ground[body] = motion.coast(shape);
            } else {
                self.solve_alone(body, touching.current_mut());
            }
        }
        let mut done = !(reachable_bodies & linked);
        for seed in (0..self.model.count).rev() {
            if done & 1 << seed == 0 {
                let island = self.island(seed, touching.current(), &grasps, &mut done);
                self.solve_island(&island, &mut touching.contacts, &mut grasps);
            }
        }
        for (impulse, grasp) in self.impulses.grasps.iter_mut().zip(&grasps) {
            if let Some(grasp) = grasp {
                *impulse = grasp.impulse;
            }
        }
        for body in 0..self.model.count {
            if reachable_bodies & 1 << body == 0 {
                continue;
            }
            let motion = &self.motions[body];
            let (centre, angle, _) = self.starts[body];
            if motion.centre != centre || motion.angle != angle {
                self.moved(body);
            } else if still & 1 << body != 0 && motion.is_at_rest() {
                self.sleeping |= 1 << body;
            }
        }
        touching.keep();
    }

    /// All bodies connected with a body by contacts and grips, in the order of solution.
    fn island(
        &self,
        seed: usize,
        contacts: &[Contact],
        grasps: &[Option<Weld>; AGENT_COUNT],
        done: &mut BodyMask,
    ) -> Island {
        let mut island = Island::EMPTY;
        let mut taken = 0_u32;
        let mut joined: u8 = 0;
        let mut stack = [seed; 4];
        let mut height = 1;
        *done |= 1 << seed;
        while height > 0 {
            height -= 1;
            let body = stack[height];
            island.bodies[island.body_count] = body as u8;
            island.body_count += 1;
            let mut reach = |other: usize| {
                if other != STATIC && *done & 1 << other == 0 {
                    *done |= 1 << other;
                    stack[height] = other;
                    height += 1;
                }
            };
            for (index, contact) in contacts.iter().enumerate() {
                if taken & 1 << index == 0 && (contact.a == body || contact.b == body) {
                    taken |= 1 << index;
                    island.contacts[island.contact_count] = index as u8;
                    island.contact_count += 1;
                    reach(if contact.a == body { contact.b } else { contact.a });
                }
            }
            let mut join = |joint: Joint| {
                if joined & 1 << joint == 0 {
                    joined |= 1 << joint;
                    island.joints[island.joint_count] = joint;
                    island.joint_count += 1;
                }
            };
            for agent in [self.latest_grip, 1 - self.latest_grip] {
                if let Some(grasp) = &grasps[agent] {
                    if grasp.agent == body {
                        join(4 + agent as u8);
                        reach(grasp.object);
                    } else if grasp.object == body {
                        join(4 + agent as u8);
                        reach(grasp.agent);
                    }
                }
            }
            join(body as u8);
        }
        island
    }

    /// Solves a body that touches nothing but walls.
    fn solve_alone(&mut self, body: usize, all: &mut [Contact]) {
        let shapes = &self.model.shapes;
        let shape = &shapes[body];
        let motion = &mut self.motions[body];
        let mut twist = motion.twist();
        let mut ground = self.impulses.ground[body];
        for contact in all.iter_mut().filter(|contact| contact.b == body) {
            contact.prepare_alone(shapes, motion);
            contact.warm_start_alone(shape, &mut twist);
        }
        twist.apply_friction(shape, motion.right, ground);
        for _ in 0..self.iterations {
            let after = twist.solve_friction(shape, motion.right, ground);
            let mut change = (after - ground).abs().max_element();
            ground = after;
            for contact in all.iter_mut().filter(|contact| contact.b == body) {
                change = change.max(contact.solve_alone(shape, &mut twist));
            }
            if change < IMPULSE_TOLERANCE {
                break;
            }
        }
        self.impulses.ground[body] = ground;
        motion.set_twist(twist);
        motion.advance(shape, H);
        for _ in 0..POSITION_ITERATIONS {
            let mut settled = true;
            for contact in all.iter().filter(|contact| contact.b == body) {
                settled &= contact.separate_alone(shape, motion, BAUMGARTE) >= -3.0 * LINEAR_SLOP;
            }
            if settled {
                break;
            }
        }
    }

    fn solve_island(
        &mut self,
        island: &Island,
        all: &mut [Contact; MAX_CONTACTS],
        grasps: &mut [Option<Weld>; AGENT_COUNT],
    ) {
        let shapes = &self.model.shapes;
        let motions = &mut self.motions;
        let bodies = &island.bodies[..island.body_count];
        let joints = &island.joints[..island.joint_count];
        let contacts = &island.contacts[..island.contact_count];
        let [a, b, c, d, _] = motions;
        let mut twists = [a.twist(), b.twist(), c.twist(), d.twist(), Twist::ZERO];
        for &index in contacts {
            all[usize::from(index)].prepare(shapes, motions);
        }
        for &index in contacts {
            all[usize::from(index)].warm_start(shapes, &mut twists);
        }
        for &joint in joints {
            let joint = usize::from(joint);
            if joint < 4 {
                twists[joint].apply_friction(
                    &shapes[joint],
                    motions[joint].right,
                    self.impulses.ground[joint],
                );
            } else if let Some(grasp) = &mut grasps[joint - 4] {
                grasp.prepare(shapes, motions, &mut twists);
            }
        }
        for _ in 0..self.iterations {
            let mut change = 0.0_f32;
            for &joint in joints {
                let joint = usize::from(joint);
                if joint < 4 {
                    let before = self.impulses.ground[joint];
                    let after = twists[joint].solve_friction(&shapes[joint], motions[joint].right, before);
                    self.impulses.ground[joint] = after;
                    change = change.max((after - before).abs().max_element());
                } else if let Some(grasp) = &mut grasps[joint - 4] {
                    change = change.max(grasp.solve(shapes, &mut twists));
                }
            }
            for &index in contacts {
                change = change
                    .max(all[usize::from(index)].solve(|body| shapes[body].inverse_mass_vector, &mut twists));
            }
            if change < IMPULSE_TOLERANCE {
                break;
            }
        }
        for &body in bodies {
            let body = usize::from(body);
            motions[body].set_twist(twists[body]);
        }
        for &body in bodies {
            let body = usize::from(body);
            motions[body].advance(&shapes[body], H);
        }
        for _ in 0..POSITION_ITERATIONS {
            let mut settled = true;
            for &index in contacts {
                let gap = all[usize::from(index)].separate(shapes, motions, BAUMGARTE);
                settled &= gap >= -3.0 * LINEAR_SLOP;
            }
            for &joint in joints {
                if let Some(grasp) =
                    usize::from(joint).checked_sub(4).and_then(|agent| grasps[agent].as_ref())
                {
                    settled &= grasp.join(shapes, motions);
                }
            }
            if settled {
                break;
            }
        }
    }
}

/// Connected bodies, with their constraints.
struct Island {
    bodies: [u8; 4],
    body_count: usize,
    contacts: [u8; MAX_CONTACTS],
    contact_count: usize,
    joints: [Joint; 6],
    joint_count: usize,
}

impl Island {
    const EMPTY: Self = Self {
        bodies: [0; 4],
        body_count: 0,
        contacts: [0; MAX_CONTACTS],
        contact_count: 0,
        joints: [0; 6],
        joint_count: 0,
    };
}

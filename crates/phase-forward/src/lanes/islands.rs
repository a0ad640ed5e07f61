//! Bodies that touch or hold each other, in each lane; see [`crate::substep`].

use super::{
    contact::{Contacts, Yields},
    motion::{apply_friction, inverse_mass, solve_friction},
    reach::{BodyLanes, any_body},
    real::{LaneSet, Real, Twists, Vector, lanes, larger, less, mask, splat},
    touching::ContactList,
    weld::Welds,
    worlds::Worlds,
};
use crate::{
    body::STATIC,
    constants::{BAUMGARTE, H, IMPULSE_TOLERANCE, LINEAR_SLOP, POSITION_ITERATIONS},
    key::PAIRS,
};
use arrayvec::ArrayVec;
use phase_model::AGENT_COUNT;

impl Worlds<'_> {
    /// Solves bodies that touch or hold each other. The order of solution depends on which pairs do, so lanes with equal pairs are
    /// solved together.
    pub(crate) fn solve_islands(&mut self, joined: &BodyLanes, contacts: &mut ContactList) {
        let mut left = any_body(joined);
        while left != 0 {
            let lane = left.trailing_zeros();
            let alike = |set: LaneSet| if set & 1 << lane != 0 { set } else { !set };
            let mut group = left;
            let mut pairs = Pairs::new();
            let mut bodies = 0_u8;
            for (body, &set) in joined.iter().enumerate() {
                group &= alike(set);
                bodies |= u8::from(set & 1 << lane != 0) << body;
            }
            for contact in contacts.iter().filter(|contact| !contact.with_wall()) {
                group &= alike(contact.live());
                if contact.live() & 1 << lane != 0 {
                    pairs.push((contact.a, contact.b));
                }
            }
            left &= !group;
            let mut done = !bodies;
            for seed in (0..self.model.count).rev() {
                if done & 1 << seed == 0 {
                    let island = self.island(seed, &pairs, &mut done);
                    self.solve_island(group, &island, contacts);
                }
            }
        }
    }

    /// All bodies connected with a body by contacts, given newest first, and grips, in the order of solution.
    fn island(&self, seed: usize, pairs: &Pairs, done: &mut u8) -> Island {
        let mut island = Island { bodies: [0; 4], body_count: 0, joints: [0; 6], joint_count: 0 };
        let mut taken = 0_u8;
        let mut joined = 0_u8;
        let (mut stack, mut height) = ([seed; 4], 1);
        *done |= 1 << seed;
        while height > 0 {
            height -= 1;
            let body = stack[height];
            island.bodies[island.body_count] = body;
            island.body_count += 1;
            let mut reach = |other: usize| {
                if *done & 1 << other == 0 {
                    *done |= 1 << other;
                    stack[height] = other;
                    height += 1;
                }
            };
            for (pair, &(a, b)) in pairs.iter().enumerate() {
                if taken & 1 << pair == 0 && (a == body || b == body) {
                    taken |= 1 << pair;
                    reach(if a == body { b } else { a });
                }
            }
            let mut join = |joint: usize| {
                if joined & 1 << joint == 0 {
                    joined |= 1 << joint;
                    island.joints[island.joint_count] = joint;
                    island.joint_count += 1;
                }
            };
            for agent in [self.latest_grip, 1 - self.latest_grip] {
                if let Some(object) = self.held[agent] {
                    if agent == body {
                        join(4 + agent);
                        reach(object);
                    } else if object == body {
                        join(4 + agent);
                        reach(agent);
                    }
                }
            }
            join(body);
        }
        island
    }

    fn solve_island(&mut self, set: LaneSet, island: &Island, contacts: &mut ContactList) {
        let shapes = &self.model.shapes;
        let bodies = &island.bodies[..island.body_count];
        let joints = &island.joints[..island.joint_count];
        let order = island.contacts(set, contacts);
        let mut twists = [0, 1, 2, 3].map(|body: usize| self.motions[body].twist());
        let lanes_of = mask(set);
        let yields = |contact: &Contacts| -> Yields {
            let of = |body: usize| if body == STATIC { Twists::ZERO } else { inverse_mass(&shapes[body]) };
            [of(contact.a), of(contact.b)]
        };
        for &index in &order {
            let contact = &mut contacts[index];
            let centre = |body: usize| {
                if body == STATIC { Vector::ZERO } else { self.motions[body].centre }
            };
            let (centres, yields) = ([centre(contact.a), centre(contact.b)], yields(contact));
            contact.prepare(shapes, &self.motions, centres, &yields);
        }
        for &index in &order {
            let contact = &contacts[index];
            contact.apply_warm(set, &yields(contact), &mut twists);
        }
        let mut welds: [Option<Welds>; AGENT_COUNT] =
            [0, 1].map(|agent| Some(Welds::new(self, agent, self.held[agent]?)));
        for &joint in joints {
            if joint < 4 {
                let right = self.motions[joint].right;
                apply_friction(&mut twists[joint], lanes_of, &shapes[joint], right, self.ground[joint]);
            } else if let Some(weld) = &mut welds[joint - 4] {
                weld.prepare(lanes_of, shapes, &self.motions, &mut twists);
            }
        }
        let mut going = set;
        for _ in 0..self.iterations {
            let mut change = Real::ZERO;
            for &joint in joints {
                if joint < 4 {
                    let (before, right) = (self.ground[joint], self.motions[joint].right);
                    let after =
                        solve_friction(&mut twists[joint], mask(going), &shapes[joint], right, before);
                    self.ground[joint].put(mask(going), after);
                    change = larger(change, (after - before).max_abs());
                } else if let Some(weld) = &mut welds[joint - 4] {
                    change = larger(change, weld.solve(mask(going), shapes, &mut twists));
                }
            }
            for &index in &order {
                let contact = &mut contacts[index];
                let (names, yields) = ((contact.a, contact.b), yields(contact));
                change = larger(change, contact.solve(going, names, &yields, &mut twists));
            }
            going &= !lanes(less(change, splat(IMPULSE_TOLERANCE)));
            if going == 0 {
                break;
            }
        }
        for &body in bodies {
            self.motions[body].set_twist(lanes_of, twists[body]);
        }
        for &body in bodies {
            self.motions[body].advance(lanes_of, &shapes[body], splat(H));
        }
        let mut going = set;
        for _ in 0..POSITION_ITERATIONS {
            let mut settled = going;
            for &index in &order {
                let tolerance = -3.0 * LINEAR_SLOP;
                settled &= contacts[index].separate(going, shapes, &mut self.motions, BAUMGARTE, tolerance);
            }
            for &joint in joints {
                if let Some(weld) = joint.checked_sub(4).and_then(|agent| welds[agent].as_ref()) {
                    settled &= weld.join(going, shapes, &mut self.motions);
                }
            }
            going &= !settled;
            if going == 0 {
                break;
            }
        }
        for (agent, weld) in welds.iter().enumerate() {
            if let Some(weld) = weld.as_ref().filter(|_| joints.contains(&(4 + agent))) {
                self.grasps[agent].0.put(lanes_of, weld.impulse.0);
                super::real::put(&mut self.grasps[agent].1, lanes_of, weld.impulse.1);
            }
        }
    }
}

/// Pairs of bodies that touch.
type Pairs = ArrayVec<(usize, usize), { PAIRS.len() }>;

/// Connected bodies, with their joints: ground friction of a body (0 to 3), or the grip of an agent (4 and 5).
struct Island {
    bodies: [usize; 4],
    body_count: usize,
    joints: [usize; 6],
    joint_count: usize,
}

impl Island {
    /// The contacts of its bodies in the order of solution: body by body, newest first.
    fn contacts(
        &self,
        set: LaneSet,
        contacts: &ContactList,
    ) -> ArrayVec<usize, { 2 * crate::touching::MAX_CONTACTS }> {
        let mut order = ArrayVec::new();
        for &body in &self.bodies[..self.body_count] {
            for (index, contact) in contacts.iter().enumerate() {
                let of_body = contact.a == body || contact.b == body;
                if of_body && contact.live() & set != 0 && !order.contains(&index) {
                    order.push(index);
                }
            }
        }
        order
    }
}

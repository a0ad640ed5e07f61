//! Steps of the exact kernel in each lane; see [`crate::forward`] and [`crate::substep`].

use super::{
    contact::{Contacts, Yields},
    motion::{apply_friction, inverse_mass, solve_friction},
    reach::{self, BodyLanes, any_body},
    real::{LaneSet, Real, Twists, Vector, add, differ, lanes, larger, less, mask, splat},
    touching::{ContactList, TraceList},
    weld::Welds,
    worlds::{Start, Worlds},
};
use crate::{
    body::STATIC,
    constants::{BAUMGARTE, H, IMPULSE_TOLERANCE, LINEAR_SLOP, POSITION_ITERATIONS, VELOCITY_ITERATIONS},
    forward::COLD_ITERATIONS,
    key::{PAIRS, pair_key},
};
use phase_model::{AGENT_COUNT, State, arena::SUBSTEPS};

/// One step from states alone, of worlds with equal signatures. Returns the lanes that were not stepped, because something rare
/// has happened in them.
pub(crate) fn step(starts: &[&Start<'_>], states: &mut [State]) -> LaneSet {
    let mut worlds = Worlds::new(starts);
    let worlds = &mut worlds;
    let reachable = reach::reachable_bodies(worlds);
    let together = any_body(&reachable);
    let alone = reachable.map(|reachable| worlds.used & !reachable);
    let (mut contacts, mut traces) = (ContactList::new(), TraceList::new());
    for substep in 0..SUBSTEPS {
        for body in 0..worlds.model.count {
            worlds.drift(body, alone[body]);
        }
        if together == 0 {
            continue;
        }
        worlds.iterations = if substep == 0 { COLD_ITERATIONS } else { VELOCITY_ITERATIONS };
        worlds.substep(&reachable, &mut contacts, &mut traces);
        if worlds.any_released() {
            worlds.restore_pairs();
        }
    }
    worlds.finish(starts, states, together);
    worlds.failed
}

impl Worlds<'_> {
    /// One substep of a body that cannot reach anything.
    #[inline]
    fn drift(&mut self, body: usize, set: LaneSet) {
        if set == 0 {
            return;
        }
        let shape = &self.model.shapes[body];
        let motion = &mut self.motions[body];
        let mut moving = mask(set) & !motion.at_rest();
        if body < AGENT_COUNT {
            moving = mask(set) & !(motion.at_rest() & self.acts[body].idle());
            if !moving.any() {
                return;
            }
            motion.act(moving, shape, &self.acts[body]);
        } else {
            if !moving.any() {
                return;
            }
            // As if by an action that does nothing.
            add(&mut motion.spin, moving, Real::ZERO);
        }
        motion.coast(moving, shape);
        self.outlines.moved(body, set);
    }

    /// One substep of bodies that may touch each other and walls.
    fn substep(&mut self, reachable: &BodyLanes, contacts: &mut ContactList, traces: &mut TraceList) {
        let excluded = self.excluded;
        let (active, pairs) = reach::active_set(self, reachable, &excluded);
        let changing = any_body(&active);
        if changing == 0 {
            return;
        }
        let walls = self.walls_of(&active);
        self.find_contacts(contacts, &pairs, &walls);
        for contact in contacts.iter_mut() {
            if let Some(trace) = traces.iter().find(|trace| trace.key == contact.key) {
                contact.warm_start(trace);
            }
        }
        let boxes = self.outlines.boxes;
        self.solve(&active, contacts);
        // Those of lanes in which nothing changes any more are not needed again.
        traces.clear();
        traces.extend(contacts.iter().map(Contacts::trace));
        for body in 0..self.model.count {
            self.outline(body, active[body]);
        }
        for body in 0..self.model.count {
            let met = reach::may_meet_wall(self, body, active[body], boxes[body]);
            if met != 0 {
                self.impacts(body, met, &splat(H));
            }
        }
    }

    /// Applies forces and solves all given bodies.
    fn solve(&mut self, active: &BodyLanes, contacts: &mut ContactList) {
        let (mut leaning, mut linked): (BodyLanes, BodyLanes) = ([0; 4], [0; 4]);
        for agent in 0..AGENT_COUNT {
            if let Some(held) = self.held[agent] {
                linked[agent] = self.used;
                linked[held] = self.used;
            }
        }
        for contact in contacts.iter() {
            if contact.a == STATIC {
                leaning[contact.b] |= contact.live();
            } else {
                linked[contact.a] |= contact.live();
                linked[contact.b] |= contact.live();
            }
        }
        let mut still = [0; 4];
        for body in 0..self.model.count {
            let set = active[body];
            if set == 0 {
                continue;
            }
            self.start(body, mask(set));
            let shape = &self.model.shapes[body];
            let motion = &mut self.motions[body];
            still[body] = set & lanes(motion.at_rest());
            if body < AGENT_COUNT {
                motion.act(mask(set), shape, &self.acts[body]);
                still[body] &= lanes(motion.at_rest());
            }
            let single = set & !linked[body];
            let coasting = single & !leaning[body];
            if coasting != 0 {
                let rubbed = motion.coast(mask(coasting), shape);
                self.ground[body].put(mask(coasting), rubbed);
            }
            if single & leaning[body] != 0 {
                self.solve_alone(body, single & leaning[body], contacts);
            }
        }
        let mut joined = [0; 4];
        for body in 0..4 {
            joined[body] = active[body] & linked[body];
        }
        if any_body(&joined) != 0 {
            self.solve_islands(&joined, contacts);
        }
        for body in 0..self.model.count {
            let set = active[body];
            if set == 0 {
                continue;
            }
            let (motion, start) = (&self.motions[body], &self.starts[body]);
            let moved = differ(motion.centre.x, start.centre.x)
                | differ(motion.centre.y, start.centre.y)
                | differ(motion.angle, start.angle);
            let moved = set & lanes(moved);
            let rests = set & still[body] & !moved & lanes(motion.at_rest());
            self.outlines.moved(body, moved);
            self.sleeping[body] |= rests;
        }
    }

    /// Solves a body that touches nothing but walls, in the given lanes.
    fn solve_alone(&mut self, body: usize, set: LaneSet, contacts: &mut ContactList) {
        let shapes = &self.model.shapes;
        let shape = &shapes[body];
        let yields: Yields = [Twists::ZERO, inverse_mass(shape)];
        let centres = [Vector::ZERO, self.motions[body].centre];
        let own =
            |contact: &&mut Contacts| contact.b == body && contact.with_wall() && contact.live() & set != 0;
        let mut twists = [Twists::ZERO; 4];
        twists[body] = self.motions[body].twist();
        for contact in contacts.iter_mut().filter(own) {
            contact.prepare(shapes, &self.motions, centres, &yields);
            contact.apply_warm(set, &yields, &mut twists);
        }
        let right = self.motions[body].right;
        apply_friction(&mut twists[body], mask(set), shape, right, self.ground[body]);
        let mut going = set;
        for _ in 0..self.iterations {
            let before = self.ground[body];
            let after = solve_friction(&mut twists[body], mask(going), shape, right, before);
            let mut change = (after - before).max_abs();
            self.ground[body].put(mask(going), after);
            for contact in contacts.iter_mut().filter(own) {
                change = larger(change, contact.solve(going, (STATIC, body), &yields, &mut twists));
            }
            going &= !lanes(less(change, splat(IMPULSE_TOLERANCE)));
            if going == 0 {
                break;
            }
        }
        self.motions[body].set_twist(mask(set), twists[body]);
        self.motions[body].advance(mask(set), shape, splat(H));
        let mut going = set;
        for _ in 0..POSITION_ITERATIONS {
            let mut settled = going;
            for contact in contacts.iter_mut().filter(own) {
                settled &= contact.separate(going, shapes, &mut self.motions, BAUMGARTE, -3.0 * LINEAR_SLOP);
            }
            going &= !settled;
            if going == 0 {
                break;
            }
        }
    }

    /// Solves bodies that touch or hold each other. The order of solution depends on which pairs do, so lanes with equal pairs are
    /// solved together.
    fn solve_islands(&mut self, joined: &BodyLanes, contacts: &mut ContactList) {
        let mut left = any_body(joined);
        while left != 0 {
            let lane = left.trailing_zeros();
            let alike = |set: LaneSet| if set & 1 << lane != 0 { set } else { !set };
            let mut group = left;
            let mut pairs = 0_u8;
            let mut bodies = 0_u8;
            for (body, &set) in joined.iter().enumerate() {
                group &= alike(set);
                bodies |= u8::from(set & 1 << lane != 0) << body;
            }
            for pair in 0..PAIRS.len() {
                let set = contacts
                    .iter()
                    .find(|contact| usize::from(contact.key) == pair_key(pair))
                    .map_or(0, Contacts::live);
                group &= alike(set);
                pairs |= u8::from(set & 1 << lane != 0) << pair;
            }
            left &= !group;
            let mut done = !bodies;
            for seed in (0..self.model.count).rev() {
                if done & 1 << seed == 0 {
                    let island = self.island(seed, pairs, &mut done);
                    self.solve_island(group, &island, contacts);
                }
            }
        }
    }

    /// All bodies connected with a body by contacts and grips, in the order of solution.
    fn island(&self, seed: usize, pairs: u8, done: &mut u8) -> Island {
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
            for (pair, (a, b)) in PAIRS.into_iter().enumerate().rev() {
                if pairs & 1 << pair != 0 && taken & 1 << pair == 0 && (a == body || b == body) {
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

/// Connected bodies, with their joints: ground friction of a body (0 to 3), or the grip of an agent (4 and 5).
struct Island {
    bodies: [usize; 4],
    body_count: usize,
    joints: [usize; 6],
    joint_count: usize,
}

impl Island {
    /// The contacts of its bodies in the order of solution: body by body, newest first.
    fn contacts(&self, set: LaneSet, contacts: &ContactList) -> arrayvec::ArrayVec<usize, 32> {
        let mut order = arrayvec::ArrayVec::new();
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

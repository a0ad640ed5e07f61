//! Steps of the exact kernel in each lane; see [`crate::forward`] and [`crate::substep`].

use super::{
    contact::{Contacts, Yields},
    memory::warm_start,
    motion::{apply_friction, inverse_mass, solve_friction},
    reach::{self, BodyLanes, any_body},
    real::{LaneSet, Real, Twists, Vector, add, differ, lanes, larger, less, mask, splat},
    touching::{ContactList, TraceList},
    worlds::{Start, Worlds},
};
use crate::{
    body::STATIC,
    constants::{
        BAUMGARTE, COLD_ITERATIONS, H, IMPULSE_TOLERANCE, LINEAR_SLOP, POSITION_ITERATIONS,
        VELOCITY_ITERATIONS,
    },
    model::Model,
};
use phase_model::{AGENT_COUNT, State, arena::SUBSTEPS};

/// One step from states alone, of worlds with equal signatures. Returns the lanes that were not stepped, because something rare
/// has happened in them.
pub(crate) fn step(model: &Model, starts: &[&Start], states: &mut [State]) -> LaneSet {
    let mut worlds = Worlds::new(model, starts, states);
    worlds.exclude_pairs(starts, states);
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
        warm_start(contacts, traces);
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
    pub(crate) fn solve(&mut self, active: &BodyLanes, contacts: &mut ContactList) {
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
}

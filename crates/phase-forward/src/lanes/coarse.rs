//! Coarse steps in each lane; see [`crate::coarse`].

use super::{
    groups::{Grounds, LaneGroups, moving},
    reach::{self, BodyLanes, any_body},
    real::{
        LaneSet, Real, Twists, at_least, at_most, differ, each, get, lanes, larger, less, mask, pick, set,
        splat,
    },
    touching::ContactList,
    worlds::{Start, Worlds},
};
use crate::{
    coarse::{BAUMGARTE, ITERATIONS, POSITION_ITERATIONS, TOLERANCE_FACTOR},
    constants::{H, IMPULSE_TOLERANCE, LINEAR_SLOP},
    model::Model,
    wall::MAX_WALLS,
};
use phase_model::{AGENT_COUNT, State, arena, arena::SUBSTEPS};

/// Substeps of the first part of a step in which bodies may collide with each other, and of the second.
const PARTS: [f32; 2] = [3.0, 2.0];
/// A correction below which a contact counts as settled (u).
const SETTLED: f32 = -3.0 * LINEAR_SLOP;

/// One approximate step, of worlds with equal signatures. Returns the lanes that were not stepped, because something rare has
/// happened in them.
pub(crate) fn step(model: &Model, starts: &[&Start], states: &mut [State]) -> LaneSet {
    let mut worlds = Worlds::new(model, starts, states);
    worlds.exclude_pairs(starts, states);
    let worlds = &mut worlds;
    let reachable = reach::reachable_bodies(worlds);
    let together = any_body(&reachable);
    let mut groups = LaneGroups::new(worlds);
    let mut contacts = ContactList::new();
    let whole = splat(SUBSTEPS as f32);
    let mut alone = [0; 4];
    for body in 0..worlds.model.count {
        alone[body] = worlds.used & !reachable[body];
    }
    if any_body(&alone) != 0 {
        worlds.substep_coarse(&mut groups, &alone, &mut contacts, whole);
    }
    if together != 0 {
        let strangers = reach::groups_may_collide(worlds, &groups.names);
        let first = pick(mask(strangers), splat(PARTS[0]), whole);
        worlds.substep_coarse(&mut groups, &reachable, &mut contacts, first);
        worlds.restore_pairs();
        if strangers & together != 0 {
            let reachable = reachable.map(|reachable| reachable & strangers);
            worlds.substep_coarse(&mut groups, &reachable, &mut contacts, splat(PARTS[1]));
            worlds.restore_pairs();
        }
    }
    worlds.finish(starts, states, together);
    worlds.failed
}

impl Worlds<'_> {
    /// One long substep of some bodies, given as whole groups.
    fn substep_coarse(
        &mut self,
        groups: &mut LaneGroups,
        reachable: &BodyLanes,
        contacts: &mut ContactList,
        substeps: Real,
    ) {
        let mut excluded = self.excluded;
        for (excluded, &within) in excluded.iter_mut().zip(&groups.within) {
            if within {
                *excluded = !0;
            }
        }
        let (active, pairs) = reach::active_set(self, reachable, &excluded);
        if any_body(&active) == 0 {
            return;
        }
        let walls = self.walls_of(&active);
        self.find_contacts(contacts, &pairs, &walls);
        let before = self.outlines.boxes;
        let seconds = substeps * splat(H);
        self.solve_coarse(groups, &active, contacts, substeps, seconds);
        let mut met = [0; 4];
        for body in 0..self.model.count {
            self.outline(body, active[body]);
            met[body] = reach::may_meet_wall(self, body, active[body], before[body]);
        }
        for name in 0..self.model.count {
            if groups.names[name] != name {
                continue;
            }
            let mut meeting = [0; 4];
            for body in groups.bodies_of(name) {
                meeting[body] = met[body];
            }
            if any_body(&meeting) != 0 {
                if groups.is_joint(name) {
                    self.resolve_wall_impacts(groups, name, &meeting, &seconds);
                } else {
                    self.impacts(name, meeting[name], &seconds);
                }
                self.resolve_wall_overlaps(groups, name, &meeting, contacts);
            }
        }
        for body in 0..self.model.count {
            // Deeply overlapping bodies can be thrown anywhere.
            let (centre, min, max) = (self.motions[body].centre, arena::MIN, arena::MAX);
            let inside = at_least(centre.x, splat(min.x))
                & at_most(centre.x, splat(max.x))
                & at_least(centre.y, splat(min.y))
                & at_most(centre.y, splat(max.y));
            let outside = active[body] & !lanes(inside);
            self.contain(body, outside, &[0; MAX_WALLS]);
        }
    }

    /// Applies forces, friction and contacts, and moves all given bodies.
    fn solve_coarse(
        &mut self,
        groups: &mut LaneGroups,
        active: &BodyLanes,
        contacts: &mut ContactList,
        substeps: Real,
        seconds: Real,
    ) {
        // See the scalar kernel: the mean speed of several substeps.
        let share = (substeps + splat(1.0)) / (splat(2.0) * substeps);
        let named = groups.named(active);
        for name in 0..self.model.count {
            if named[name] != 0 {
                groups.gather_momentum(name, self);
            }
        }
        let mut still = [0; 4];
        for body in 0..self.model.count {
            if active[body] == 0 {
                continue;
            }
            self.start(body, mask(active[body]));
            still[body] = active[body] & lanes(self.motions[body].at_rest());
            if body < AGENT_COUNT {
                let stops = active[body] & lanes(self.acts[body].stops);
                if stops != 0 {
                    groups.stop(body, stops, self, substeps);
                }
            }
        }
        let earlier = groups.twists;
        let mut grounds = [Grounds::NONE; 4];
        for body in 0..self.model.count {
            if active[body] == 0 {
                continue;
            }
            if body < AGENT_COUNT {
                let acting = active[body] & !lanes(self.acts[body].idle());
                if acting != 0 {
                    groups.act(body, acting, self, seconds);
                    still[body] &= !acting;
                }
            }
            grounds[body] = Grounds::new(body, groups, &self.model.shapes[body], self, seconds);
        }
        let mut touched = [0; 4];
        let mut in_contact = 0;
        for contact in contacts.iter_mut() {
            groups.prepare(contact, self);
            let (a, b) = groups.names_of(contact);
            in_contact |= contact.live();
            touched[b] |= contact.live();
            if !contact.with_wall() {
                touched[a] |= contact.live();
            }
        }
        // For a body that touches only the ground, one iteration is exact.
        let joint = (0..4).filter(|&name| groups.is_joint(name)).fold(0, |set, name| set | named[name]);
        let one_by_one = !(in_contact | joint);
        let mut going = any_body(active);
        for _ in 0..ITERATIONS {
            let mut change = Real::ZERO;
            for body in 0..self.model.count {
                let set = active[body] & going;
                if set != 0 {
                    let name = groups.names[body];
                    let inverse_mass = groups.inverse_mass[name];
                    change = larger(change, grounds[body].solve(set, &mut groups.twists[name], inverse_mass));
                }
            }
            for contact in contacts.iter_mut() {
                let names = groups.names_of(contact);
                let yields = groups.yields(names);
                change = larger(change, contact.solve(going, names, &yields, &mut groups.twists));
            }
            let settled = lanes(less(change, splat(TOLERANCE_FACTOR * IMPULSE_TOLERANCE)));
            going &= !(settled | one_by_one);
            if going == 0 {
                break;
            }
        }
        for name in 0..self.model.count {
            let set = named[name];
            if set == 0 {
                continue;
            }
            groups.limit(name, set);
            let (now, before) = (groups.twists[name], earlier[name]);
            let share = pick(mask(touched[name]), splat(1.0), share);
            let velocity = before.linear() + (now.linear() - before.linear()) * share;
            let spin = before.spin + (now.spin - before.spin) * share;
            let mask = mask(set) & moving(velocity, spin);
            groups.shift(name, mask, self, velocity * seconds, spin * seconds);
        }
        self.separate_coarse(groups, contacts);
        for name in 0..self.model.count {
            if named[name] != 0 {
                groups.distribute_velocity(name, named[name], self);
            }
        }
        for body in 0..self.model.count {
            let set = active[body] & still[body];
            if set != 0 {
                let (motion, start) = (&self.motions[body], &self.starts[body]);
                let moved = differ(motion.centre.x, start.centre.x)
                    | differ(motion.centre.y, start.centre.y)
                    | differ(motion.angle, start.angle);
                self.sleeping[body] |= set & lanes(motion.at_rest()) & !lanes(moved);
            }
        }
    }

    fn separate_coarse(&mut self, groups: &mut LaneGroups, contacts: &ContactList) {
        let mut going = contacts.iter().fold(0, |set, contact| set | contact.live());
        for _ in 0..POSITION_ITERATIONS {
            if going == 0 {
                break;
            }
            let mut settled = going;
            for contact in contacts {
                settled &= groups.separate(contact, going, self, BAUMGARTE, SETTLED);
            }
            going &= !settled;
        }
    }

    /// Resolves impacts of a group of several bodies on walls. Lanes in which one of the given bodies reaches a wall are computed by
    /// the scalar kernel.
    fn resolve_wall_impacts(
        &mut self,
        groups: &mut LaneGroups,
        name: usize,
        met: &BodyLanes,
        seconds: &Real,
    ) {
        let mut walls = [[0; MAX_WALLS]; 4];
        let mut reached = 0;
        for body in groups.bodies_of(name) {
            walls[body] = reach::walls_swept(self, body, met[body]);
            reached |= self.reached(body, met[body], &walls[body]);
        }
        for lane in each(reached) {
            let mut own = groups.get(lane);
            let meeting = groups.bodies_of(name).fold(0, |set, body| set | (met[body] >> lane & 1) << body);
            let seconds = get(seconds, lane);
            let scratch = self.extract(groups.bodies_of(name), lane);
            scratch.resolve_wall_impacts(&mut own, name, meeting, seconds);
            self.insert(groups.bodies_of(name), lane);
            groups.centres[name].set(lane, own.centres[name]);
            set_twist(&mut groups.twists[name], lane, own.twists[name]);
        }
        for body in groups.bodies_of(name) {
            self.contain(body, met[body] & !reached, &walls[body]);
        }
    }

    /// Moves the given bodies of a group out of walls that they have turned or been pushed into, and removes their velocity into
    /// those walls.
    fn resolve_wall_overlaps(
        &mut self,
        groups: &mut LaneGroups,
        name: usize,
        met: &BodyLanes,
        contacts: &mut ContactList,
    ) {
        for body in groups.bodies_of(name) {
            self.outline(body, met[body]);
        }
        let walls = self.walls_of(met);
        self.find_contacts(contacts, &[0; crate::key::PAIRS.len()], &walls);
        let set = contacts.iter().fold(0, |set, contact| set | contact.live());
        if set == 0 {
            return;
        }
        groups.gather_momentum(name, self);
        for contact in contacts.iter_mut() {
            groups.prepare(contact, self);
        }
        for _ in 0..POSITION_ITERATIONS {
            for contact in contacts.iter_mut() {
                let names = groups.names_of(contact);
                let yields = groups.yields(names);
                contact.solve(set, names, &yields, &mut groups.twists);
            }
        }
        self.separate_coarse(groups, contacts);
        groups.distribute_velocity(name, set, self);
    }
}

fn set_twist(twists: &mut Twists, lane: usize, twist: crate::body::Twist) {
    set(&mut twists.x, lane, twist.0.x);
    set(&mut twists.y, lane, twist.0.y);
    set(&mut twists.spin, lane, twist.0.z);
}

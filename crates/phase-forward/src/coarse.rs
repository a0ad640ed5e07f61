//! Coarse steps for the search: fewer, longer substeps and rigid grips.

use crate::{
    constants::{H, IMPULSE_TOLERANCE, LINEAR_SLOP},
    contact::Contact,
    finish::stop_turning,
    group::{GroundFriction, Groups},
    key::{BodyMask, descending},
    model::Model,
    reach,
    time_of_impact::{Sweep, SweepEnds, time_of_impact},
    touching::MAX_CONTACTS,
    world::World,
};
use arrayvec::ArrayVec;
use phase_model::{AGENT_COUNT, Action, State, Vec2, arena, arena::SUBSTEPS};

/// Division of a step, in substeps of 1/60 s, where bodies may collide with each other.
const SUBSTEPS_NEAR_BODIES: &[u8] = &[3, 2];
/// Division of a step, in substeps of 1/60 s, where only walls can be hit; impacts on walls are found in
/// time.
const SUBSTEPS_NEAR_WALLS: &[u8] = &[SUBSTEPS as u8];
/// Maximum number of iterations of the velocity solver.
const ITERATIONS: usize = 10;
/// Convergence threshold of impulse changes, relative to that of the exact solver.
const TOLERANCE_FACTOR: f32 = 10.0;
/// Iterations of the position solver, and the share of an overlap that each corrects.
pub(crate) const POSITION_ITERATIONS: usize = 3;
pub(crate) const BAUMGARTE: f32 = 0.5;

/// The contacts of a substep.
type ContactList = ArrayVec<Contact, MAX_CONTACTS>;

/// One approximate step: as [`phase_model::Dynamics::step`], at a fraction of its cost.
pub(crate) fn step(model: &Model, state: &mut State, actions: [Action; AGENT_COUNT]) {
    let mut world = World::new(model, state, actions);
    let released = world.grab(state);
    world.exclude_pairs(state, released);
    let reachable_bodies = reach::reachable_bodies(&mut world);
    let mut groups = Groups::new(&world);
    let mut touching = ContactList::new();
    let alone = model.everyone() & !reachable_bodies;
    if alone != 0 {
        world.substep_coarse(&mut groups, alone, &mut touching, SUBSTEPS as u8);
    }
    if reachable_bodies != 0 {
        let strangers = reach::groups_may_collide(&world, &groups);
        for &substeps in if strangers { SUBSTEPS_NEAR_BODIES } else { SUBSTEPS_NEAR_WALLS } {
            world.substep_coarse(&mut groups, reachable_bodies, &mut touching, substeps);
            if world.released != 0 {
                world.restore_pairs();
            }
        }
    }
    world.finish(state, if reachable_bodies == 0 { 0 } else { !0 });
    stop_turning(state);
}

impl World<'_> {
    /// One long substep of some bodies, given as whole groups.
    fn substep_coarse(
        &mut self,
        groups: &mut Groups,
        reachable_bodies: BodyMask,
        touching: &mut ContactList,
        substeps: u8,
    ) {
        let excluded_pairs = self.excluded_pairs | groups.within;
        let Some((active, candidates)) = reach::active_set(self, reachable_bodies, excluded_pairs) else {
            return;
        };
        touching.clear();
        touching.extend(self.contacts(candidates).take(MAX_CONTACTS));
        let before = self.outlines.boxes;
        self.solve_coarse(groups, active, touching, substeps);
        self.outline(active);
        let mut met: BodyMask = 0;
        for (body, start) in before.into_iter().enumerate() {
            if active & 1 << body != 0 && reach::may_meet_wall(self, body, start) {
                met |= 1 << body;
            }
        }
        for name in 0..self.model.count {
            let meeting = groups.bodies[name] & met;
            if meeting != 0 {
                self.resolve_wall_impacts(groups, name, meeting, f32::from(substeps) * H);
                self.resolve_wall_overlaps(groups, name, meeting);
            }
        }
        for body in bodies(active) {
            // Deeply overlapping bodies can be thrown anywhere.
            if !arena::contains(self.motions[body].centre) {
                self.contain(body, 0);
            }
        }
    }

    /// Applies forces, friction and contacts, and moves all given bodies.
    fn solve_coarse(
        &mut self,
        groups: &mut Groups,
        active: BodyMask,
        touching: &mut ContactList,
        substeps: u8,
    ) {
        let seconds = f32::from(substeps) * H;
        // The exact kernel moves bodies with the speed at the end of each short substep. With uniform
        // acceleration, that corresponds to this share of the speed gained in a long one.
        let share = f32::from(substeps + 1) / f32::from(2 * substeps);
        let named = groups.names_of(active);
        let mut still: BodyMask = 0;
        for name in bodies(named) {
            groups.gather_momentum(name, self);
        }
        for body in bodies(active) {
            let motion = &self.motions[body];
            self.starts[body] = (motion.centre, motion.angle, motion.right);
            still |= u8::from(motion.is_at_rest()) << body;
            if body < AGENT_COUNT && self.actions[body] == Action::Stop {
                groups.stop(body, self, substeps);
            }
        }
        let earlier = groups.twists;
        let mut grounds = [GroundFriction::NONE; 4];
        for body in bodies(active) {
            if body < AGENT_COUNT && Groups::acts(self.actions[body]) {
                groups.act(body, self, seconds);
                still &= !(1 << body);
            }
            grounds[body] =
                GroundFriction::new(body, groups, &self.model.shapes[body], &self.motions[body], seconds);
        }
        // For a body that touches only the ground, one iteration is exact.
        let one_by_one = touching.is_empty() && named == active;
        let mut touched: BodyMask = 0;
        for contact in touching.iter_mut() {
            groups.prepare(contact, &self.model.shapes, &self.motions);
            touched |= 1 << contact.groups.0 | 1 << contact.groups.1;
        }
        for _ in 0..ITERATIONS {
            let mut change = 0.0_f32;
            for body in bodies(active) {
                let name = groups.names[body];
                change = change.max(
                    grounds[body].solve_friction(&mut groups.twists[name], groups.inverse_mass_vector[name]),
                );
            }
            for contact in touching.iter_mut() {
                change =
                    change.max(contact.solve(|name| groups.inverse_mass_vector[name], &mut groups.twists));
            }
            if change < TOLERANCE_FACTOR * IMPULSE_TOLERANCE || one_by_one {
                break;
            }
        }
        for name in bodies(named) {
            groups.limit(name);
            let (velocity, spin) = groups.twists[name].parts();
            let (earlier_velocity, earlier_spin) = earlier[name].parts();
            let share = if touched & 1 << name == 0 { share } else { 1.0 };
            let mean_velocity = earlier_velocity + (velocity - earlier_velocity) * share;
            let mean_spin = earlier_spin + (spin - earlier_spin) * share;
            if mean_velocity != Vec2::ZERO || mean_spin != 0.0 {
                groups.shift(name, self, mean_velocity * seconds, mean_spin * seconds);
            }
        }
        self.separate_coarse(groups, touching);
        for name in bodies(named) {
            groups.distribute_velocity(name, self);
        }
        for body in bodies(active & still) {
            let motion = &self.motions[body];
            let (centre, angle, _) = self.starts[body];
            if motion.is_at_rest() && motion.centre == centre && motion.angle == angle {
                self.sleeping |= 1 << body;
            }
        }
    }

    fn separate_coarse(&mut self, groups: &mut Groups, touching: &[Contact]) {
        for _ in 0..POSITION_ITERATIONS {
            let mut settled = true;
            for contact in touching {
                settled &= groups.separate(contact, self, BAUMGARTE) >= -3.0 * LINEAR_SLOP;
            }
            if settled {
                break;
            }
        }
    }

    /// Resolves impacts of a group on walls: it stops at the first wall that one of the given bodies reaches,
    /// loses its normal velocity, and continues from there for the remaining time.
    fn resolve_wall_impacts(&mut self, groups: &mut Groups, name: usize, met: BodyMask, seconds: f32) {
        if groups.bodies[name].count_ones() < 2 {
            let walls = reach::walls_swept(self, name);
            self.seconds = seconds;
            self.impacts(name, walls);
            self.contain(name, walls);
            return;
        }
        let mut first = 1.0_f32;
        let mut walls = [0; 4];
        for body in bodies(met) {
            walls[body] = reach::walls_swept(self, body);
            let sweep = self.sweep(body);
            let shape = &self.model.shapes[body];
            let ends = SweepEnds::new(shape, &sweep);
            for key in descending(walls[body]) {
                let wall = &self.model.walls[key / 4];
                if !ends.clear_of(wall)
                    && let Some(share) = time_of_impact(shape, &sweep, wall)
                {
                    first = first.min(share);
                }
            }
        }
        if first < 1.0 {
            self.rewind(groups, name, first);
            let mut touching = ContactList::new();
            self.outline(groups.bodies[name]);
            let walls = walls.into_iter().fold(0, |all, keys| all | keys);
            touching.extend(self.contacts(walls).take(MAX_CONTACTS));
            for contact in touching.iter_mut() {
                groups.prepare(contact, &self.model.shapes, &self.motions);
            }
            for _ in 0..ITERATIONS {
                let mut change = 0.0_f32;
                for contact in touching.iter_mut() {
                    change = change
                        .max(contact.solve(|name| groups.inverse_mass_vector[name], &mut groups.twists));
                }
                if change < TOLERANCE_FACTOR * IMPULSE_TOLERANCE {
                    break;
                }
            }
            let (velocity, spin) = groups.twists[name].parts();
            let left = seconds * (1.0 - first);
            groups.shift(name, self, velocity * left, spin * left);
            self.separate_coarse(groups, &touching);
            groups.distribute_velocity(name, self);
        }
        for body in bodies(met) {
            self.contain(body, walls[body]);
        }
    }

    /// Moves the given bodies of a group out of walls that they have turned or been pushed into, and removes
    /// their velocity into those walls.
    fn resolve_wall_overlaps(&mut self, groups: &mut Groups, name: usize, met: BodyMask) {
        self.outline(met);
        let near = bodies(met).fold(0, |keys, body| keys | reach::walls_near(self, body));
        let mut touching: ContactList = self.contacts(near).take(MAX_CONTACTS).collect();
        if touching.is_empty() {
            return;
        }
        groups.gather_momentum(name, self);
        for contact in &mut touching {
            groups.prepare(contact, &self.model.shapes, &self.motions);
        }
        for _ in 0..POSITION_ITERATIONS {
            for contact in &mut touching {
                contact.solve(|name| groups.inverse_mass_vector[name], &mut groups.twists);
            }
        }
        self.separate_coarse(groups, &touching);
        groups.distribute_velocity(name, self);
    }

    /// A body's path through the substep.
    fn sweep(&self, body: usize) -> Sweep {
        let (from, from_angle, right) = self.starts[body];
        let motion = &self.motions[body];
        Sweep { from, to: motion.centre, from_angle, to_angle: motion.angle, right }
    }

    /// Resets a group to its pose after a share of the substep.
    fn rewind(&mut self, groups: &mut Groups, name: usize, share: f32) {
        let mut turn = 0.0;
        let centre = groups.centres[name];
        let mut mass = 0.0;
        let mut from = Vec2::ZERO;
        for body in groups.bodies_of(name) {
            let (start, angle, right) = self.starts[body];
            let shape = &self.model.shapes[body];
            let motion = &mut self.motions[body];
            turn = motion.angle - angle;
            (motion.centre, motion.angle, motion.right) = (start, angle, right);
            mass += shape.mass;
            from += start * shape.mass;
        }
        groups.centres[name] = from / mass;
        let sweep = centre - groups.centres[name];
        groups.shift(name, self, sweep * share, turn * share);
    }
}

fn bodies(set: BodyMask) -> impl Iterator<Item = usize> + Clone {
    (0..4).filter(move |body| set & 1 << body != 0)
}

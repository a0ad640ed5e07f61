//! Coarse steps for the search: fewer, longer substeps and rigid grips.

use crate::{
    contact::Contact,
    finish::stop_turning,
    group::{Ground, Groups},
    impact::{Ends, Way, impact},
    key::{BodySet, descending},
    model::Model,
    reach,
    touching::MAX_CONTACTS,
    tuning::{H, SETTLED_IMPULSE, SLOP},
    world::World,
};
use arrayvec::ArrayVec;
use phase_model::{AGENT_COUNT, Action, State, Vec2, arena, arena::SUBSTEPS};

/// How a step is divided, in substeps of 1/60 s, where bodies may run into each other.
const AMONG_BODIES: &[u8] = &[3, 2];
/// The same where nothing but walls can be met; impacts on walls are found in time.
const AMONG_WALLS: &[u8] = &[SUBSTEPS as u8];
/// Most iterations of the velocity solver.
const ITERATIONS: usize = 10;
/// Impulses that change by less than this many times the exact solver's measure are settled.
const LENIENCE: f32 = 10.0;
/// Iterations of the position solver, and the share of an overlap that each takes back.
const POSITION_ITERATIONS: usize = 3;
const CORRECTION: f32 = 0.5;

/// The contacts of a substep.
type Touches = ArrayVec<Contact, MAX_CONTACTS>;

/// One approximate step: as [`phase_model::Dynamics::step`], at a fraction of its cost.
pub(crate) fn step(model: &Model, state: &mut State, actions: [Action; AGENT_COUNT]) {
    let mut world = World::new(model, state, actions);
    let let_go = world.grab(state);
    world.part(state, let_go);
    let members = reach::members(&mut world);
    let mut groups = Groups::new(&world);
    let mut touching = Touches::new();
    let alone = model.everyone() & !members;
    if alone != 0 {
        world.substep_coarse(&mut groups, alone, &mut touching, SUBSTEPS as u8);
    }
    if members != 0 {
        let strangers = reach::strangers_meet(&world, &groups);
        for &substeps in if strangers { AMONG_BODIES } else { AMONG_WALLS } {
            world.substep_coarse(&mut groups, members, &mut touching, substeps);
            if world.let_go != 0 {
                world.reunite();
            }
        }
    }
    world.finish(state, if members == 0 { 0 } else { !0 });
    stop_turning(state);
}

impl World<'_> {
    /// One long substep of some bodies, whole groups of them.
    fn substep_coarse(
        &mut self,
        groups: &mut Groups,
        members: BodySet,
        touching: &mut Touches,
        substeps: u8,
    ) {
        let apart = self.apart | groups.within;
        let Some((busy, candidates)) = reach::at_work(self, members, apart) else { return };
        touching.clear();
        touching.extend(self.contacts(candidates).take(MAX_CONTACTS));
        let before = self.outlines.boxes;
        self.solve_coarse(groups, busy, touching, substeps);
        self.outline(busy);
        let mut met: BodySet = 0;
        for (body, start) in before.into_iter().enumerate() {
            if busy & 1 << body != 0 && reach::may_meet_wall(self, body, start) {
                met |= 1 << body;
            }
        }
        for name in 0..self.model.count {
            let meeting = groups.bodies[name] & met;
            if meeting != 0 {
                self.meet_walls(groups, name, meeting, f32::from(substeps) * H);
                self.leave_walls(groups, name, meeting);
            }
        }
        for body in bodies(busy) {
            // Bodies deep inside each other can be thrown anywhere.
            if !arena::contains(self.motions[body].centre) {
                self.contain(body, 0);
            }
        }
    }

    /// Lets forces, friction and contacts act and moves all given bodies.
    fn solve_coarse(&mut self, groups: &mut Groups, busy: BodySet, touching: &mut Touches, substeps: u8) {
        let seconds = f32::from(substeps) * H;
        // The exact kernel moves bodies with the speed at the end of each short substep. Of speed gained
        // evenly, that is this share of a long one.
        let share = f32::from(substeps + 1) / f32::from(2 * substeps);
        let named = groups.names_of(busy);
        let mut still: BodySet = 0;
        for name in bodies(named) {
            groups.gather(name, self);
        }
        for body in bodies(busy) {
            let motion = &self.motions[body];
            self.starts[body] = (motion.centre, motion.angle, motion.right);
            still |= u8::from(motion.is_still()) << body;
            if body < AGENT_COUNT && self.actions[body] == Action::Stop {
                groups.stop(body, self, substeps);
            }
        }
        let earlier = groups.twists;
        let mut grounds = [Ground::NONE; 4];
        for body in bodies(busy) {
            if body < AGENT_COUNT && Groups::acts(self.actions[body]) {
                groups.act(body, self, seconds);
                still &= !(1 << body);
            }
            grounds[body] = Ground::new(body, groups, &self.model.shapes[body], &self.motions[body], seconds);
        }
        // Of a body that nothing but the ground touches, one iteration is exact.
        let one_by_one = touching.is_empty() && named == busy;
        let mut touched: BodySet = 0;
        for contact in touching.iter_mut() {
            groups.prepare(contact, &self.model.shapes, &self.motions);
            touched |= 1 << contact.groups.0 | 1 << contact.groups.1;
        }
        for _ in 0..ITERATIONS {
            let mut change = 0.0_f32;
            for body in bodies(busy) {
                let name = groups.names[body];
                change = change.max(grounds[body].rub(&mut groups.twists[name], groups.yielding[name]));
            }
            for contact in touching.iter_mut() {
                change = change.max(contact.solve(|name| groups.yielding[name], &mut groups.twists));
            }
            if change < LENIENCE * SETTLED_IMPULSE || one_by_one {
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
            groups.spread(name, self);
        }
        for body in bodies(busy & still) {
            let (motion, (centre, angle, _)) = (&self.motions[body], self.starts[body]);
            if motion.is_still() && motion.centre == centre && motion.angle == angle {
                self.at_ease |= 1 << body;
            }
        }
    }

    fn separate_coarse(&mut self, groups: &mut Groups, touching: &[Contact]) {
        for _ in 0..POSITION_ITERATIONS {
            let mut settled = true;
            for contact in touching {
                settled &= groups.separate(contact, self, CORRECTION) >= -3.0 * SLOP;
            }
            if settled {
                break;
            }
        }
    }

    /// Resolves impacts of a group on walls: it stops at the first wall that one of the given bodies of it
    /// reaches, loses its speed into it, and goes on from there for the time left.
    fn meet_walls(&mut self, groups: &mut Groups, name: usize, met: BodySet, seconds: f32) {
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
            let way = self.way(body);
            let shape = &self.model.shapes[body];
            let ends = Ends::new(shape, &way);
            for key in descending(walls[body]) {
                let wall = &self.model.walls[key / 4];
                if !ends.clear_of(wall)
                    && let Some(share) = impact(shape, &way, wall)
                {
                    first = first.min(share);
                }
            }
        }
        if first < 1.0 {
            self.go_back(groups, name, first);
            let mut touching = Touches::new();
            self.outline(groups.bodies[name]);
            let walls = walls.into_iter().fold(0, |all, keys| all | keys);
            touching.extend(self.contacts(walls).take(MAX_CONTACTS));
            for contact in touching.iter_mut() {
                groups.prepare(contact, &self.model.shapes, &self.motions);
            }
            for _ in 0..ITERATIONS {
                let mut change = 0.0_f32;
                for contact in touching.iter_mut() {
                    change = change.max(contact.solve(|name| groups.yielding[name], &mut groups.twists));
                }
                if change < LENIENCE * SETTLED_IMPULSE {
                    break;
                }
            }
            let (velocity, spin) = groups.twists[name].parts();
            let left = seconds * (1.0 - first);
            groups.shift(name, self, velocity * left, spin * left);
            self.separate_coarse(groups, &touching);
            groups.spread(name, self);
        }
        for body in bodies(met) {
            self.contain(body, walls[body]);
        }
    }

    /// Takes the given bodies of a group out of walls that they have turned or been pushed into, and their speed
    /// into those walls with it.
    fn leave_walls(&mut self, groups: &mut Groups, name: usize, met: BodySet) {
        self.outline(met);
        let near = bodies(met).fold(0, |keys, body| keys | reach::walls_near(self, body));
        let mut touching: Touches = self.contacts(near).take(MAX_CONTACTS).collect();
        if touching.is_empty() {
            return;
        }
        groups.gather(name, self);
        for contact in &mut touching {
            groups.prepare(contact, &self.model.shapes, &self.motions);
        }
        for _ in 0..POSITION_ITERATIONS {
            for contact in &mut touching {
                contact.solve(|name| groups.yielding[name], &mut groups.twists);
            }
        }
        self.separate_coarse(groups, &touching);
        groups.spread(name, self);
    }

    /// A body's way through the substep.
    fn way(&self, body: usize) -> Way {
        let (from, from_angle, right) = self.starts[body];
        let motion = &self.motions[body];
        Way { from, to: motion.centre, from_angle, to_angle: motion.angle, right }
    }

    /// Takes a group back to where it was after a share of the substep.
    fn go_back(&mut self, groups: &mut Groups, name: usize, share: f32) {
        let mut turn = 0.0;
        let centre = groups.centres[name];
        let (mut mass, mut from) = (0.0, Vec2::ZERO);
        for body in groups.bodies_of(name) {
            let (start, angle, right) = self.starts[body];
            let (shape, motion) = (&self.model.shapes[body], &mut self.motions[body]);
            turn = motion.angle - angle;
            (motion.centre, motion.angle, motion.right) = (start, angle, right);
            mass += shape.mass;
            from += start * shape.mass;
        }
        groups.centres[name] = from / mass;
        let way = centre - groups.centres[name];
        groups.shift(name, self, way * share, turn * share);
    }
}

fn bodies(set: BodySet) -> impl Iterator<Item = usize> + Clone {
    (0..4).filter(move |body| set & 1 << body != 0)
}

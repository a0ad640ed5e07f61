//! The working data of one step of eight worlds: states unpacked for solving and packed again; see [`crate::world`].

use super::{
    motion::{LaneActions, Motions},
    outline::{Outlines, WallLanes},
    real::{LANES, LaneSet, Real, Vector, at_most, each, get, greater, lanes, less, mask, pick, put, splat},
};
use crate::{
    Exertion,
    constants::{H, VELOCITY_ITERATIONS},
    finish::stop_turning,
    key::{PAIRS, pair_of},
    model::Model,
    released::{APPROACH, CLEARANCE, CLEARANCE_SUBSTEPS},
    wall::MAX_WALLS,
    weld::held_body,
    world::{World, sanitized_grip, unpacked, unpacked_angle},
};
use phase_model::{AGENT_COUNT, Action, AgentId, Body, Contacts, Entity, Grip, State, Vec2, arena};

/// A state that is to be stepped, with its grips after grabbing and releasing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    /// Its place in the batch.
    pub(crate) index: usize,
    grips: [Option<Grip>; AGENT_COUNT],
    /// The body that each agent holds.
    held: [Option<usize>; AGENT_COUNT],
    /// The body that each agent lets go.
    pub(crate) released: [Option<usize>; AGENT_COUNT],
    latest_grip: usize,
    /// Whether each agent grabs something.
    pub(crate) grabbed: [bool; AGENT_COUNT],
    exertion: Exertion,
}

impl Start {
    /// Lets both agents grab or release; see [`World::grab`]. Takes the agent that grabbed last before.
    pub(crate) fn new(
        model: &Model,
        index: usize,
        state: &State,
        latest_grip: usize,
        exertion: Exertion,
    ) -> Self {
        let actions = exertion.actions;
        let mut start = Self {
            index,
            grips: [None; AGENT_COUNT],
            held: [None; AGENT_COUNT],
            released: [None; AGENT_COUNT],
            latest_grip,
            grabbed: [false; AGENT_COUNT],
            exertion,
        };
        let idle = |action: Action| !matches!(action, Action::Attach | Action::Detach);
        if state.grips == [None; AGENT_COUNT] && actions.into_iter().all(idle) {
            return start;
        }
        let mut angles = [0.0; 5];
        for (angle, body) in angles.iter_mut().zip(&state.bodies[..model.count]) {
            *angle = unpacked_angle(body);
        }
        let held = |grip: &Option<Grip>| {
            let body = held_body(grip.as_ref()?);
            (body < model.count).then_some(body)
        };
        for agent in AgentId::ALL {
            let (grip, number) = (&mut start.grips[agent], agent.index());
            *grip = state.grips[agent].map(|grip| sanitized_grip(grip, number, &angles));
            match actions[agent] {
                Action::Attach => {
                    if let Some((object, side)) = state.attachable(&model.physics, agent) {
                        let angle = angles[Entity::Object(object).index()] - angles[number];
                        *grip = Some(Grip { object, side, relative_angle: angle });
                        start.latest_grip = number;
                        start.grabbed[number] = true;
                    }
                }
                Action::Detach => {
                    start.released[agent] = held(grip);
                    *grip = None;
                }
                _ => {}
            }
            start.held[agent] = held(grip);
        }
        start
    }

    /// What must be equal for worlds to be stepped together: what each agent holds, and which of them grabbed last.
    pub(crate) fn signature(&self) -> u8 {
        let held = |agent: usize| self.held[agent].map_or(0, |body| body as u8 - 1);
        held(0) | held(1) << 2 | (self.latest_grip as u8) << 4
    }
}

/// The working data of one step of up to eight worlds in which the agents hold the same objects.
pub(crate) struct Worlds<'a> {
    pub(crate) model: &'a Model,
    /// The lanes in use.
    pub(crate) used: LaneSet,
    /// The lanes that something rare has happened to, which are stepped by the scalar kernel instead.
    pub(crate) failed: LaneSet,
    pub(crate) motions: [Motions; 4],
    /// Where each body was at the start of the substep.
    pub(crate) starts: [Place; 4],
    pub(crate) outlines: Outlines,
    /// For each body and wall, the lanes in which it can be reached in this step.
    pub(crate) walls: [WallLanes; 4],
    /// The body that each agent holds.
    pub(crate) held: [Option<usize>; AGENT_COUNT],
    pub(crate) grips: [[Option<Grip>; AGENT_COUNT]; LANES],
    pub(crate) latest_grip: usize,
    pub(crate) acts: [LaneActions; AGENT_COUNT],
    /// Impulses of ground friction of the last substep (N s).
    pub(crate) ground: [Vector; 4],
    /// Impulses of grips of the last substep (N s and N u s).
    pub(crate) grasps: [(Vector, Real); AGENT_COUNT],
    /// For each pair of bodies, the lanes in which it may not touch, because one holds the other.
    pub(crate) excluded: [LaneSet; PAIRS.len()],
    /// For each pair, the lanes in which its contact tolerates an overlap: released, and not yet clear.
    pub(crate) released: [LaneSet; PAIRS.len()],
    pub(crate) let_go_at: [Vector; 4],
    pub(crate) release_distance: [Real; 4],
    /// For each body, the lanes in which it sleeps.
    pub(crate) sleeping: [LaneSet; 4],
    pub(crate) iterations: usize,
    pub(crate) max_displacements: [Real; 4],
    /// What a body of one lane is computed with where lanes differ too much; made when it is needed.
    scratch: Option<World<'a>>,
}

/// A pose: centre of mass, angle, unit vector to the right.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) centre: Vector,
    pub(crate) angle: Real,
    pub(crate) right: Vector,
}

impl Place {
    pub(crate) const NONE: Self =
        Self { centre: Vector::ZERO, angle: Real::ZERO, right: Vector { x: Real::ONE, y: Real::ZERO } };
}

impl<'a> Worlds<'a> {
    /// Unpacks at most eight states, whose signatures are equal.
    pub(crate) fn new(model: &'a Model, starts: &[&Start], states: &[State]) -> Self {
        let used = !0_u8 >> (LANES - starts.len());
        let mut worlds = Self {
            model,
            used,
            failed: 0,
            motions: [Motions::AT_REST; 4],
            starts: [Place::NONE; 4],
            outlines: Outlines::NONE,
            walls: [[0; MAX_WALLS]; 4],
            held: starts[0].held,
            grips: [[None; AGENT_COUNT]; LANES],
            latest_grip: starts[0].latest_grip,
            acts: [LaneActions::NONE; AGENT_COUNT],
            ground: [Vector::ZERO; 4],
            grasps: [(Vector::ZERO, Real::ZERO); AGENT_COUNT],
            excluded: [0; PAIRS.len()],
            released: [0; PAIRS.len()],
            let_go_at: [Vector::ZERO; 4],
            release_distance: [Real::ZERO; 4],
            sleeping: [0; 4],
            iterations: VELOCITY_ITERATIONS,
            max_displacements: [Real::ZERO; 4],
            scratch: None,
        };
        let mut acts = [[(Action::NoForce, 0.0); LANES]; AGENT_COUNT];
        // Unused lanes repeat the last one, so that no number in them is exceptional.
        for lane in 0..LANES {
            let start = starts[lane.min(starts.len() - 1)];
            for (body, motion) in worlds.motions.iter_mut().enumerate().take(model.count) {
                motion.set(lane, &unpacked(model, body, &states[start.index].bodies[body]));
            }
            worlds.grips[lane] = start.grips;
            for agent in 0..AGENT_COUNT {
                acts[agent][lane] = (start.exertion.actions[agent], start.exertion.max_forces[agent]);
            }
        }
        worlds.acts = acts.map(LaneActions::new);
        worlds
    }

    /// See [`World::exclude_pairs`].
    pub(crate) fn exclude_pairs(&mut self, starts: &[&Start], states: &[State]) {
        let model = self.model;
        for agent in 0..AGENT_COUNT {
            if let Some(held) = self.held[agent] {
                self.excluded[pair_of(agent, held)] |= self.used;
            }
            for (lane, start) in starts.iter().enumerate() {
                if let Some(released) = start.released[agent] {
                    self.released[pair_of(agent, released)] |= 1 << lane;
                }
            }
            let (motion, shape) = (&self.motions[agent], &model.shapes[agent]);
            let origin = motion.place(Vector::splat(Vec2::new(0.0, shape.origin)));
            for object in AGENT_COUNT..model.count {
                let held = &self.motions[object];
                let reach = shape.radius + model.shapes[object].radius;
                let between = held.centre - origin;
                let clear = (reach + CLEARANCE) * (reach + CLEARANCE);
                let mut near = self.used & !lanes(greater(between.length_squared(), splat(clear)));
                if near == 0 {
                    continue;
                }
                for lane in each(near) {
                    let contacts = states[starts[lane].index].contacts;
                    if contacts.touching(Entity::ALL[agent], Entity::ALL[object]) {
                        near &= !(1 << lane);
                    }
                }
                let along = between.dot(motion.right);
                let side = pick(along.is_sign_negative(), splat(-reach), splat(reach));
                let approach = (motion.velocity - held.velocity).dot(between.normalize_or(Vector::ZERO));
                let there = (motion.right * side).distance_squared(between);
                let fits = less(there, splat(CLEARANCE * CLEARANCE)) & less(approach, splat(APPROACH));
                self.released[pair_of(agent, object)] |= near & lanes(fits);
            }
        }
        if self.any_released() {
            for body in 0..model.count {
                let motion = &self.motions[body];
                self.let_go_at[body] = motion.centre;
                let ahead = splat(CLEARANCE_SUBSTEPS * H) * motion.velocity.length();
                self.release_distance[body] = splat(CLEARANCE) + ahead;
            }
        }
    }

    /// Updates the outline of a body in some lanes.
    #[inline]
    pub(crate) fn outline(&mut self, body: usize, set: LaneSet) {
        self.outlines.update(body, set, self.model, &self.motions);
    }

    /// Whether some pair of bodies is released in some lane.
    pub(crate) fn any_released(&self) -> bool {
        self.released.iter().any(|&set| set != 0)
    }

    /// Ends the tolerance of released pairs once one of the two has moved clear.
    pub(crate) fn restore_pairs(&mut self) {
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            if self.released[pair] == 0 {
                continue;
            }
            let moved = |body: usize| {
                let moved = (self.motions[body].centre - self.let_go_at[body]).max_abs();
                lanes(greater(moved, self.release_distance[body]))
            };
            self.released[pair] &= !(moved(a) | moved(b));
        }
    }

    /// Records where the bodies are at the start of a substep.
    #[inline]
    pub(crate) fn start(&mut self, body: usize, mask: Real) {
        let (motion, start) = (&self.motions[body], &mut self.starts[body]);
        start.centre.put(mask, motion.centre);
        put(&mut start.angle, mask, motion.angle);
        start.right.put(mask, motion.right);
    }

    /// Writes what a step ends with into the states of the lanes that have not failed. Contacts are tested for in the given lanes
    /// only.
    pub(crate) fn finish(&mut self, starts: &[&Start], states: &mut [State], candidates: LaneSet) {
        let touching = self.touching(&[candidates; PAIRS.len()]);
        self.write(starts, &touching, states, |state| state);
        for lane in each(self.used & !self.failed) {
            stop_turning(&mut states[starts[lane].index]);
        }
    }

    /// Writes bodies, grips and contacts of the lanes that have not failed into states, one of each place in the batch.
    pub(crate) fn write<T>(
        &self,
        starts: &[&Start],
        touching: &[LaneSet; PAIRS.len()],
        batch: &mut [T],
        state: impl Fn(&mut T) -> &mut State,
    ) {
        for body in 0..self.model.count {
            let (motion, shape) = (&self.motions[body], &self.model.shapes[body]);
            let position = motion.centre + motion.right.perp() * splat(shape.origin);
            for (lane, start) in starts.iter().enumerate() {
                if self.failed & 1 << lane == 0 {
                    state(&mut batch[start.index]).bodies[body] = Body {
                        position: position.get(lane).clamp(arena::MIN, arena::MAX),
                        velocity: motion.velocity.get(lane),
                        angle: get(&motion.angle, lane),
                        angular_velocity: get(&motion.spin, lane),
                    };
                }
            }
        }
        for lane in each(self.used & !self.failed) {
            let state = state(&mut batch[starts[lane].index]);
            state.grips = self.grips[lane];
            state.contacts = Contacts::NONE;
            for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
                if touching[pair] & 1 << lane != 0 {
                    state.contacts.insert(Entity::ALL[a], Entity::ALL[b]);
                }
            }
        }
    }

    /// For each pair of bodies, the lanes among the given ones in which they touch at their present poses.
    pub(crate) fn touching(&mut self, candidates: &[LaneSet; PAIRS.len()]) -> [LaneSet; PAIRS.len()] {
        let mut touching = [0; PAIRS.len()];
        let any = candidates.iter().fold(0, |all, set| all | set);
        if any == 0 {
            return touching;
        }
        let near = self.pairs_near(&[any; 4]);
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            let near = near[pair] & candidates[pair] & !(self.excluded[pair] | self.released[pair]);
            if near != 0 {
                self.outline(a, near);
                self.outline(b, near);
                touching[pair] = self.collide_pair(pair, near).live;
            }
        }
        touching
    }

    /// For each pair of bodies, the lanes in which both belong to a set and their bounding circles overlap now.
    pub(crate) fn pairs_near(&self, bodies: &[LaneSet; 4]) -> [LaneSet; PAIRS.len()] {
        let model = self.model;
        let mut near = [0; PAIRS.len()];
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            let both = bodies[a] & bodies[b];
            if both != 0 && b < model.count {
                let reach = model.shapes[a].bounding_radius + model.shapes[b].bounding_radius;
                let distance = self.motions[a].centre.distance_squared(self.motions[b].centre);
                near[pair] = both & lanes(at_most(distance, splat(reach * reach)));
            }
        }
        near
    }

    /// The overlap of a pair of bodies that their contact does not resist (u).
    #[inline]
    pub(crate) fn tolerated_overlap(&self, pair: usize) -> Real {
        mask(self.released[pair]) & splat(phase_model::physics::RELEASED_OVERLAP)
    }

    /// A world of the scalar kernel with some bodies of one lane, as they were at the start of the substep and as they are now.
    pub(crate) fn extract(&mut self, bodies: impl Iterator<Item = usize>, lane: usize) -> &mut World<'a> {
        let model = self.model;
        let scratch = self.scratch.get_or_insert_with(|| {
            World::new(model, &State::new([Body::default(); 4]), [Action::NoForce; AGENT_COUNT])
        });
        for body in bodies {
            let start = &self.starts[body];
            scratch.starts[body] = (start.centre.get(lane), get(&start.angle, lane), start.right.get(lane));
            scratch.motions[body] = self.motions[body].get(lane);
            scratch.moved(body);
        }
        scratch
    }

    /// Takes some bodies of one lane back from there.
    pub(crate) fn insert(&mut self, bodies: impl Iterator<Item = usize>, lane: usize) {
        if let Some(scratch) = &self.scratch {
            for body in bodies {
                self.motions[body].set(lane, &scratch.motions[body]);
                self.outlines.moved(body, 1 << lane);
            }
        }
    }
}

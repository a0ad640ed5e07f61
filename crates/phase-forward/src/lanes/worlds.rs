//! The working data of one step of eight worlds: states unpacked for solving and packed again; see [`crate::world`].

use super::{
    motion::{LaneActions, Motions},
    outline::{Outlines, WallLanes},
    real::{LANES, LaneSet, Real, Vector, at_most, each, equal, get, greater, lanes, mask, put, set, splat},
};
use crate::{
    constants::VELOCITY_ITERATIONS,
    key::{PAIRS, bit, pair_key},
    model::Model,
    wall::MAX_WALLS,
    world::World,
};
use phase_model::{AGENT_COUNT, Action, Grip, State, Vec2};

/// A state that is to be stepped, with its grips after grabbing and releasing.
pub(crate) struct Start<'a> {
    /// Its place in the batch.
    pub(crate) index: usize,
    pub(crate) world: World<'a>,
}

impl Start<'_> {
    /// What must be equal for worlds to be stepped together: what each agent holds, and which of them grabbed last.
    pub(crate) fn signature(&self) -> u8 {
        let held = |agent: usize| self.world.held(agent).map_or(0, |body| body as u8 - 1);
        held(0) | held(1) << 2 | (self.world.latest_grip as u8) << 4
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
    pub(crate) actions: [[Action; AGENT_COUNT]; LANES],
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
    /// What one body of one lane is computed with where lanes differ too much.
    pub(crate) scratch: World<'a>,
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
    pub(crate) fn new(starts: &[&Start<'a>]) -> Self {
        let first = &starts[0].world;
        let model = first.model;
        let used = !0_u8 >> (LANES - starts.len());
        let mut worlds = Self {
            model,
            used,
            failed: 0,
            motions: [Motions::AT_REST; 4],
            starts: [Place::NONE; 4],
            outlines: Outlines::NONE,
            walls: [[0; MAX_WALLS]; 4],
            held: [first.held(0), first.held(1)],
            grips: [[None; AGENT_COUNT]; LANES],
            latest_grip: first.latest_grip,
            actions: [[Action::NoForce; AGENT_COUNT]; LANES],
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
            scratch: first.clone(),
        };
        for (lane, start) in starts.iter().enumerate() {
            worlds.unpack(lane, &start.world);
        }
        // Unused lanes repeat the first one, so that no number in them is exceptional.
        for lane in starts.len()..LANES {
            worlds.unpack(lane, first);
        }
        for pair in 0..PAIRS.len() {
            worlds.excluded[pair] &= used;
            worlds.released[pair] &= used;
        }
        worlds.acts = [0, 1].map(|agent| LaneActions::new(worlds.actions.map(|actions| actions[agent])));
        worlds
    }

    fn unpack(&mut self, lane: usize, world: &World<'a>) {
        for body in 0..self.model.count {
            self.motions[body].set(lane, &world.motions[body]);
        }
        self.grips[lane] = world.grips;
        self.actions[lane] = world.actions;
        for pair in 0..PAIRS.len() {
            let key = bit(pair_key(pair));
            self.excluded[pair] |= u8::from(world.excluded_pairs & key != 0) << lane;
            self.released[pair] |= u8::from(world.released & key != 0) << lane;
        }
        if world.released != 0 {
            for body in 0..self.model.count {
                self.let_go_at[body].set(lane, world.let_go_at[body]);
                set(&mut self.release_distance[body], lane, world.release_distance[body]);
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

    /// Writes bodies, grips and contacts of the lanes that have not failed into their states. Contacts are tested for in the
    /// given lanes only.
    pub(crate) fn finish(&mut self, starts: &[&Start<'_>], states: &mut [State], candidates: LaneSet) {
        let touching = self.touching(candidates);
        for body in 0..self.model.count {
            let (motion, shape) = (&self.motions[body], &self.model.shapes[body]);
            let position = motion.centre + motion.right.perp() * splat(shape.origin);
            for (lane, start) in starts.iter().enumerate() {
                if self.failed & 1 << lane == 0 {
                    states[start.index].bodies[body] = phase_model::Body {
                        position: position.get(lane),
                        velocity: motion.velocity.get(lane),
                        angle: get(&motion.angle, lane),
                        angular_velocity: get(&motion.spin, lane),
                    };
                }
            }
        }
        for lane in each(self.used & !self.failed) {
            let state = &mut states[starts[lane].index];
            state.grips = self.grips[lane];
            state.contacts = phase_model::Contacts::NONE;
            for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
                if touching[pair] & 1 << lane != 0 {
                    state.contacts.insert(phase_model::Entity::ALL[a], phase_model::Entity::ALL[b]);
                }
            }
            crate::finish::stop_turning(state);
        }
    }

    /// For each pair of bodies, the lanes in which they touch at their present poses.
    fn touching(&mut self, candidates: LaneSet) -> [LaneSet; PAIRS.len()] {
        let mut touching = [0; PAIRS.len()];
        if candidates == 0 {
            return touching;
        }
        let near = self.pairs_near(&[candidates; 4]);
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            let near = near[pair] & !(self.excluded[pair] | self.released[pair]);
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

    /// Puts one body of one lane into the scratch world, as it was at the start of the substep and as it is now.
    pub(crate) fn extract(&mut self, body: usize, lane: usize) {
        let start = &self.starts[body];
        self.scratch.starts[body] = (start.centre.get(lane), get(&start.angle, lane), start.right.get(lane));
        self.scratch.motions[body] = self.motions[body].get(lane);
        self.scratch.moved(body);
    }

    /// Takes one body of one lane back from the scratch world.
    pub(crate) fn insert(&mut self, body: usize, lane: usize) {
        let motion = self.scratch.motions[body];
        self.motions[body].set(lane, &motion);
        self.outlines.moved(body, 1 << lane);
    }
}

impl LaneActions {
    pub(crate) const NONE: Self =
        Self { push: Vector::ZERO, pushes: Real::ZERO, stops: Real::ZERO, turn: Real::ZERO };

    /// What an agent does in each lane.
    pub(crate) fn new(actions: [Action; LANES]) -> Self {
        let mut acts = Self::NONE;
        let (mut pushes, mut stops): (LaneSet, LaneSet) = (0, 0);
        for (lane, action) in actions.into_iter().enumerate() {
            acts.push.set(lane, action.push().unwrap_or(Vec2::ZERO));
            pushes |= u8::from(action.push().is_some()) << lane;
            stops |= u8::from(action == Action::Stop) << lane;
            set(&mut acts.turn, lane, action.turn());
        }
        acts.pushes = mask(pushes);
        acts.stops = mask(stops);
        acts
    }

    /// The lanes in which nothing is done.
    pub(crate) fn idle(&self) -> Real {
        !(self.pushes) & equal(self.turn, Real::ZERO)
    }
}

//! The kernel: the constants of a scene's physics, and steps from state to state.

use crate::{
    Exertion, coarse,
    constants::{COLD_ITERATIONS, VELOCITY_ITERATIONS},
    finish::stop_turning,
    key::BodyMask,
    model::Model,
    reach,
    solver_cache::SolverCache,
    touching::ContactSet,
    world::World,
};
use phase_model::{AGENT_COUNT, Action, Dynamics, PhysicsConfig, State, arena::SUBSTEPS};

/// The dynamics of one scene: walls, shapes, masses and forces, prepared for stepping.
///
/// At most two objects and four inner walls are used, which is all that PHASE has; more are ignored.
#[derive(Clone, Debug)]
pub struct Forward {
    pub(crate) model: Model,
}

impl Forward {
    /// Prepares the dynamics of a scene.
    #[must_use]
    pub fn new(physics: &PhysicsConfig) -> Self {
        Self { model: Model::new(physics) }
    }

    /// These dynamics without collisions between bodies, as if they were points for each other: agents and
    /// objects pass through each other, with walls stopping them at their outlines. Agents grab, hold and
    /// release as before, and [`State::contacts`] still names the bodies that overlap, for who touches whom
    /// is a matter of goals as well.
    #[must_use]
    pub fn without_collisions(mut self) -> Self {
        self.model.collisions = false;
        self
    }

    /// One step (five substeps) from a state alone, with the state after each substep. Impulses of contacts
    /// and grips start from zero, as in [`Dynamics::step`]; the last state is the resulting one.
    pub fn step_substeps(&self, state: &mut State, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        let mut substeps = [*state; SUBSTEPS];
        self.step_cold::<true>(state, actions, |world, substep| {
            world.finish(&mut substeps[substep], !0);
        });
        substeps[SUBSTEPS - 1] = *state;
        substeps
    }

    /// One step (five substeps) warm-started with the impulses of the step before, with the state after each
    /// substep: for replaying recordings as faithfully as possible. The cache must come from
    /// [`Forward::fresh_cache`] or from the step that led to this state.
    pub fn step_warm(
        &self,
        state: &mut State,
        solver_cache: &mut SolverCache,
        actions: [Action; AGENT_COUNT],
    ) -> [State; SUBSTEPS] {
        let max_forces = [0, 1].map(|agent: usize| self.model.shapes[agent].max_force);
        self.step_warm_with(state, solver_cache, &Exertion { actions, max_forces })
    }

    /// [`Forward::step_warm`] by agents whose strengths are not those of the scene.
    pub fn step_warm_with(
        &self,
        state: &mut State,
        solver_cache: &mut SolverCache,
        exertion: &Exertion,
    ) -> [State; SUBSTEPS] {
        let mut world = World::new(&self.model, state, exertion.actions);
        world.max_forces = exertion.max_forces;
        let mut touching = solver_cache.enter(&mut world);
        for (agent, held) in world.grab(state).into_iter().enumerate() {
            if let Some(held) = held {
                solver_cache.release(agent, held);
            }
        }
        let mut substeps = [*state; SUBSTEPS];
        for substep in &mut substeps {
            self.substep_warm(&mut world, solver_cache, &mut touching);
            world.finish(state, solver_cache.active_pairs());
            *substep = *state;
        }
        solver_cache.leave(&world, &touching);
        stop_turning(state);
        substeps[SUBSTEPS - 1] = *state;
        substeps
    }

    /// One approximate step: as [`phase_model::Dynamics::step`], at a fraction of its cost.
    pub fn step_coarse(&self, state: &mut State, actions: [Action; AGENT_COUNT]) {
        coarse::step(&self.model, state, actions);
    }

    /// The cache of a world that has just been set up in a state: no impulses, every pair in reach ready to
    /// touch.
    #[must_use]
    pub fn fresh_cache(&self, state: &State) -> SolverCache {
        SolverCache::new(&World::new(&self.model, state, [Action::NoForce; AGENT_COUNT]))
    }

    /// One substep of 1/60 s without actions. The original runs one before the first step, which pushes
    /// overlapping bodies apart.
    pub fn settle(&self, state: &mut State) {
        let mut world = World::new(&self.model, state, [Action::NoForce; AGENT_COUNT]);
        let mut touching = ContactSet::NONE;
        self.substep_cold(&mut world, self.model.everyone(), &mut touching);
        world.finish(state, !0);
        stop_turning(state);
    }

    /// [`Forward::settle`] with warm starting.
    pub fn settle_warm(&self, state: &mut State, solver_cache: &mut SolverCache) {
        let mut world = World::new(&self.model, state, [Action::NoForce; AGENT_COUNT]);
        let mut touching = solver_cache.enter(&mut world);
        self.substep_warm(&mut world, solver_cache, &mut touching);
        solver_cache.leave(&world, &touching);
        world.finish(state, solver_cache.active_pairs());
        stop_turning(state);
    }

    /// A step from a state alone. `observe` is called with the bodies after each substep if any of them may
    /// touch something, or if `ALL` requests it.
    fn step_cold<const ALL: bool>(
        &self,
        state: &mut State,
        actions: [Action; AGENT_COUNT],
        mut observe: impl FnMut(&mut World<'_>, usize),
    ) {
        let mut world = World::new(&self.model, state, actions);
        let released = world.grab(state);
        world.exclude_pairs(state, released);
        let reachable_bodies = reach::reachable_bodies(&mut world);
        if reachable_bodies == 0 && !ALL {
            for body in AGENT_COUNT..self.model.count {
                self.drift(&mut world, body, SUBSTEPS);
            }
            // Interleaving lets the processor work on both agents at once.
            for _ in 0..SUBSTEPS {
                self.drift(&mut world, 0, 1);
                self.drift(&mut world, 1, 1);
            }
        } else {
            self.step_together(&mut world, reachable_bodies, &mut observe);
        }
        world.finish(state, if reachable_bodies == 0 { 0 } else { !0 });
        stop_turning(state);
    }

    /// The five substeps of a step in which the given bodies may touch something.
    fn step_together(
        &self,
        world: &mut World<'_>,
        reachable_bodies: BodyMask,
        observe: &mut impl FnMut(&mut World<'_>, usize),
    ) {
        let mut touching = ContactSet::NONE;
        for substep in 0..SUBSTEPS {
            for body in 0..self.model.count {
                if reachable_bodies & 1 << body == 0 {
                    self.drift(world, body, 1);
                }
            }
            world.iterations = if substep == 0 { COLD_ITERATIONS } else { VELOCITY_ITERATIONS };
            self.substep_cold(world, reachable_bodies, &mut touching);
            if world.released != 0 {
                world.restore_pairs();
            }
            observe(world, substep);
        }
    }

    /// Several substeps of a body that cannot reach anything.
    #[inline]
    pub(crate) fn drift(&self, world: &mut World<'_>, body: usize, substeps: usize) {
        let shape = &self.model.shapes[body];
        let motion = &mut world.motions[body];
        let (action, max_force) = if body < AGENT_COUNT {
            (world.actions[body], world.max_forces[body])
        } else {
            (Action::NoForce, 0.0)
        };
        if motion.is_at_rest() && action.push().is_none() && action.turn() == 0.0 {
            return;
        }
        for _ in 0..substeps {
            motion.act(shape, action, max_force);
            motion.coast(shape);
        }
        world.moved(body);
    }

    /// One substep of bodies that may touch each other and walls.
    fn substep_cold(&self, world: &mut World<'_>, reachable_bodies: BodyMask, touching: &mut ContactSet) {
        let Some((active, candidates)) = reach::active_set(world, reachable_bodies, world.excluded_pairs)
        else {
            return;
        };
        touching.replace(world.contacts(candidates));
        let before = world.outlines.boxes;
        world.solve(active, touching);
        world.outline(active);
        for (body, start) in before.into_iter().enumerate() {
            if active & 1 << body != 0 && reach::may_meet_wall(world, body, start) {
                let walls = reach::walls_swept(world, body);
                world.impacts(body, walls);
                world.contain(body, walls);
            }
        }
    }

    pub(crate) fn substep_warm(
        &self,
        world: &mut World<'_>,
        solver_cache: &mut SolverCache,
        touching: &mut ContactSet,
    ) {
        solver_cache.drop_stale(world);
        world.all_moved();
        world.outline(self.model.everyone());
        world.released = solver_cache.limited_pairs();
        touching.replace(world.contacts(solver_cache.active_pairs() | world.released));
        solver_cache.sort_newest_first(touching);
        world.solve(self.model.everyone(), touching);
        solver_cache.update_boxes(world);
        for body in 0..self.model.count {
            let walls = reach::walls_swept(world, body);
            if world.impacts(body, walls & solver_cache.active_pairs()).is_some() {
                solver_cache.update_box(world, body);
            }
            world.contain(body, walls);
        }
        solver_cache.find_new_pairs(world);
    }
}

impl Dynamics for Forward {
    /// One step from a state alone: impulses of contacts and grips start from zero.
    fn step(&self, state: &mut State, actions: [Action; AGENT_COUNT]) {
        self.step_cold::<false>(state, actions, |_, _| {});
    }

    /// [`Forward::step_coarse`].
    fn step_approximate(&self, state: &mut State, actions: [Action; AGENT_COUNT]) {
        self.step_coarse(state, actions);
    }
}

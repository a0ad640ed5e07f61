//! Adapters of the project's engines for the comparison with recordings.

use crate::Engine;
use phase_forward::{Forward, OriginalWorld, SolverCache};
use phase_model::{AGENT_COUNT, Action, PhysicsConfig, State, Vec2, arena::SUBSTEPS};
use phase_world::World;

/// The reference world.
pub struct WorldEngine {
    physics: PhysicsConfig,
    world: World,
}

impl Engine for WorldEngine {
    const RUNS_IDLE_SUBSTEP: bool = false;

    fn set_up(physics: &PhysicsConfig, state: &State) -> Self {
        Self { physics: physics.clone(), world: World::new(physics, state) }
    }

    fn settle(&mut self) {
        self.world.settle();
    }

    /// The world's state consists only of poses, velocities and grips, so it can be rebuilt from them.
    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        let mut state = self.world.state();
        state.bodies[body].velocity = velocity;
        self.world = World::new(&self.physics, &state);
    }

    fn state(&self) -> State {
        self.world.state()
    }

    fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        self.world.step(actions)
    }
}

/// The kernel with its cache from step to step, which is its faithful mode.
pub struct WarmForward {
    /// The kernel.
    pub forward: Forward,
    /// Its state; a replay may reset it to the record.
    pub state: State,
    /// Its cache from step to step.
    pub cache: SolverCache,
}

impl Engine for WarmForward {
    const RUNS_IDLE_SUBSTEP: bool = true;

    fn set_up(physics: &PhysicsConfig, state: &State) -> Self {
        let forward = Forward::new(physics);
        let cache = forward.fresh_cache(state);
        Self { forward, state: *state, cache }
    }

    fn settle(&mut self) {
        self.forward.settle_warm(&mut self.state, &mut self.cache);
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        self.state.bodies[body].velocity = velocity;
    }

    fn state(&self) -> State {
        self.state
    }

    fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        self.forward.step_warm(&mut self.state, &mut self.cache, actions)
    }
}

/// The published simulator's own engine.
pub struct OriginalEngine {
    physics: PhysicsConfig,
    world: OriginalWorld,
}

impl Engine for OriginalEngine {
    const RUNS_IDLE_SUBSTEP: bool = true;

    fn set_up(physics: &PhysicsConfig, state: &State) -> Self {
        Self { physics: physics.clone(), world: OriginalWorld::new(physics, state) }
    }

    fn settle(&mut self) {
        self.world.settle();
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        let mut state = *self.world.state();
        state.bodies[body].velocity = velocity;
        self.world = OriginalWorld::new(&self.physics, &state);
    }

    fn state(&self) -> State {
        *self.world.state()
    }

    fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        self.world.step(actions)
    }
}

/// The kernel from the state alone, as planners and beliefs step it.
pub struct ColdForward {
    forward: Forward,
    state: State,
}

impl Engine for ColdForward {
    const RUNS_IDLE_SUBSTEP: bool = true;

    fn set_up(physics: &PhysicsConfig, state: &State) -> Self {
        Self { forward: Forward::new(physics), state: *state }
    }

    fn settle(&mut self) {
        self.forward.settle(&mut self.state);
    }

    fn set_velocity(&mut self, body: usize, velocity: Vec2) {
        self.state.bodies[body].velocity = velocity;
    }

    fn state(&self) -> State {
        self.state
    }

    fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        self.forward.step_substeps(&mut self.state, actions)
    }
}

//! The environment that an event is simulated in, by either engine.

use crate::Engine;
use phase_forward::{Forward, SolverCache};
use phase_model::{AGENT_COUNT, Action, PhysicsConfig, State, arena::SUBSTEPS};
use phase_world::World;

/// The environment: the true dynamics, as opposed to the agents' models of it.
pub(crate) enum Environment {
    World(Box<World>),
    Forward(Box<StatefulForward>),
}

impl Environment {
    /// A newly set-up world in the given state, without any memory of earlier steps.
    pub(crate) fn new(engine: Engine, physics: &PhysicsConfig, state: &State) -> Self {
        match engine {
            Engine::World => Self::World(Box::new(World::new(physics, state))),
            Engine::Forward => {
                let forward = Forward::new(physics);
                let cache = forward.fresh_cache(state);
                Self::Forward(Box::new(StatefulForward { forward, state: *state, cache }))
            }
        }
    }

    /// One step under both agents' actions; the state after each of its substeps.
    pub(crate) fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        match self {
            Self::World(world) => world.step(actions),
            Self::Forward(replay) => replay.forward.step_warm(&mut replay.state, &mut replay.cache, actions),
        }
    }
}

/// The kernel with its cache, which is its closest approximation of the published simulator.
pub(crate) struct StatefulForward {
    forward: Forward,
    state: State,
    cache: SolverCache,
}

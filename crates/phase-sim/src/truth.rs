//! The world that an event plays in, by either engine.

use crate::Engine;
use phase_forward::{Forward, Memory};
use phase_model::{AGENT_COUNT, Action, Physique, State, arena::SUBSTEPS};
use phase_world::World;

/// The environment: the true world, as opposed to the agents' models of it.
pub(crate) enum Truth {
    World(Box<World>),
    Forward(Box<Replay>),
}

impl Truth {
    /// A world at rest in the given state, which remembers nothing from before.
    pub(crate) fn new(engine: Engine, physique: &Physique, state: &State) -> Self {
        match engine {
            Engine::World => Self::World(Box::new(World::new(physique, state))),
            Engine::Forward => {
                let forward = Forward::new(physique);
                let memory = forward.remember(state);
                Self::Forward(Box::new(Replay { forward, state: *state, memory }))
            }
        }
    }

    /// One step under both agents' actions; the state after each of its substeps.
    pub(crate) fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        match self {
            Self::World(world) => world.step(actions),
            Self::Forward(replay) => replay.forward.step_warm(&mut replay.state, &mut replay.memory, actions),
        }
    }
}

/// The kernel with its memory, which is how it comes nearest to the published simulator.
pub(crate) struct Replay {
    forward: Forward,
    state: State,
    memory: Memory,
}

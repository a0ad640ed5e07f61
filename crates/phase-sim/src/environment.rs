//! The environment that an event is simulated in, by either engine.

use crate::Engine;
use phase_forward::{Forward, SolverCache};
use phase_model::{AGENT_COUNT, Action, AgentId, Entity, PhysicsConfig, State, Vec2, arena::SUBSTEPS};
use phase_world::World;

/// The environment: the true dynamics, as opposed to the agents' models of it.
pub struct Environment(Inner);

impl core::fmt::Debug for Environment {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let engine = match self.0 {
            Inner::World(_) => Engine::World,
            Inner::Forward(_) => Engine::Forward,
        };
        formatter.debug_tuple("Environment").field(&engine).finish()
    }
}

enum Inner {
    World(Box<World>),
    Forward(Box<StatefulForward>),
}

impl Environment {
    /// A newly set-up world in the given state, without any memory of earlier steps.
    #[must_use]
    pub fn new(engine: Engine, physics: &PhysicsConfig, state: &State) -> Self {
        Self(match engine {
            Engine::World => Inner::World(Box::new(World::new(physics, state))),
            Engine::Forward => {
                let forward = Forward::new(physics);
                let cache = forward.fresh_cache(state);
                Inner::Forward(Box::new(StatefulForward { forward, state: *state, cache }))
            }
        })
    }

    /// One step under both agents' actions; the state after each of its substeps.
    pub fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        match &mut self.0 {
            Inner::World(world) => world.step(actions),
            Inner::Forward(replay) => replay.forward.step_warm(&mut replay.state, &mut replay.cache, actions),
        }
    }

    /// Sets both agents' velocities to zero and returns the state; objects keep theirs.
    pub fn stop_agents(&mut self) -> State {
        match &mut self.0 {
            Inner::World(world) => {
                world.stop_agents();
                world.state()
            }
            Inner::Forward(replay) => {
                for agent in AgentId::ALL {
                    let body = replay.state.body_mut(Entity::Agent(agent));
                    (body.velocity, body.angular_velocity) = (Vec2::ZERO, 0.0);
                }
                replay.state
            }
        }
    }
}

/// The kernel with its cache, which is its closest approximation of the published simulator.
struct StatefulForward {
    forward: Forward,
    state: State,
    cache: SolverCache,
}

//! The kernel as a world that lasts.

use crate::{Forward, SolverCache};
use phase_model::{AGENT_COUNT, Action, AgentId, Entity, PhysicsConfig, State, Vec2, arena::SUBSTEPS};

/// The kernel as a world that lasts: a state with the impulses of the step that led to it.
#[derive(Clone, Debug)]
pub struct ForwardWorld {
    forward: Forward,
    state: State,
    cache: SolverCache,
}

impl ForwardWorld {
    /// A world in a state. Impulses begin at zero.
    #[must_use]
    pub fn new(physics: &PhysicsConfig, state: &State) -> Self {
        let forward = Forward::new(physics);
        let cache = forward.fresh_cache(state);
        Self { forward, state: *state, cache }
    }

    /// The state of the world.
    #[must_use]
    pub const fn state(&self) -> &State {
        &self.state
    }

    /// Sets the world to a state. Impulses begin at zero.
    pub fn set_state(&mut self, state: &State) {
        (self.state, self.cache) = (*state, self.forward.fresh_cache(state));
    }

    /// Sets both agents' velocities to zero.
    pub fn stop_agents(&mut self) {
        for agent in AgentId::ALL {
            let body = self.state.body_mut(Entity::Agent(agent));
            (body.velocity, body.angular_velocity) = (Vec2::ZERO, 0.0);
        }
    }

    /// Both agents act for a step; returns the states after its substeps.
    pub fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        self.forward.step_warm(&mut self.state, &mut self.cache, actions)
    }
}

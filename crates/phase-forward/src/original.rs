//! The world in which the published events were recorded.

use crate::{
    box2d::{BodyState, World},
    constants::BOUNDARY_MARGIN,
    imagined::{Imagined, body_of},
    world::sanitized,
};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Entity, Grip, PhysicsConfig, State, Vec2,
    arena::{self, SUBSTEPS},
};

/// The world in which the published events were recorded, operation by operation.
///
/// Unlike [`Imagined`], it lasts: impulses and the broad phase carry over from step to step. Pushes act half
/// way between an agent's origin and its centre of mass, grips are welds, and objects keep their spin. A body
/// that gets through the boundary, which takes one that began across it, is put back at rest.
#[derive(Clone, Debug)]
pub struct OriginalWorld {
    dynamics: Imagined,
    world: World,
    state: State,
    /// Whether no substep has been made.
    is_new: bool,
}

impl OriginalWorld {
    /// A world with the bodies and grips of a state. Impulses begin at zero.
    #[must_use]
    pub fn new(physics: &PhysicsConfig, state: &State) -> Self {
        let dynamics = Imagined::new(physics);
        let mut states = [BodyState::STILL; 4];
        for (body, it) in state.bodies.iter().zip(&mut states) {
            let body = sanitized(*body);
            let (place, angle) = (body.position, body.angle);
            *it = BodyState { place, angle, velocity: body.velocity, spin: body.angular_velocity };
        }
        let mut world = dynamics.world(&states);
        let mut state = *state;
        for agent in AgentId::ALL {
            state.grips[agent] = state.grips[agent].filter(|grip| grip.object.index() < physics.object_count);
            if let Some(Grip { object, side, relative_angle }) = state.grips[agent] {
                world.join(dynamics.weld(agent, object, side, relative_angle));
            }
        }
        dynamics.read(&world, &mut state);
        Self { dynamics, world, state, is_new: true }
    }

    /// The state of the world.
    #[must_use]
    pub const fn state(&self) -> &State {
        &self.state
    }

    /// A substep in which nobody acts. The published simulator makes one before the first step, which parts
    /// bodies that overlap.
    pub fn settle(&mut self) {
        self.substep([Action::NoForce; AGENT_COUNT]);
    }

    /// Sets both agents' velocities to zero.
    pub fn stop_agents(&mut self) {
        for agent in AgentId::ALL {
            self.world.stop(agent.index());
            self.world.stop_turning(agent.index());
            let body = self.state.body_mut(Entity::Agent(agent));
            (body.velocity, body.angular_velocity) = (Vec2::ZERO, 0.0);
        }
    }

    /// Both agents act for a step of 1/12 s; returns the states after its substeps.
    pub fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        for agent in AgentId::ALL {
            match actions[agent] {
                Action::Attach => {
                    if let Some((object, side)) = self.state.attachable(&self.dynamics.physics, agent) {
                        let angle = |body: usize| self.state.bodies[body].angle;
                        let relative_angle = angle(body_of(object)) - angle(agent.index());
                        self.state.grips[agent] = Some(Grip { object, side, relative_angle });
                        self.world.join(self.dynamics.weld(agent, object, side, relative_angle));
                    }
                }
                Action::Detach => {
                    if let Some(grip) = self.state.grips[agent].take() {
                        self.world.part((agent.index(), body_of(grip.object)));
                    }
                }
                _ => {}
            }
        }
        let mut substeps = [self.state; SUBSTEPS];
        for (index, after) in substeps.iter_mut().enumerate() {
            self.substep(actions);
            if index + 1 == SUBSTEPS {
                for agent in AgentId::ALL {
                    self.world.stop_turning(agent.index());
                }
                self.dynamics.read(&self.world, &mut self.state);
            }
            *after = self.state;
        }
        substeps
    }

    fn substep(&mut self, actions: [Action; AGENT_COUNT]) {
        const BEHIND: f64 = 1.0 / 12.0;
        for agent in AgentId::ALL {
            self.dynamics.act(&mut self.world, agent, actions[agent], BEHIND);
        }
        self.world.substep(core::mem::take(&mut self.is_new));
        for body in 0..AGENT_COUNT + self.dynamics.physics.object_count {
            self.world.keep_within(body, arena::MIN + BOUNDARY_MARGIN, arena::MAX - BOUNDARY_MARGIN);
        }
        self.dynamics.read(&self.world, &mut self.state);
    }
}

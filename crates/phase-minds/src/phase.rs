//! Our own minds behind the interface.

use crate::{BeliefState, Mind};
use phase_agent::{BeliefView, Foresight, PhaseParameters};
use phase_belief::Belief;
use phase_event::Thought;
use phase_forward::Forward;
use phase_model::{Action, AgentId, PhysicsConfig, Scene, State, random::Pcg64Mcg};
use phase_perception::{Observation, observe};
use phase_pomcp::PomcpError;

pub(crate) fn mind(
    scene: &Scene,
    agent: AgentId,
    parameters: PhaseParameters,
) -> Result<Box<dyn Mind>, PomcpError> {
    let forward = Forward::new(&scene.physics());
    let forward = match parameters.foresight {
        Foresight::Points => forward.without_collisions(),
        Foresight::Coarse | Foresight::Exact => forward,
    };
    Ok(Box::new(phase_agent::Mind::new(scene, agent, forward, parameters)?))
}

pub(crate) fn belief(
    physics: &PhysicsConfig,
    particles: usize,
    observation: &Observation,
    random: &mut Pcg64Mcg,
) -> Box<dyn BeliefState> {
    let belief = Belief::new(physics, observation, particles, random);
    Box::new(PhaseBelief { belief, physics: physics.clone(), forward: Forward::new(physics) })
}

impl Mind for phase_agent::Mind<Forward> {
    fn decide(
        &mut self,
        belief: BeliefView<'_>,
        random: &mut Pcg64Mcg,
    ) -> Result<(Action, Thought), PomcpError> {
        Self::decide(self, belief, random)
    }

    fn boxed(&self) -> Box<dyn Mind> {
        Box::new(self.clone())
    }
}

/// A belief with the dynamics that predict it.
#[derive(Clone, Debug)]
struct PhaseBelief {
    belief: Belief,
    physics: PhysicsConfig,
    forward: Forward,
}

impl BeliefState for PhaseBelief {
    fn observe(&self, state: &State) -> Observation {
        observe(&self.physics, state, self.belief.agent())
    }

    fn update(
        &mut self,
        action: Action,
        observation: &Observation,
        _substeps: &[State],
        random: &mut Pcg64Mcg,
    ) {
        self.belief.update(&self.forward, &self.physics, action, observation, random);
    }

    fn particles(&self) -> &[State] {
        self.belief.particles()
    }

    fn boxed(&self) -> Box<dyn BeliefState> {
        Box::new(self.clone())
    }
}

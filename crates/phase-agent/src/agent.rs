//! From belief to subgoal to action: one agent of Algorithm 1.

use crate::{BeliefView, Mind, MindParameters};
use phase_belief::Belief;
use phase_event::Thought;
use phase_model::{Action, AgentId, BodySet, Dynamics, PhysicsConfig, Scene};
use phase_perception::Observation;
use phase_pomcp::PomcpError;
use rand::Rng;

/// A mind with its own belief.
#[derive(Debug)]
pub struct Agent<D> {
    mind: Mind<D>,
    physics: PhysicsConfig,
    belief: Belief,
    observed: BodySet,
    last_action: Option<Action>,
}

impl<D: Dynamics> Agent<D> {
    /// The agent of a scene, with its initial belief from its first observation.
    ///
    /// # Errors
    /// Invalid search parameters.
    pub fn new(
        scene: &Scene,
        agent: AgentId,
        dynamics: D,
        settings: MindParameters,
        observation: &Observation,
        random: &mut impl Rng,
    ) -> Result<Self, PomcpError> {
        let physics = scene.physics();
        let mind = Mind::new(scene, agent, dynamics, settings)?;
        let belief = Belief::new(&physics, observation, settings.particles, random);
        Ok(Self { mind, physics, belief, observed: observation.observed, last_action: None })
    }

    /// What the agent believes.
    pub const fn belief(&self) -> &Belief {
        &self.belief
    }

    /// Updates the belief with the observation after the last action.
    pub fn perceive(&mut self, action: Action, observation: &Observation, random: &mut impl Rng) {
        self.observed = observation.observed;
        self.last_action = Some(action);
        self.belief.update(self.mind.dynamics(), &self.physics, action, observation, random);
    }

    /// Chooses the next action; returns it with its explanation.
    ///
    /// # Errors
    /// As POMCP's search.
    pub fn decide(&mut self, random: &mut impl Rng) -> Result<(Action, Thought), PomcpError> {
        let belief_view = BeliefView {
            particles: self.belief.particles(),
            observed: self.observed,
            last_action: self.last_action,
        };
        self.mind.decide(belief_view, random)
    }
}

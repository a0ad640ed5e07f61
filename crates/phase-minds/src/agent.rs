//! A mind with its own belief.

use crate::{BeliefState, Mind, belief, mind};
use phase_agent::{BeliefView, MindParameters};
use phase_event::Thought;
use phase_model::{Action, AgentId, BodySet, Scene, State, random::Pcg64Mcg};
use phase_pomcp::PomcpError;

/// One agent of Algorithm 1: it perceives, believes and decides.
#[derive(Debug)]
pub struct Agent {
    mind: Box<dyn Mind>,
    belief: Box<dyn BeliefState>,
    observed: BodySet,
    last_action: Option<Action>,
}

impl Agent {
    /// The agent of a scene, with its initial belief from what it observes of a state.
    ///
    /// # Errors
    /// Invalid search parameters.
    pub fn new(
        scene: &Scene,
        agent: AgentId,
        parameters: &MindParameters,
        state: &State,
        random: &mut Pcg64Mcg,
    ) -> Result<Self, PomcpError> {
        let mind = mind(scene, agent, parameters)?;
        let belief = belief(scene.layout, &scene.physics(), agent, parameters, state, random);
        let observed = belief.observe(state).observed;
        Ok(Self { mind, belief, observed, last_action: None })
    }

    /// What the agent believes.
    #[must_use]
    pub fn belief(&self) -> &dyn BeliefState {
        &*self.belief
    }

    /// Updates the belief with what the agent observes of the state that its action has led to.
    pub fn perceive(&mut self, action: Action, state: &State, random: &mut Pcg64Mcg) {
        let observation = self.belief.observe(state);
        self.observed = observation.observed;
        self.last_action = Some(action);
        self.belief.update(action, &observation, random);
    }

    /// Chooses the next action; returns it with its explanation.
    ///
    /// # Errors
    /// As POMCP's search.
    pub fn decide(&mut self, random: &mut Pcg64Mcg) -> Result<(Action, Thought), PomcpError> {
        let view = BeliefView {
            particles: self.belief.particles(),
            observed: self.observed,
            last_action: self.last_action,
        };
        self.mind.decide(view, random)
    }
}

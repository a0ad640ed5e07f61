//! A mind with its own belief.

use crate::{BeliefState, Mind, MindParameters, belief_in, mind};
use phase_agent::BeliefView;
use phase_event::Thought;
use phase_model::{Action, BodySet, Scene, State, random::Pcg64Mcg};
use phase_perception::Observation;
use phase_pomcp::PomcpError;

/// One agent of Algorithm 1: it perceives, believes and decides.
///
/// Everything that it knows comes from observations. The caller, which has the true state, makes them by the
/// senses of the agent's kind: the first by [`observe()`](crate::observe()), those after an action by
/// [`observe`](Self::observe). A copy that goes on with copies of the generators decides as the original,
/// bit for bit.
#[derive(Clone, Debug)]
pub struct Agent {
    mind: Box<dyn Mind>,
    belief: Box<dyn BeliefState>,
    observed: BodySet,
    last_action: Option<Action>,
}

/// The belief as a mind decides on it.
fn view(belief: &dyn BeliefState, observed: BodySet, last_action: Option<Action>) -> BeliefView<'_> {
    BeliefView {
        particles: belief.particles(),
        observed,
        last_action,
        suppositions: belief.suppositions(),
        contest: belief.contest(),
    }
}

impl Agent {
    /// The agent of a scene that made an observation, its first
    /// ([`first_observation()`](crate::first_observation())), of a state, with the belief that follows
    /// from it.
    ///
    /// # Errors
    /// [`PomcpError`] for parameters that [`MindParameters::validate`] refuses and a search cannot have.
    pub fn new(
        scene: &Scene,
        parameters: &MindParameters,
        observation: &Observation,
        state: Option<&State>,
        random: &mut Pcg64Mcg,
    ) -> Result<Self, PomcpError> {
        let mind = mind(scene, observation.agent, parameters)?;
        let belief = belief_in(scene, parameters, observation, state, random);
        Ok(Self { mind, belief, observed: observation.observed, last_action: None })
    }

    /// The agent's belief.
    #[must_use]
    pub fn belief(&self) -> &dyn BeliefState {
        &*self.belief
    }

    /// The observation that the agent makes of a state of the world.
    #[must_use]
    pub fn observe(&self, state: &State) -> Observation {
        self.belief.observe(state)
    }

    /// Updates the belief with the observation of the state that the agent's action has led to, the last of
    /// the states after the step's substeps ([`BeliefState::update`]).
    pub fn perceive(
        &mut self,
        action: Action,
        observation: &Observation,
        substeps: &[State],
        random: &mut Pcg64Mcg,
    ) {
        self.observed = observation.observed;
        self.last_action = Some(action);
        self.belief.update(action, observation, substeps, random);
    }

    /// Chooses the next action; returns it with its explanation.
    ///
    /// # Errors
    /// [`PomcpError`], if the search fails.
    pub fn decide(&mut self, random: &mut Pcg64Mcg) -> Result<(Action, Thought), PomcpError> {
        let Self { belief, mind, observed, last_action } = self;
        mind.decide(view(&**belief, *observed, *last_action), random)
    }

    /// [`Mind::relive`].
    pub fn relive(&mut self) {
        let Self { belief, mind, observed, last_action } = self;
        mind.relive(view(&**belief, *observed, *last_action));
    }

    /// [`Mind::stream_position`].
    #[must_use]
    pub fn stream_position(&self) -> u64 {
        self.mind.stream_position()
    }

    /// [`Mind::begin_at`].
    pub fn begin_at(&mut self, position: u64) {
        self.mind.begin_at(position);
    }
}

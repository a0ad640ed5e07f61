//! The published simulator's minds behind the interface.

use crate::{BeliefState, Mind};
use phase_agent::{BeliefView, Foresight, MindParameters};
use phase_event::Thought;
use phase_model::{Action, AgentId, Layout, PhysicsConfig, Scene, State, random::Pcg64Mcg};
use phase_perception::Observation;
use phase_pomcp::PomcpError;
use phase_published::{Belief, PublishedParameters, SearchMemo};

pub(crate) fn mind(
    scene: &Scene,
    agent: AgentId,
    parameters: &MindParameters,
    memo: Option<&SearchMemo>,
) -> Result<Box<dyn Mind>, PomcpError> {
    let mind = phase_published::Mind::new(scene, agent, published(parameters))?;
    Ok(match memo {
        Some(memo) => Box::new(mind.sharing(memo.clone())),
        None => Box::new(mind),
    })
}

pub(crate) fn belief(
    layout: Layout,
    physics: &PhysicsConfig,
    agent: AgentId,
    parameters: &MindParameters,
    state: &State,
    random: &mut Pcg64Mcg,
) -> Box<dyn BeliefState> {
    let observation = phase_published::senses::observe(physics, state, agent);
    Box::new(Belief::new(layout, physics, &observation, parameters.particles, random))
}

/// Those of the parameters that published minds have, too.
const fn published(parameters: &MindParameters) -> PublishedParameters {
    PublishedParameters {
        particles: parameters.particles,
        lambda: parameters.lambda,
        simulations: parameters.simulations,
        searches: parameters.searches,
        rollout_steps: parameters.rollout_steps,
        c_init: parameters.c_init,
        c_base: parameters.c_base,
        discount: parameters.discount,
        collisions: !matches!(parameters.foresight, Foresight::Points),
    }
}

impl Mind for phase_published::Mind {
    fn decide(
        &mut self,
        belief: BeliefView<'_>,
        random: &mut Pcg64Mcg,
    ) -> Result<(Action, Thought), PomcpError> {
        Self::decide(self, belief.particles, random)
    }
}

impl BeliefState for Belief {
    fn observe(&self, state: &State) -> Observation {
        Self::observe(self, state)
    }

    fn update(&mut self, action: Action, observation: &Observation, random: &mut Pcg64Mcg) {
        Self::update(self, action, observation, random);
    }

    fn particles(&self) -> &[State] {
        Self::particles(self)
    }

    fn boxed(&self) -> Box<dyn BeliefState> {
        Box::new(self.clone())
    }
}

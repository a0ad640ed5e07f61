//! The published simulator's minds behind the interface.

use crate::{BeliefState, Mind};
use phase_agent::BeliefView;
use phase_event::Thought;
use phase_model::{Action, AgentId, Layout, PhysicsConfig, Scene, State, random::Pcg64Mcg};
use phase_perception::Observation;
use phase_pomcp::PomcpError;
use phase_published::{Belief, PublishedParameters, SearchMemo};

pub(crate) fn mind(
    scene: &Scene,
    agent: AgentId,
    parameters: PublishedParameters,
    memo: Option<&SearchMemo>,
) -> Result<Box<dyn Mind>, PomcpError> {
    let mind = phase_published::Mind::new(scene, agent, parameters)?;
    Ok(match memo {
        Some(memo) => Box::new(mind.sharing(memo.clone())),
        None => Box::new(mind),
    })
}

pub(crate) fn belief(
    layout: Layout,
    physics: &PhysicsConfig,
    parameters: &PublishedParameters,
    observation: &Observation,
    state: Option<&State>,
    random: &mut Pcg64Mcg,
) -> Box<dyn BeliefState> {
    Box::new(Belief::new(layout, physics, parameters, observation, state, random))
}

impl Mind for phase_published::Mind {
    fn decide(
        &mut self,
        belief: BeliefView<'_>,
        random: &mut Pcg64Mcg,
    ) -> Result<(Action, Thought), PomcpError> {
        Self::decide(self, belief.particles, random)
    }

    fn stream_position(&self) -> u64 {
        Self::stream_position(self)
    }

    fn begin_at(&mut self, position: u64) {
        Self::begin_at(self, position);
    }

    fn boxed(&self) -> Box<dyn Mind> {
        Box::new(self.clone())
    }
}

impl BeliefState for Belief {
    fn observe(&self, state: &State) -> Observation {
        Self::observe(self, state)
    }

    fn update(
        &mut self,
        action: Action,
        observation: &Observation,
        substeps: &[State],
        random: &mut Pcg64Mcg,
    ) {
        Self::update(self, action, observation, substeps, random);
    }

    fn particles(&self) -> &[State] {
        Self::particles(self)
    }

    fn boxed(&self) -> Box<dyn BeliefState> {
        Box::new(self.clone())
    }
}

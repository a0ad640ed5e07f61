//! Both agents of a simulation, and their random numbers.

use crate::{SimulationSettings, error::SimulationError};
use phase_event::Thought;
use phase_minds::{Agent, first_observation};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Scene, State,
    arena::SUBSTEPS,
    random::{self, Pcg64Mcg, Purpose},
};

/// For each agent the action that it is given; `None` if its mind decides.
pub type Given = [Option<Action>; AGENT_COUNT];

/// The generator of an agent's belief. It is a separate stream, so that beliefs can be recomputed from a
/// recorded event without planning again.
pub(crate) fn belief_stream(seed: u64, agent: AgentId) -> Pcg64Mcg {
    random::stream(seed, Purpose::Belief, agent.number().into())
}

fn search_stream(seed: u64, agent: AgentId) -> Pcg64Mcg {
    random::stream(seed, Purpose::Search, agent.number().into())
}

/// Both agents with their random streams.
#[derive(Clone, Debug)]
pub(crate) struct Minds {
    pub(crate) agents: [Option<Agent>; AGENT_COUNT],
    beliefs: [Pcg64Mcg; AGENT_COUNT],
    searches: [Pcg64Mcg; AGENT_COUNT],
    /// Decisions made before the step was due.
    decided: [Option<(Action, Thought)>; AGENT_COUNT],
    /// The idle agent, if any.
    idle: Option<AgentId>,
    /// Steps that each agent still waits.
    pub(crate) waits: [u16; AGENT_COUNT],
    /// The position at which the first agent's decision has left the original's random numbers, until the
    /// second decides.
    led_to: Option<u64>,
}

impl Minds {
    pub(crate) fn new(
        scene: &Scene,
        initial: &State,
        seed: u64,
        settings: &SimulationSettings,
        minds: [bool; AGENT_COUNT],
    ) -> Result<Self, SimulationError> {
        let mut beliefs: [Pcg64Mcg; AGENT_COUNT] = AgentId::ALL.map(|agent| belief_stream(seed, agent));
        let searches = AgentId::ALL.map(|agent| search_stream(seed, agent));
        let mut mind = |agent: AgentId| {
            let mut new = || {
                let first = first_observation(scene, settings.minds.kind(), initial, agent);
                Agent::new(scene, &settings.minds, &first, Some(initial), &mut beliefs[agent])
            };
            minds[agent].then(&mut new).transpose()
        };
        let agents = [mind(AgentId::ZERO)?, mind(AgentId::ONE)?];
        let waits = scene.agents.map(|agent| agent.awareness.waits);
        Ok(Self {
            agents,
            beliefs,
            searches,
            decided: [None, None],
            idle: settings.idle,
            waits,
            led_to: None,
        })
    }

    pub(crate) fn decide(
        &mut self,
        given: Given,
    ) -> Result<([Action; AGENT_COUNT], [Thought; AGENT_COUNT]), SimulationError> {
        let (first, why_first) = self.decide_for(AgentId::ZERO, given[AgentId::ZERO])?;
        let (second, why_second) = self.decide_for(AgentId::ONE, given[AgentId::ONE])?;
        Ok(([first, second], [why_first, why_second]))
    }

    fn decide_for(
        &mut self,
        agent: AgentId,
        given: Option<Action>,
    ) -> Result<(Action, Thought), SimulationError> {
        let decided = self.decided[agent].take();
        let waits = self.waits[agent] > 0 && decided.is_none();
        self.waits[agent] = self.waits[agent].saturating_sub(u16::from(waits));
        if let Some(action) = given {
            return Ok((action, Thought::IDLE));
        }
        if let Some(decided) = decided {
            return Ok(decided);
        }
        match &mut self.agents[agent] {
            Some(mind) if self.idle != Some(agent) && !waits => {
                // The original's random numbers go on from the first agent's search to the second's.
                if let (AgentId::ONE, Some(position)) = (agent, self.led_to.take()) {
                    mind.begin_at(position);
                }
                let decided = mind.decide(&mut self.searches[agent])?;
                if agent == AgentId::ZERO {
                    self.led_to = Some(mind.stream_position());
                }
                Ok(decided)
            }
            _ => Ok((Action::Stop, Thought::IDLE)),
        }
    }

    pub(crate) fn decide_ahead(&mut self, agent: AgentId) -> Result<(), SimulationError> {
        if self.decided[agent].is_none() {
            self.decided[agent] = Some(self.decide_for(agent, None)?);
        }
        Ok(())
    }

    pub(crate) fn perceive(&mut self, substeps: &[State; SUBSTEPS], actions: [Action; AGENT_COUNT]) {
        let state = &substeps[SUBSTEPS - 1];
        for (agent, mind) in AgentId::ALL.into_iter().zip(&mut self.agents) {
            if self.idle == Some(agent) {
                continue;
            }
            if let Some(mind) = mind {
                let observation = mind.observe(state);
                mind.perceive(actions[agent], &observation, substeps, &mut self.beliefs[agent]);
            }
        }
    }

    /// From now on the random numbers are those of `seed`, also for decisions that were made ahead.
    pub(crate) fn reseed(&mut self, seed: u64) {
        self.beliefs = AgentId::ALL.map(|agent| belief_stream(seed, agent));
        self.searches = AgentId::ALL.map(|agent| search_stream(seed, agent));
        self.decided = [None, None];
    }
}

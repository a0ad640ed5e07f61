//! G(Y): simulation of the event under a hypothesis.

use crate::{
    Hypothesis, ImaginedAgents, InverseDynamics,
    beliefs::EstimatedBeliefs,
    simulation_run::{Outlook, SimulationRun},
    uninformed::UninformedBeliefs,
};
use phase_event::{ObservedEvent, Thought};
use phase_minds::{BeliefState, MindKind, MindParameters, SearchMemo};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Body, Entity, MAX_ENTITIES, Scene, Vec2,
    random::{self, Pcg64Mcg, Purpose},
};
use phase_pomcp::PomcpError;
use std::sync::Arc;

/// An observed event prepared for inference: everything that all hypotheses share.
#[derive(Clone, Debug)]
pub struct PreparedEvent {
    observed: Arc<ObservedEvent>,
    motion: Arc<InverseDynamics>,
    beliefs: Arc<[EstimatedBeliefs; AGENT_COUNT]>,
    /// Those of a helper or hinderer that does not know the other's goal, if such agents are imagined.
    uninformed: Option<Arc<[UninformedBeliefs; AGENT_COUNT]>>,
    agents: ImaginedAgents,
    seed: u64,
    /// The search results that the minds of all intents share.
    memo: SearchMemo,
}

/// Distances of the trajectories of a simulation from those observed, ‖sᵗ − ŝᵗ‖₂ over the positions of all
/// entities, for each step from 1 on (u).
pub(crate) type Deviations = Vec<f64>;

impl PreparedEvent {
    /// Estimates actions and beliefs of an event. All hypotheses use the same random streams (common random
    /// numbers), so that differences are due to the hypotheses alone.
    #[must_use]
    pub fn new(observed: &ObservedEvent, agents: impl Into<ImaginedAgents>, seed: u64) -> Self {
        let motion = Arc::new(InverseDynamics::new(observed));
        Self::with_motion(Arc::new(observed.clone()), motion, agents.into(), seed)
    }

    /// This event prepared for other agents. What does not depend on agents is taken over.
    #[must_use]
    pub fn with_agents(&self, agents: ImaginedAgents) -> Self {
        Self::with_motion(Arc::clone(&self.observed), Arc::clone(&self.motion), agents, self.seed)
    }

    /// An event whose motion has been explained.
    pub(crate) fn with_motion(
        observed: Arc<ObservedEvent>,
        motion: Arc<InverseDynamics>,
        agents: ImaginedAgents,
        seed: u64,
    ) -> Self {
        let beliefs = AgentId::ALL
            .map(|agent| EstimatedBeliefs::new(&observed, &motion.states, agent, &agents.minds, seed));
        let (beliefs, memo) = (Arc::new(beliefs), SearchMemo::default());
        Self { observed, motion, beliefs, uninformed: None, agents, seed, memo }
    }

    /// This event prepared also for helpers and hinderers that do not know the other's goal, if its agents
    /// have minds of our own kind; others always know it.
    pub(crate) fn with_uninformed(mut self) -> Self {
        if self.agents.minds.kind() == MindKind::Phase {
            let of =
                |agent| UninformedBeliefs::new(&self.observed, &self.motion, agent, &self.agents, self.seed);
            self.uninformed = Some(Arc::new(AgentId::ALL.map(of)));
        }
        self
    }

    /// The beliefs of a helper or hinderer without knowledge of the other's goal, if such are imagined.
    pub(crate) fn uninformed(&self, agent: AgentId) -> Option<&UninformedBeliefs> {
        self.uninformed.as_ref().map(|of_agents| &of_agents[agent])
    }

    /// Follows an event of which more has been observed, and of whose states so many are explained as before.
    pub(crate) fn follow(
        &mut self,
        observed: Arc<ObservedEvent>,
        motion: Arc<InverseDynamics>,
        unchanged: usize,
    ) {
        let beliefs = Arc::make_mut(&mut self.beliefs);
        beliefs.iter_mut().for_each(|beliefs| beliefs.follow(&motion.states, &[], unchanged));
        let same_strengths = motion.strengths() == self.motion.strengths();
        (self.observed, self.motion) = (observed, motion);
        match &mut self.uninformed {
            Some(uninformed) if same_strengths => {
                let of_agents = Arc::make_mut(uninformed).iter_mut();
                of_agents.for_each(|beliefs| beliefs.follow(&self.motion, unchanged));
            }
            Some(_) => *self = self.clone().with_uninformed(),
            None => {}
        }
    }

    /// The agents that it was prepared for.
    #[must_use]
    pub const fn agents(&self) -> &ImaginedAgents {
        &self.agents
    }

    /// The belief that an agent can be taken to have after so many steps, or after all of them if there are
    /// fewer, from what it could observe. All intents share it.
    #[must_use]
    pub fn belief(&self, agent: AgentId, step: usize) -> &dyn BeliefState {
        self.beliefs[agent].after(step)
    }

    /// Agents that act: their minds search once.
    const fn acting(&self) -> ImaginedAgents {
        self.agents.with_minds(self.agents.minds.searching_once())
    }

    /// The event.
    #[must_use]
    pub fn observed(&self) -> &ObservedEvent {
        &self.observed
    }

    /// The event, to be shared.
    pub(crate) const fn shared_observed(&self) -> &Arc<ObservedEvent> {
        &self.observed
    }

    /// The inferred actions, and the states between steps.
    #[must_use]
    pub fn motion(&self) -> &InverseDynamics {
        &self.motion
    }

    /// Simulates the event under a hypothesis and returns its deviations. Every `resync_interval` steps the
    /// simulation is resynchronised with the observed state; with `None` it runs freely from the start, as in
    /// the paper. It stops early once the sum of deviations exceeds `limit`; then fewer deviations are
    /// returned.
    ///
    /// # Errors
    ///
    /// Invalid parameters of the agents' search.
    pub fn simulate(
        &self,
        hypothesis: &Hypothesis,
        resync_interval: Option<usize>,
        limit: f64,
    ) -> Result<Deviations, PomcpError> {
        let rows = self.observed.rows();
        let agents = self.acting();
        let start = self.motion.states[0];
        let mut run = SimulationRun::new(&self.observed, hypothesis, agents, self.seed, start, None)?;
        let mut deviations = Deviations::with_capacity(self.observed.steps());
        let mut sum = 0.0;
        for (step, row) in rows.iter().enumerate().skip(1) {
            if resync_interval
                .is_some_and(|resync_interval| step > 1 && (step - 1) % resync_interval.max(1) == 0)
            {
                self.resynchronise(&mut run, step - 1);
            }
            let outlooks = AgentId::ALL.map(|agent| self.beliefs[agent].outlook(step - 1, run.state()));
            let (means, _) = run.step(&outlooks)?;
            let deviation = self.deviation(&means, row);
            deviations.push(deviation);
            sum += deviation;
            if sum > limit {
                break;
            }
        }
        Ok(deviations)
    }

    /// Sets a simulation to the state observed after a number of steps, and to the actions that led there.
    fn resynchronise(&self, run: &mut SimulationRun, step: usize) {
        let last_actions = step.checked_sub(1).and_then(|last| self.motion.actions.get(last));
        run.set_state(self.motion.states[step], last_actions);
    }

    /// ‖sᵗ − ŝᵗ‖₂ over the positions of all entities (u).
    fn deviation(&self, means: &[Vec2; MAX_ENTITIES], row: &[Body; MAX_ENTITIES]) -> f64 {
        let square = |entity: Entity| f64::from(means[entity].distance_squared(row[entity].position));
        libm::sqrt(self.observed.entities().map(square).sum())
    }

    /// Lets one agent decide under a hypothesis, while the other replays its inferred actions. Every
    /// `resync_interval` steps the simulation is resynchronised with the observed event. If that is every
    /// step, decisions are the policy at the observed states, and take as many searches as the minds'
    /// parameters say; otherwise the agent acts, and searches once.
    ///
    /// # Errors
    ///
    /// Invalid parameters of the agents' search.
    pub fn simulate_agent(
        &self,
        hypothesis: &Hypothesis,
        agent: AgentId,
        resync_interval: usize,
    ) -> Result<Vec<AgentDecision>, PomcpError> {
        let rows = self.observed.rows();
        let start = self.motion.states[0];
        let agents = if resync_interval > 1 { self.acting() } else { self.agents };
        let memo = Some(&self.memo);
        let mut run = SimulationRun::new(&self.observed, hypothesis, agents, self.seed, start, memo)?;
        let mut decided = Vec::with_capacity(self.observed.steps());
        for (step, (row, action_likelihoods)) in rows[1..].iter().zip(&self.motion.actions).enumerate() {
            if step > 0 && step % resync_interval.max(1) == 0 {
                self.resynchronise(&mut run, step);
            }
            self.lead(&mut run, agent, step)?;
            let outlook = self.beliefs[agent].outlook(step, run.state());
            let (action, thought) = run.decide(agent, &outlook)?;
            let mut actions = *action_likelihoods;
            actions[agent] = action;
            let means = run.act(actions);
            decided.push(AgentDecision { action, thought, deviation: self.deviation(&means, row) });
        }
        Ok(decided)
    }

    /// Lets one agent decide at some steps of the event under a hypothesis, with these parameters in place of
    /// the event's own, while the other replays its inferred actions. Steps that the event does not have are
    /// left out.
    ///
    /// Every decision starts from the observed state and the inferred last actions, and has a random stream
    /// of its own, so that it depends on no other: at any step, all hypotheses and parameters use the same
    /// random numbers. There are as many particles as the event was prepared with.
    ///
    /// # Errors
    ///
    /// Invalid parameters of the agents' search.
    pub fn decide_at(
        &self,
        hypothesis: &Hypothesis,
        agent: AgentId,
        minds: MindParameters,
        steps: &[usize],
    ) -> Result<Vec<AgentDecision>, PomcpError> {
        let rows = self.observed.rows();
        let agents = self.agents.with_minds(minds);
        let start = self.motion.states[0];
        let mut run = SimulationRun::new(&self.observed, hypothesis, agents, self.seed, start, None)?;
        let mut decided = Vec::with_capacity(steps.len());
        for &step in steps.iter().filter(|&&step| step < self.observed.steps()) {
            let (action, thought) = self.decide(&mut run, agent, step)?;
            let mut actions = self.motion.actions[step];
            actions[agent] = action;
            let means = run.act(actions);
            decided.push(AgentDecision {
                action,
                thought,
                deviation: self.deviation(&means, &rows[step + 1]),
            });
        }
        Ok(decided)
    }

    /// Minds that decide at observed states one by one, as those of [`PreparedEvent::decide_at`] with the
    /// event's own parameters. They share their searches with others of this event.
    pub(crate) fn run(&self, hypothesis: &Hypothesis) -> Result<SimulationRun, PomcpError> {
        let start = self.motion.states[0];
        let memo = Some(&self.memo);
        SimulationRun::new(&self.observed, hypothesis, self.agents, self.seed, start, memo)
    }

    /// Minds that decide as those of [`run`](Self::run), in a scene.
    pub(crate) fn run_in(&self, scene: &Scene) -> Result<SimulationRun, PomcpError> {
        SimulationRun::in_scene(scene, self.agents, self.seed, self.motion.states[0], None)
    }

    /// Lets an agent decide at a step, and nothing happen.
    pub(crate) fn decide(
        &self,
        run: &mut SimulationRun,
        agent: AgentId,
        step: usize,
    ) -> Result<(Action, Thought), PomcpError> {
        self.decide_believing(run, agent, step, &self.beliefs[agent])
    }

    /// Lets an agent decide as [`decide`](Self::decide) does, with other beliefs.
    pub(crate) fn decide_believing(
        &self,
        run: &mut SimulationRun,
        agent: AgentId,
        step: usize,
        beliefs: &EstimatedBeliefs,
    ) -> Result<(Action, Thought), PomcpError> {
        self.resynchronise(run, step);
        let seed = random::derive_seed(self.seed, Purpose::Search, step as u64);
        run.random = AgentId::ALL.map(|agent| random::stream(seed, Purpose::Search, agent.number().into()));
        self.lead(run, agent, step)?;
        let outlook = beliefs.outlook(step, run.state());
        run.decide(agent, &outlook)
    }

    /// The seed of its random streams.
    pub(crate) const fn seed(&self) -> u64 {
        self.seed
    }

    /// Lets the first agent decide where the second one's random numbers follow from its own.
    fn lead(&self, run: &mut SimulationRun, agent: AgentId, step: usize) -> Result<(), PomcpError> {
        if run.shares_random && agent == AgentId::ONE {
            let outlook = self.beliefs[AgentId::ZERO].outlook(step, run.state());
            run.decide(AgentId::ZERO, &outlook)?;
        }
        Ok(())
    }

    /// Continues for the given number of steps from the state after `start` observed steps: where every
    /// entity will be after each, if the hypothesis is true. Beliefs continue from those estimated, by what
    /// the agents observe in the simulation.
    ///
    /// # Errors
    ///
    /// Invalid parameters of the agents' search.
    ///
    /// # Panics
    ///
    /// If fewer steps than `start` were observed.
    pub fn predict(
        &self,
        hypothesis: &Hypothesis,
        start: usize,
        steps: usize,
        seed: u64,
    ) -> Result<phase_model::Forecast, PomcpError> {
        let state = self.motion.states[start];
        let mut run = SimulationRun::new(&self.observed, hypothesis, self.acting(), seed, state, None)?;
        self.resynchronise(&mut run, start);
        let mut beliefs = self.beliefs.each_ref().map(|belief| belief.after(start).boxed());
        let mut random: [Pcg64Mcg; AGENT_COUNT] =
            AgentId::ALL.map(|agent| random::stream(seed, Purpose::Belief, agent.number().into()));
        let mut forecast: phase_model::Forecast = self.observed.entities().map(|_| Vec::new()).collect();
        for _ in 0..steps {
            let outlooks = AgentId::ALL.map(|agent| {
                let observation = beliefs[agent].observe(run.state());
                Outlook {
                    particles: beliefs[agent].particles().to_vec(),
                    observed: observation.observed,
                    contest: beliefs[agent].contest(),
                    suppositions: Vec::new(),
                }
            });
            let (means, actions) = run.step(&outlooks)?;
            for (positions, mean) in forecast.iter_mut().zip(means) {
                positions.push(mean);
            }
            for (agent, belief) in AgentId::ALL.into_iter().zip(&mut beliefs) {
                let observation = belief.observe(run.state());
                belief.update(actions[agent], &observation, &run.substeps, &mut random[agent]);
            }
        }
        Ok(forecast)
    }
}

/// One simulated decision and the resulting deviation.
#[derive(Clone, Debug)]
pub struct AgentDecision {
    /// The action.
    pub action: Action,
    /// The explanation of the decision.
    pub thought: Thought,
    /// Distance of the simulated from an observed state (u); see `Deviations`.
    pub deviation: f64,
}

//! G(Y): what would have happened if a hypothesis were true.

use crate::{Hypothesis, beliefs::EstimatedBeliefs, reconstruction};
use phase_agent::{Mind, Outlook};
use phase_forward::{Forward, Memory};
use phase_model::{
    AGENT_COUNT, Action, Entity, ObservedEvent, Physique, State, Vec2,
    arena::SUBSTEPS,
    random::{self, Pcg64Mcg, Purpose},
};
use phase_perception::observe;
use phase_pomcp::PomcpError;

/// An observed event prepared for being explained: what all hypotheses share.
#[derive(Clone, Debug)]
pub struct Stage<'a> {
    observed: &'a ObservedEvent,
    states: Vec<State>,
    beliefs: [EstimatedBeliefs; AGENT_COUNT],
    minds: phase_agent::Settings,
    seed: u64,
}

/// How far the trajectories of a simulation lie from those observed, ‖sᵗ − ŝᵗ‖₂ over the positions of all entities,
/// for each step from 1 on (u).
pub type Deviations = Vec<f64>;

impl<'a> Stage<'a> {
    /// Estimates who held what and who believed what in an event. All hypotheses draw the same random numbers,
    /// so that they differ in nothing but what they say.
    #[must_use]
    pub fn new(observed: &'a ObservedEvent, minds: phase_agent::Settings, seed: u64) -> Self {
        let states = reconstruction::states(observed);
        let beliefs = core::array::from_fn(|agent| {
            EstimatedBeliefs::new(observed, &states, agent, minds.particles, seed)
        });
        Self { observed, states, beliefs, minds, seed }
    }

    /// The event.
    #[must_use]
    pub const fn observed(&self) -> &ObservedEvent {
        self.observed
    }

    /// The states between the steps, as far as rows tell them.
    #[must_use]
    pub fn states(&self) -> &[State] {
        &self.states
    }

    /// Simulates the event under a hypothesis and returns how far it deviates. Every `anchor` steps the simulation
    /// is put back to where the observed event is; without an anchor it goes its own way from the start, as in the
    /// paper. It breaks off once the deviations add up to more than `limit`; then they are as many as there are.
    ///
    /// # Errors
    /// Settings of minds that cannot be searched with.
    pub fn simulate(
        &self,
        hypothesis: &Hypothesis,
        anchor: Option<usize>,
        limit: f64,
    ) -> Result<Deviations, PomcpError> {
        let rows = self.observed.rows();
        let mut run = Run::new(self.observed, hypothesis, self.minds, self.seed, self.states[0])?;
        let mut deviations = Deviations::with_capacity(self.observed.steps());
        let mut sum = 0.0;
        for (step, row) in rows.iter().enumerate().skip(1) {
            if anchor.is_some_and(|anchor| step > 1 && (step - 1) % anchor.max(1) == 0) {
                run.put(self.states[step - 1]);
            }
            let outlooks = core::array::from_fn(|agent| {
                self.beliefs[agent].outlook(&run.physique, step - 1, &run.state)
            });
            let (means, _) = run.step(&outlooks)?;
            let square = |entity: Entity| {
                f64::from(means[entity.index()].distance_squared(row[entity.index()].position))
            };
            let deviation = libm::sqrt(self.observed.entities().map(square).sum());
            deviations.push(deviation);
            sum += deviation;
            if sum > limit {
                break;
            }
        }
        Ok(deviations)
    }

    /// Goes on from the last state watched for so many steps: where every entity will be after each, if the
    /// hypothesis is true. Beliefs go on from those estimated, by what the agents observe in the simulation.
    ///
    /// # Errors
    /// Settings of minds that cannot be searched with.
    pub fn go_on(
        &self,
        hypothesis: &Hypothesis,
        steps: usize,
        seed: u64,
    ) -> Result<phase_model::Forecast, PomcpError> {
        let last = self.states[self.states.len() - 1];
        let mut run = Run::new(self.observed, hypothesis, self.minds, seed, last)?;
        let mut beliefs = self.beliefs.each_ref().map(|belief| belief.last().clone());
        let mut random: [Pcg64Mcg; AGENT_COUNT] =
            core::array::from_fn(|agent| random::stream(seed, Purpose::Belief, agent as u64));
        let mut forecast: phase_model::Forecast = self.observed.entities().map(|_| Vec::new()).collect();
        for _ in 0..steps {
            let outlooks = core::array::from_fn(|agent| {
                let observation = observe(&run.physique, &run.state, agent);
                (beliefs[agent].particles().to_vec(), observation.observed)
            });
            let (means, actions) = run.step(&outlooks)?;
            for (positions, mean) in forecast.iter_mut().zip(means) {
                positions.push(mean);
            }
            for (agent, belief) in beliefs.iter_mut().enumerate() {
                let observation = observe(&run.physique, &run.state, agent);
                let (forward, physique) = (&run.forward, &run.physique);
                belief.update(forward, physique, actions[agent], &observation, &mut random[agent]);
            }
        }
        Ok(forecast)
    }
}

/// A simulation under way.
struct Run {
    physique: Physique,
    forward: Forward,
    minds: [Mind<Forward>; AGENT_COUNT],
    random: [Pcg64Mcg; AGENT_COUNT],
    state: State,
    memory: Memory,
}

/// What an agent believes possible, and the entities that it observes.
type Outlooks = [(Vec<State>, phase_model::EntitySet); AGENT_COUNT];

impl Run {
    fn new(
        observed: &ObservedEvent,
        hypothesis: &Hypothesis,
        settings: phase_agent::Settings,
        seed: u64,
        state: State,
    ) -> Result<Self, PomcpError> {
        let scene = hypothesis.scene(observed);
        let physique = scene.physique();
        let forward = Forward::new(&physique);
        let mind = |agent| Mind::new(&scene, agent, Forward::new(&physique), settings);
        let minds = [mind(0)?, mind(1)?];
        let random = core::array::from_fn(|agent| random::stream(seed, Purpose::Search, agent as u64));
        let memory = forward.remember(&state);
        Ok(Self { physique, forward, minds, random, state, memory })
    }

    /// Puts the world into a state.
    fn put(&mut self, state: State) {
        self.state = state;
        self.memory = self.forward.remember(&state);
    }

    /// Both decide and act: the mean positions of all bodies over the step, and what they did.
    fn step(
        &mut self,
        outlooks: &Outlooks,
    ) -> Result<([Vec2; phase_model::MAX_ENTITIES], [Action; AGENT_COUNT]), PomcpError> {
        let mut actions = [Action::NoForce; AGENT_COUNT];
        for (agent, (particles, observed)) in outlooks.iter().enumerate() {
            let outlook = Outlook { particles, observed: *observed };
            let (action, _) = self.minds[agent].decide(outlook, &mut self.random[agent])?;
            actions[agent] = action;
        }
        let substeps = self.forward.step_warm(&mut self.state, &mut self.memory, actions);
        let mean = |entity: usize| {
            let sum = substeps.iter().fold(Vec2::ZERO, |sum, substep| sum + substep.bodies[entity].position);
            sum / SUBSTEPS as f32
        };
        Ok((core::array::from_fn(mean), actions))
    }
}

//! A scene that is played from outside, as environments of reinforcement learning are.

use crate::{Engine, Environment, vector::VectorWriter};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Attitude, BodySet, Goal, PhysicsConfig, Scene, State, arena::SUBSTEPS,
    reward::social_reward,
};
use phase_perception::{Cell, CellSet, Observation, observe};
use phase_predicates::achieved;

/// The share of the state that an agent is shown.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum View {
    /// The agent's own field of view and touch, as minds have them.
    #[default]
    Own,
    /// All cells and all entities.
    Everything,
}

/// A scene in which the caller chooses both agents' actions, step by step.
///
/// It has the true dynamics, what either agent observes, and the rewards of Equation 1. It never ends: the
/// caller decides for how long it goes on. A copy saves everything, contact impulses and grips included: it
/// goes on as the original, bit for bit.
///
/// ```
/// use phase_model::{Action, AgentId};
/// use phase_sim::{Engine, Episode, View, vector};
///
/// let scene = phase_sampler::sample_named(Some("chasing"), None, 1)?;
/// let mut episode = Episode::new(&scene, Engine::World);
/// let actions = [Action::Up, Action::Left];
/// episode.step(actions);
/// let mut numbers = [0.0; vector::SIZE];
/// episode.write_observation(AgentId::ZERO, View::Own, &mut numbers);
/// assert_eq!(vector::read(AgentId::ZERO, &numbers)?, episode.observe(AgentId::ZERO, View::Own));
/// // Pushing sideways costs 0.02.
/// assert_eq!(episode.rewards(actions)[0] - episode.rewards([Action::Stop; 2])[0], 0.0);
/// assert!(episode.rewards(actions)[1] < episode.rewards([Action::Stop; 2])[1]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Episode {
    environment: Environment,
    physics: PhysicsConfig,
    goals: [Goal; AGENT_COUNT],
    attitudes: [Attitude; AGENT_COUNT],
    writer: VectorWriter,
    /// The state before the last step; the initial state before the first one.
    before: State,
    /// The states after each substep of the last step; the initial state before the first one.
    substeps: [State; SUBSTEPS],
}

impl Episode {
    /// The scene at its start, simulated by an engine.
    #[must_use]
    pub fn new(scene: &Scene, engine: Engine) -> Self {
        let physics = scene.physics();
        let state = scene.initial_state();
        Self {
            environment: Environment::new(engine, &physics, &state),
            writer: VectorWriter::new(scene),
            goals: scene.goals(),
            attitudes: scene.attitudes(),
            before: state,
            substeps: [state; SUBSTEPS],
            physics,
        }
    }

    /// Lets both agents act for one step, the first action being that of agent 0.
    pub fn step(&mut self, actions: [Action; AGENT_COUNT]) {
        self.before = *self.state();
        self.substeps = self.environment.step(actions);
    }

    /// Bodies and walls of the scene.
    #[must_use]
    pub const fn physics(&self) -> &PhysicsConfig {
        &self.physics
    }

    /// The true state after the last step, or the initial state.
    #[must_use]
    pub const fn state(&self) -> &State {
        &self.substeps[SUBSTEPS - 1]
    }

    /// The true state before the last step; the initial state before the first one.
    #[must_use]
    pub const fn before(&self) -> &State {
        &self.before
    }

    /// The true states after each substep of the last step; before the first step, the initial state five
    /// times.
    #[must_use]
    pub const fn substeps(&self) -> &[State; SUBSTEPS] {
        &self.substeps
    }

    /// The observation of an agent after the last step.
    #[must_use]
    pub fn observe(&self, agent: AgentId, view: View) -> Observation {
        match view {
            View::Own => observe(&self.physics, self.state(), agent),
            View::Everything => {
                let entities: BodySet = self.physics.entities().collect();
                let mut cells = CellSet::EMPTY;
                Cell::all().for_each(|cell| cells.insert(cell));
                Observation::of(&self.physics, self.state(), agent, cells, entities)
            }
        }
    }

    /// Writes the observation of an agent as [a vector](crate::vector) of [`SIZE`](crate::vector::SIZE)
    /// numbers.
    ///
    /// # Panics
    /// If the slice has another length.
    pub fn write_observation(&self, agent: AgentId, view: View, out: &mut [f32]) {
        self.writer.write(&self.observe(agent, view), out);
    }

    /// Whether each agent's goal holds in the true state.
    #[must_use]
    pub fn achieved(&self) -> [bool; AGENT_COUNT] {
        self.goals.map(|goal| achieved(&self.physics, self.state(), goal))
    }

    /// The reward of each agent in the true state after these actions, by Equation 1 of the paper:
    /// (1 − |α|) R(s, own goal) + α R(s, other's goal) + C(a).
    ///
    /// R is 1 while the goal holds, otherwise 0, and C(a) is −0.02 for the seven pushes that are not forward.
    /// A reward is from −1.02 to 1.
    #[must_use]
    pub fn rewards(&self, actions: [Action; AGENT_COUNT]) -> [f64; AGENT_COUNT] {
        let satisfied = self.achieved().map(|achieved| f64::from(u8::from(achieved)));
        AgentId::ALL.map(|agent| {
            let own = satisfied[usize::from(agent)];
            let other = satisfied[usize::from(agent.other())];
            social_reward(self.attitudes[agent], own, other, actions[usize::from(agent)])
        })
    }
}

//! One simulation of an event under a hypothesis, while it runs.

use crate::{Hypothesis, ImaginedAgents};
use phase_event::{ObservedEvent, Thought};
use phase_forward::{ForwardWorld, OriginalWorld};
use phase_minds::{BeliefView, Contest, Mind, Recorder, SearchMemo, Supposition, mind, mind_sharing};
use phase_model::{
    AGENT_COUNT, Action, AgentBody, AgentId, BodySet, Layout, MAX_ENTITIES, PhysicsConfig, Scene, State,
    Vec2,
    arena::SUBSTEPS,
    random::{self, Pcg64Mcg, Purpose},
};
use phase_pomcp::PomcpError;

/// A simulation under way.
#[derive(Debug)]
pub(crate) struct SimulationRun {
    layout: Layout,
    recorder: Recorder,
    bodies: [AgentBody; AGENT_COUNT],
    /// Whether both minds draw from one stream of random numbers, as in the original.
    pub(crate) shares_random: bool,
    world: ImaginedWorld,
    minds: [Box<dyn Mind>; AGENT_COUNT],
    pub(crate) random: [Pcg64Mcg; AGENT_COUNT],
    /// The states after the substeps of the last step.
    pub(crate) substeps: [State; SUBSTEPS],
    last_actions: [Option<Action>; AGENT_COUNT],
    /// The position at which the first agent's decision has left the original's random numbers, until the
    /// second decides.
    led_to: Option<u64>,
}

/// The world that an inference imagines. The original's random numbers repeat what was recorded only in the
/// original's world.
#[derive(Debug)]
enum ImaginedWorld {
    Forward(Box<ForwardWorld>),
    Original(Box<PhysicsConfig>, Box<OriginalWorld>),
}

impl ImaginedWorld {
    fn new(is_original: bool, physics: PhysicsConfig, state: &State) -> Self {
        if is_original {
            let world = OriginalWorld::new(&physics, state);
            Self::Original(Box::new(physics), Box::new(world))
        } else {
            Self::Forward(Box::new(ForwardWorld::new(&physics, state)))
        }
    }

    const fn state(&self) -> &State {
        match self {
            Self::Forward(world) => world.state(),
            Self::Original(_, world) => world.state(),
        }
    }

    fn set_state(&mut self, state: &State) {
        match self {
            Self::Forward(world) => world.set_state(state),
            Self::Original(physics, world) => **world = OriginalWorld::new(physics, state),
        }
    }

    fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        match self {
            Self::Forward(world) => world.step(actions),
            Self::Original(_, world) => world.step(actions),
        }
    }
}

/// The states that each agent believes possible, and the entities that it observes.
pub(crate) type Outlooks = [Outlook; AGENT_COUNT];

/// The belief and the observation that an agent decides by.
pub(crate) struct Outlook {
    pub(crate) particles: Vec<State>,
    pub(crate) observed: BodySet,
    pub(crate) contest: Contest,
    /// The supposition of each particle about the other; empty if the agent knows the other's goal.
    pub(crate) suppositions: Vec<Supposition>,
}

impl SimulationRun {
    pub(crate) fn new(
        observed: &ObservedEvent,
        hypothesis: &Hypothesis,
        agents: ImaginedAgents,
        seed: u64,
        state: State,
        memo: Option<&SearchMemo>,
    ) -> Result<Self, PomcpError> {
        Self::in_scene(&hypothesis.scene(observed), agents, seed, state, memo)
    }

    /// A simulation of a scene.
    pub(crate) fn in_scene(
        scene: &Scene,
        agents: ImaginedAgents,
        seed: u64,
        state: State,
        memo: Option<&SearchMemo>,
    ) -> Result<Self, PomcpError> {
        let physics = scene.physics();
        let shares_random = agents.minds.has_original_random();
        let world = ImaginedWorld::new(shares_random, physics.clone(), &state);
        let mind = |agent| match memo {
            Some(memo) => mind_sharing(scene, agent, &agents.minds, memo),
            None => mind(scene, agent, &agents.minds),
        };
        let minds = [mind(AgentId::ZERO)?, mind(AgentId::ONE)?];
        let random = AgentId::ALL.map(|agent| random::stream(seed, Purpose::Search, agent.number().into()));
        let layout = scene.layout;
        let last_actions = [None; AGENT_COUNT];
        let recorder = agents.recorder();
        let substeps = [state; SUBSTEPS];
        let bodies = physics.agents;
        Ok(Self {
            layout,
            recorder,
            bodies,
            shares_random,
            world,
            minds,
            random,
            substeps,
            last_actions,
            led_to: None,
        })
    }

    /// Sets the world to a state that both agents' actions have led to, if they have acted.
    pub(crate) fn set_state(&mut self, state: State, last_actions: Option<&[Action; AGENT_COUNT]>) {
        self.last_actions = last_actions.map_or([None; AGENT_COUNT], |actions| actions.map(Some));
        self.world.set_state(&state);
    }

    /// The state of the world.
    pub(crate) const fn state(&self) -> &State {
        self.world.state()
    }

    /// Tells an agent's mind for how many steps it has watched, less those in which it has acted since.
    pub(crate) fn has_watched(&mut self, agent: AgentId, steps: u32) {
        self.minds[agent].has_watched(steps);
    }

    /// Both decide and act: the mean positions of all bodies over the step, and their actions.
    pub(crate) fn step(
        &mut self,
        outlooks: &Outlooks,
    ) -> Result<([Vec2; MAX_ENTITIES], [Action; AGENT_COUNT]), PomcpError> {
        let mut actions = [Action::NoForce; AGENT_COUNT];
        for (agent, outlook) in AgentId::ALL.into_iter().zip(outlooks) {
            (actions[agent], _) = self.decide(agent, outlook)?;
        }
        Ok((self.act(actions), actions))
    }

    /// One agent decides: what it does, and why.
    pub(crate) fn decide(
        &mut self,
        agent: AgentId,
        outlook: &Outlook,
    ) -> Result<(Action, Thought), PomcpError> {
        let belief_view = BeliefView {
            particles: &outlook.particles,
            observed: outlook.observed,
            last_action: self.last_actions[agent],
            suppositions: &outlook.suppositions,
            contest: outlook.contest,
        };
        // The original's random numbers go on from the first agent's search to the second's.
        if let (AgentId::ONE, Some(position)) = (agent, self.led_to.take()) {
            self.minds[agent].begin_at(position);
        }
        let (action, thought) = self.minds[agent].decide(belief_view, &mut self.random[agent])?;
        if agent == AgentId::ZERO {
            self.led_to = Some(self.minds[agent].stream_position());
        }
        Ok((self.recorder.carried_out(action, &self.bodies[agent], self.layout), thought))
    }

    /// Both act: the mean positions of all bodies over the step.
    pub(crate) fn act(&mut self, actions: [Action; AGENT_COUNT]) -> [Vec2; MAX_ENTITIES] {
        self.last_actions = actions.map(Some);
        self.substeps = self.world.step(actions);
        let substeps = &self.substeps;
        let mean = |entity: usize| {
            let sum = substeps.iter().fold(Vec2::ZERO, |sum, substep| sum + substep.bodies[entity].position);
            sum / SUBSTEPS as f32
        };
        core::array::from_fn(mean)
    }
}

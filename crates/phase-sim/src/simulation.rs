//! Algorithm 1 of the paper: both agents observe, update their beliefs, plan and act simultaneously.

use crate::{
    SimulationSettings,
    environment::Environment,
    error::SimulationError,
    minds::{Given, Minds},
};
use core::ops::ControlFlow;
use phase_event::{Event, Step};
use phase_minds::MindKind;
use phase_model::{AGENT_COUNT, AgentId, Awareness, PhysicsConfig, Scene, State, Subgoal, arena::SUBSTEPS};
use phase_predicates::threshold::SEEN_MOTION;

/// Speed below which a body counts as being at rest (u/s).
const REST_SPEED: f32 = 0.05;

/// Simulates a scene from its start to its end (Algorithm 1 of the paper).
///
/// In every step of 0.25 s both agents decide in one and the same state, from what they have observed; then
/// both actions are carried out. The event ends after [`SimulationSettings::max_steps`], or earlier once
/// nothing has happened for as long as the settings say. Equal scenes, seeds and settings give equal events,
/// bit for bit, on every machine and with any number of threads.
///
/// [`simulate_with`] can end an event early, and [`Simulation`] goes step by step, with actions from outside.
///
/// # Errors
/// [`SimulationError`], if the scene or a setting is invalid.
///
/// # Examples
/// An agent, 5.5 u from its landmark, gets there, and another that wants to stay stays:
///
/// ```
/// use phase_minds::MindParameters;
/// use phase_model::{Entity, AgentId, LandmarkId, Scene, arena};
/// use phase_sim::{SimulationSettings, simulate};
///
/// let scene = Scene::from_json(
///     r#"{"layout": {"base": 0}, "objects": [], "event": "independent", "agents": [
///         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 23.5, "y": 14, "angle": 0},
///          "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 1, "sign": 1}},
///         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 8.5, "y": 19.5, "angle": 0},
///          "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 0, "sign": 1}}]}"#,
/// )?;
/// let minds = MindParameters::default().with_particles(5).with_simulations(50);
/// let settings = SimulationSettings { max_steps: 20, minds, ..SimulationSettings::default() };
/// let event = simulate(&scene, 1, &settings)?;
/// let last = event.steps[19].substeps[4];
/// for (agent, landmark) in [(AgentId::ZERO, LandmarkId::TOP_RIGHT), (AgentId::ONE, LandmarkId::TOP_LEFT)] {
///     assert!(last.position(Entity::Agent(agent)).distance(arena::LANDMARKS[landmark]) < 1.5);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn simulate(scene: &Scene, seed: u64, settings: &SimulationSettings) -> Result<Event, SimulationError> {
    let (event, _) = simulate_with(scene, seed, settings, &mut |_| ControlFlow::Continue(()))?;
    Ok(event)
}

/// Simulates a scene as [`simulate`] does, and calls `on_step` with every step as soon as it is computed.
///
/// When `on_step` breaks, the event ends early: it has the steps up to that one. The returned flag says
/// whether the event came to its own end. Progress bars and interruption are built on this; a callback cannot
/// change what happens.
///
/// # Errors
/// [`SimulationError`], if the scene or a setting is invalid.
pub fn simulate_with(
    scene: &Scene,
    seed: u64,
    settings: &SimulationSettings,
    on_step: &mut dyn FnMut(&Step) -> ControlFlow<()>,
) -> Result<(Event, bool), SimulationError> {
    let mut simulation = Simulation::new(scene, seed, settings)?;
    while !simulation.is_over() {
        if on_step(simulation.step(Given::default())?).is_break() {
            return Ok((simulation.into_event(), false));
        }
    }
    Ok((simulation.into_event(), true))
}

/// A scene that is simulated step by step.
///
/// It is for programs in which something else than minds decides, such as a game, an environment for learning
/// or a page in a browser: [`step`](Self::step) takes an action for either agent, or lets its mind decide.
/// Without given actions the event is that of [`simulate`], bit for bit. A copy goes on as the original does;
/// a [`branch`](Self::branch) goes on with other random numbers.
#[derive(Clone, Debug)]
pub struct Simulation {
    settings: SimulationSettings,
    physics: PhysicsConfig,
    world: Environment,
    minds: Minds,
    state: State,
    event: Event,
    /// Steps in a row in which nobody had anything to do and nothing moved.
    resting: usize,
    /// Steps in a row in which nothing was seen to move.
    still: usize,
    over: bool,
    /// Whether both agents know what came of the last step.
    perceived: bool,
}

impl Simulation {
    /// The scene at its start, in which both agents have minds.
    ///
    /// # Errors
    /// [`SimulationError`], if the scene or a setting is invalid.
    pub fn new(scene: &Scene, seed: u64, settings: &SimulationSettings) -> Result<Self, SimulationError> {
        Self::with_minds(scene, seed, settings, [true; AGENT_COUNT])
    }

    /// The scene at its start, in which only some agents have minds. An agent without one believes nothing,
    /// and stops in a step in which no action is given to it.
    ///
    /// # Errors
    /// [`SimulationError`], if the scene or a setting is invalid.
    pub fn with_minds(
        scene: &Scene,
        seed: u64,
        settings: &SimulationSettings,
        minds: [bool; AGENT_COUNT],
    ) -> Result<Self, SimulationError> {
        scene.validate()?;
        settings.validate()?;
        let aware = |agent: &AgentId| scene.agents[*agent].awareness != Awareness::default();
        if let (MindKind::Published, Some(agent)) =
            (settings.minds.kind(), AgentId::ALL.into_iter().find(aware))
        {
            return Err(SimulationError::Awareness(agent));
        }
        let physics = scene.physics();
        let initial = scene.initial_state();
        Ok(Self {
            settings: *settings,
            world: Environment::new(settings.engine, &physics, &initial),
            minds: Minds::new(scene, &initial, seed, settings, minds)?,
            state: initial,
            event: Event { scene: scene.clone(), seed, initial, steps: Vec::new() },
            resting: 0,
            still: 0,
            over: false,
            perceived: true,
            physics,
        })
    }

    /// Simulates one step of 0.25 s, also of an event that is over. An agent to which an action is given
    /// carries that out; its mind perceives all the same and does not decide, and its thought is
    /// [`Thought::IDLE`](phase_event::Thought::IDLE).
    ///
    /// # Errors
    /// [`SimulationError::Search`], if a search fails.
    pub fn step(&mut self, given: Given) -> Result<&Step, SimulationError> {
        self.perceive();
        let (actions, thoughts) = self.minds.decide(given)?;
        let idle = thoughts.iter().all(|thought| thought.subgoal == Subgoal::Stay);
        let before = self.state;
        let settings = &self.settings;
        let layout = self.event.scene.layout;
        let recorder = settings.recorder();
        let carried_out = AgentId::ALL
            .map(|agent| recorder.carried_out(actions[agent], &self.physics.agents[agent], layout));
        let mut substeps = self.world.step(carried_out);
        if settings.stop_between_steps {
            substeps[SUBSTEPS - 1] = self.world.stop_agents();
        }
        self.state = substeps[SUBSTEPS - 1];
        // An agent that waits has not given up.
        let waits = self.minds.waits != [0; AGENT_COUNT];
        let rests = !waits && idle && is_at_rest(&self.physics, &self.state);
        let stays = !waits && is_unmoved(&self.physics, &before, &self.state);
        self.resting = if rests { self.resting + 1 } else { 0 };
        self.still = if stays { self.still + 1 } else { 0 };
        let steps = self.event.steps.len() + 1;
        let ended = self.resting >= settings.rest_steps || self.still >= settings.still_steps;
        self.over = (ended && steps >= settings.min_steps) || steps >= settings.max_steps;
        debug_assert!(self.state.is_finite(&self.physics));
        self.event.steps.push(Step { actions, thoughts, substeps });
        self.perceived = false;
        if !self.over {
            self.perceive();
        }
        Ok(&self.event.steps[steps - 1])
    }

    /// Decides for an agent before the step is due, because a decision takes most of the time of a step. The
    /// next [`step`](Self::step) in which that agent is not given an action carries the decision out; it is
    /// the one that the step itself would have made.
    ///
    /// # Errors
    /// [`SimulationError::Search`], if the search fails.
    pub fn decide_ahead(&mut self, agent: AgentId) -> Result<(), SimulationError> {
        self.perceive();
        self.minds.decide_ahead(agent)
    }

    /// Tells both agents what came of the last step; of an event's last step nobody has to know.
    fn perceive(&mut self) {
        if let (false, Some(last)) = (self.perceived, self.event.steps.last()) {
            self.minds.perceive(&last.substeps, last.actions);
            self.perceived = true;
        }
    }

    /// A copy with the same past, in which both agents believe the same, and with the random numbers of
    /// `seed` from here on. Decisions that were made ahead are made again. With the original's random numbers
    /// ([`phase_minds::MindParameters`] of published minds), which no seed changes, beliefs alone part.
    ///
    /// # Examples
    /// Two futures of one moment:
    ///
    /// ```
    /// use phase_minds::MindParameters;
    /// use phase_model::Scene;
    /// use phase_sim::{Simulation, SimulationSettings};
    ///
    /// let scene = Scene::from_json(
    ///     r#"{"layout": {"base": 0}, "objects": [], "event": "independent", "agents": [
    ///         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 23.5, "y": 14, "angle": 0},
    ///          "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 1, "sign": 1}},
    ///         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 8.5, "y": 19.5, "angle": 0},
    ///          "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 0, "sign": 1}}]}"#,
    /// )?;
    /// let minds = MindParameters::default().with_particles(5).with_simulations(50);
    /// let settings = SimulationSettings { max_steps: 20, minds, ..SimulationSettings::default() };
    /// let mut simulation = Simulation::new(&scene, 1, &settings)?;
    /// for _ in 0..4 {
    ///     simulation.step([None, None])?;
    /// }
    /// let mut other = simulation.branch(2);
    /// assert_eq!(other.state(), simulation.state());
    /// simulation.step([None, None])?;
    /// other.step([None, None])?;
    /// assert_eq!(other.event().steps.len(), simulation.event().steps.len());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn branch(&self, seed: u64) -> Self {
        let mut branch = self.clone();
        branch.minds.reseed(seed);
        branch
    }

    /// Whether the event has come to its end: nothing happens any more, or it has as many steps as the
    /// settings allow.
    #[must_use]
    pub const fn is_over(&self) -> bool {
        self.over
    }

    /// The world as it is.
    #[must_use]
    pub const fn state(&self) -> &State {
        &self.state
    }

    /// The particles of an agent's belief: possible states of the world, all equally likely; none for an
    /// agent without a mind.
    #[must_use]
    pub fn particles(&self, agent: AgentId) -> &[State] {
        self.minds.agents[agent].as_ref().map_or(&[], |mind| mind.belief().particles())
    }

    /// The event up to now.
    #[must_use]
    pub const fn event(&self) -> &Event {
        &self.event
    }

    /// The event up to now; the simulation ends.
    #[must_use]
    pub fn into_event(self) -> Event {
        self.event
    }
}

/// Whether a viewer would judge that nothing has moved in a step.
fn is_unmoved(physics: &PhysicsConfig, before: &State, after: &State) -> bool {
    physics.entities().all(|entity| {
        let before = before.body(entity);
        let after = after.body(entity);
        before.position.distance(after.position) < SEEN_MOTION
            && (before.angle - after.angle).abs() < SEEN_MOTION
    })
}

fn is_at_rest(physics: &PhysicsConfig, state: &State) -> bool {
    physics.entities().all(|entity| state.body(entity).velocity.length() < REST_SPEED)
}

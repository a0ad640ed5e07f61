//! One interface to all minds: observations go in; actions, beliefs and reasons come out.
//!
//! Everything that simulates or infers uses [`Agent`], or its two halves, which inference needs one by one: a
//! [`BeliefState`], which depends on observations alone and is shared by all hypotheses about goals, and a
//! [`Mind`], which decides for a given belief. [`belief()`] and [`mind()`] make those of the kind that the
//! parameters name ([`MindKind`]): our own, `phase-agent`, or the published simulator's, `phase-published`.
//!
//! Key design decision: a mind brings its own senses ([`BeliefState::observe`]), because the two kinds differ
//! in what they see and feel. The trade-off is that the caller must hand them the true state; nothing
//! but the observation is kept of it. Minds are chosen at run time, so they are trait objects, and
//! all random draws come from one kind of generator.
//!
//! A mind of either kind that sees its landmark ahead walks there:
//!
//! ```
//! use phase_minds::{Agent, MindKind, MindParameters, observe};
//! use phase_model::{Action, AgentId, Scene, random::{Purpose, stream}};
//!
//! let scene = Scene::from_json(
//!     r#"{"layout": {"base": 0}, "objects": [], "event": "independent", "agents": [
//!         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 23.5, "y": 14, "angle": 0},
//!          "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 1, "sign": 1}},
//!         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 8.5, "y": 14, "angle": 0},
//!          "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 0, "sign": 1}}]}"#,
//! )?;
//! for kind in MindKind::ALL {
//!     let parameters = MindParameters::of(kind).with_particles(5).with_simulations(100);
//!     let observation = observe(kind, &scene.physics(), &scene.initial_state(), AgentId::ZERO);
//!     let mut random = stream(1, Purpose::Search, 0);
//!     let start = scene.initial_state();
//!     let mut agent = Agent::new(&scene, &parameters, &observation, Some(&start), &mut random)?;
//!     let (action, thought) = agent.decide(&mut random)?;
//!     assert_eq!(action, Action::Up, "{}", kind.name());
//!     assert_eq!(thought.subgoal.to_string(), "On(agent 0, landmark 1)");
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod agent;
mod parameters;
mod phase;
mod published;
mod ranges;
mod searching;
mod turns;

pub use agent::Agent;
pub use parameters::{MindKind, MindParameters, ParametersError};
pub use phase_agent::{BeliefView, Contest, Foresight, PhaseParameters, Prior, Supposition};
pub use phase_published::{PublishedParameters, RandomNumbers, SearchMemo};
pub use ranges::{PARTICLES, SIMULATIONS};
pub use turns::Recorder;

use phase_event::Thought;
use phase_model::{Action, AgentId, Layout, PhysicsConfig, Scene, Sight, State, random::Pcg64Mcg};
use phase_perception::Observation;
use phase_pomcp::PomcpError;

/// The half of an agent that decides, for a given belief.
pub trait Mind: core::fmt::Debug + Send {
    /// Chooses the next action on a belief; returns it with its explanation.
    ///
    /// # Errors
    /// [`PomcpError`], if the search fails.
    fn decide(
        &mut self,
        belief: BeliefView<'_>,
        random: &mut Pcg64Mcg,
    ) -> Result<(Action, Thought), PomcpError>;

    /// The position at which the last decision has left the original's stream of random numbers; 0 for minds
    /// with others.
    fn stream_position(&self) -> u64 {
        0
    }

    /// Lets the next decision begin at a position of the original's stream: that at which the first agent's
    /// decision has left it, if this is the second agent. Minds with other random numbers ignore it.
    fn begin_at(&mut self, _position: u64) {}

    /// Goes through a decision that was made before, without its search, so that the next one is as after
    /// [`decide`](Self::decide). Minds that keep nothing from one decision to the next ignore it.
    fn relive(&mut self, _belief: BeliefView<'_>) {}

    /// Sets the steps that an agent that does not know the other's goal has watched, less those in which it
    /// has acted since, where its own decisions have not made them. Other minds ignore it.
    fn has_watched(&mut self, _steps: u32) {}

    /// A copy of this mind, which decides as this one.
    fn boxed(&self) -> Box<dyn Mind>;
}

impl Clone for Box<dyn Mind> {
    fn clone(&self) -> Self {
        (**self).boxed()
    }
}

/// The half of an agent that perceives and believes. It depends on observations, own actions and its random
/// stream alone, but for what [`update`](Self::update) says of published minds.
pub trait BeliefState: core::fmt::Debug + Send + Sync {
    /// The observation that the agent makes of a state of the world.
    fn observe(&self, state: &State) -> Observation;

    /// Updates the belief with the observation after an action.
    ///
    /// `substeps` are the true states after the substeps, the last of which is observed, or none where nobody
    /// knows them. Only published minds look at them: what comes into view within the step counts as seen,
    /// and an unseen body that is believed near its true place is left there, as in the original.
    fn update(
        &mut self,
        action: Action,
        observation: &Observation,
        substeps: &[State],
        random: &mut Pcg64Mcg,
    );

    /// Possible states of the world, all equally likely.
    fn particles(&self) -> &[State];

    /// For each particle what it supposes of the other agent's mind; empty if the agent knows its goal.
    fn suppositions(&self) -> &[Supposition] {
        &[]
    }

    /// The agent's memory of a contest for an object; published minds have none.
    fn contest(&self) -> Contest {
        Contest::default()
    }

    /// A copy of this belief.
    fn boxed(&self) -> Box<dyn BeliefState>;
}

impl Clone for Box<dyn BeliefState> {
    fn clone(&self) -> Self {
        (**self).boxed()
    }
}

/// The mind of an agent of a scene.
///
/// # Errors
/// [`PomcpError`] for parameters that [`MindParameters::validate`] refuses and a search cannot have.
pub fn mind(scene: &Scene, agent: AgentId, parameters: &MindParameters) -> Result<Box<dyn Mind>, PomcpError> {
    match parameters {
        MindParameters::Phase(parameters) => phase::mind(scene, agent, *parameters),
        MindParameters::Published(parameters) => published::mind(scene, agent, *parameters, None),
    }
}

/// The mind of an agent of a scene, which looks up searches that other minds with this memo have done. It
/// decides as it would without; only published minds search for what other intents would search for, too.
///
/// # Errors
/// [`PomcpError`] for parameters that [`MindParameters::validate`] refuses and a search cannot have.
pub fn mind_sharing(
    scene: &Scene,
    agent: AgentId,
    parameters: &MindParameters,
    memo: &SearchMemo,
) -> Result<Box<dyn Mind>, PomcpError> {
    match parameters {
        MindParameters::Phase(parameters) => phase::mind(scene, agent, *parameters),
        MindParameters::Published(parameters) => published::mind(scene, agent, *parameters, Some(memo)),
    }
}

/// The observation that an agent with a mind of some kind makes of a state of the world.
#[must_use]
pub fn observe(kind: MindKind, physics: &PhysicsConfig, state: &State, agent: AgentId) -> Observation {
    match kind {
        MindKind::Phase => phase::observe(physics, state, agent, Sight::Own),
        MindKind::Published => phase_published::senses::observe(physics, state, agent),
    }
}

/// The first observation of an agent of a scene, in a state of the world: it is told of objects if the scene
/// says so and its mind is of our own kind.
#[must_use]
pub fn first_observation(scene: &Scene, kind: MindKind, state: &State, agent: AgentId) -> Observation {
    match kind {
        MindKind::Phase => phase::observe(&scene.physics(), state, agent, scene.agents[agent].awareness.sees),
        MindKind::Published => observe(kind, &scene.physics(), state, agent),
    }
}

/// The belief of an agent of a scene after its first observation ([`first_observation()`]), as [`belief()`],
/// and with the theory of mind that the scene gives it.
#[must_use]
pub fn belief_in(
    scene: &Scene,
    parameters: &MindParameters,
    observation: &Observation,
    state: Option<&State>,
    random: &mut Pcg64Mcg,
) -> Box<dyn BeliefState> {
    match parameters {
        MindParameters::Phase(parameters) => phase::belief_in(scene, *parameters, observation, random),
        MindParameters::Published(_) => {
            belief(scene.layout, &scene.physics(), parameters, observation, state, random)
        }
    }
}

/// The belief of an agent after its first observation, which has to be made by the senses of its kind
/// ([`observe()`]) of a state, which may be told too ([`BeliefState::update`]).
#[must_use]
pub fn belief(
    layout: Layout,
    physics: &PhysicsConfig,
    parameters: &MindParameters,
    observation: &Observation,
    state: Option<&State>,
    random: &mut Pcg64Mcg,
) -> Box<dyn BeliefState> {
    match parameters {
        MindParameters::Phase(parameters) => {
            phase::belief(physics, parameters.particles, observation, random)
        }
        MindParameters::Published(parameters) => {
            published::belief(layout, physics, parameters, observation, state, random)
        }
    }
}

//! Algorithm 1 of the paper: both agents observe, update their beliefs, plan and act simultaneously.

use crate::{SimulationSettings, environment::Environment};
use core::ops::ControlFlow;
use phase_event::{Event, Step, Thought};
use phase_minds::{Agent, carried_out};
use phase_model::{
    AGENT_COUNT, Action, AgentId, PhysicsConfig, Scene, SceneError, State, Subgoal,
    arena::SUBSTEPS,
    random::{self, Pcg64Mcg, Purpose},
};
use thiserror::Error;

/// Speed below which a body counts as being at rest (u/s).
const REST_SPEED: f32 = 0.05;

/// Displacement or rotation in a step below which a body is not seen to move (u; rad).
const MOTION_TOLERANCE: f32 = 0.02;

/// Why a scene could not be simulated.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum SimulationError {
    /// The scene is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The settings are invalid for a search, or the search failed.
    #[error(transparent)]
    Search(#[from] phase_pomcp::PomcpError),
    /// The number of particles is zero.
    #[error("minds.particles must be at least 1")]
    NoParticles,
}

/// Simulates a scene from its start to its end.
///
/// # Errors
/// [`SimulationError`] for invalid scenes and settings.
pub fn simulate(scene: &Scene, seed: u64, settings: &SimulationSettings) -> Result<Event, SimulationError> {
    let (event, _) = simulate_with(scene, seed, settings, &mut |_| ControlFlow::Continue(()))?;
    Ok(event)
}

/// As [`simulate`], calling `on_step` with every step as it is computed. When that breaks, the event ends
/// early; the returned flag says whether the event was completed.
///
/// # Errors
/// [`SimulationError`] for invalid scenes and settings.
pub fn simulate_with(
    scene: &Scene,
    seed: u64,
    settings: &SimulationSettings,
    on_step: &mut dyn FnMut(&Step) -> ControlFlow<()>,
) -> Result<(Event, bool), SimulationError> {
    scene.validate()?;
    if settings.minds.particles == 0 {
        return Err(SimulationError::NoParticles);
    }
    let physics = scene.physics();
    let initial = scene.initial_state();
    let mut world = Environment::new(settings.engine, &physics, &initial);
    let mut minds = Minds::new(scene, &initial, seed, settings)?;
    let mut event = Event { scene: scene.clone(), seed, initial, steps: Vec::new() };
    let (mut resting, mut still) = (0, 0);
    let mut state = initial;
    while event.steps.len() < settings.max_steps {
        let (actions, thoughts) = minds.decide()?;
        let idle = thoughts.iter().all(|thought| thought.subgoal == Subgoal::Stay);
        let before = state;
        let substeps = world.step(actions.map(|action| carried_out(action, &settings.minds, scene.layout)));
        state = substeps[SUBSTEPS - 1];
        let step = Step { actions, thoughts, substeps };
        let flow = on_step(&step);
        event.steps.push(step);
        if flow.is_break() {
            return Ok((event, false));
        }
        resting = if idle && is_at_rest(&physics, &state) { resting + 1 } else { 0 };
        still = if is_unmoved(&physics, &before, &state) { still + 1 } else { 0 };
        let over = resting >= settings.rest_steps || still >= settings.still_steps;
        if over && event.steps.len() >= settings.min_steps {
            break;
        }
        minds.perceive(&state, actions);
    }
    debug_assert!(state.is_finite(&physics));
    Ok((event, true))
}

/// Whether a viewer would judge that nothing has moved in a step.
fn is_unmoved(physics: &PhysicsConfig, before: &State, after: &State) -> bool {
    physics.entities().all(|entity| {
        let (before, after) = (before.body(entity), after.body(entity));
        before.position.distance(after.position) < MOTION_TOLERANCE
            && (before.angle - after.angle).abs() < MOTION_TOLERANCE
    })
}

fn is_at_rest(physics: &PhysicsConfig, state: &State) -> bool {
    physics.entities().all(|entity| state.body(entity).velocity.length() < REST_SPEED)
}

/// The generator of an agent's belief. It is a separate stream, so that beliefs can be recomputed from a
/// recorded event without planning again.
pub(crate) fn belief_stream(seed: u64, agent: AgentId) -> Pcg64Mcg {
    random::stream(seed, Purpose::Belief, agent.number().into())
}

/// Both agents with their random streams.
struct Minds {
    agents: [Agent; AGENT_COUNT],
    beliefs: [Pcg64Mcg; AGENT_COUNT],
    searches: [Pcg64Mcg; AGENT_COUNT],
    /// The idle agent, if any.
    idle: Option<AgentId>,
}

impl Minds {
    fn new(
        scene: &Scene,
        initial: &State,
        seed: u64,
        settings: &SimulationSettings,
    ) -> Result<Self, SimulationError> {
        let mut beliefs: [Pcg64Mcg; AGENT_COUNT] = AgentId::ALL.map(|agent| belief_stream(seed, agent));
        let searches = AgentId::ALL.map(|agent| random::stream(seed, Purpose::Search, agent.number().into()));
        let mut mind =
            |agent: AgentId| Agent::new(scene, agent, &settings.minds, initial, &mut beliefs[agent]);
        let agents = [mind(AgentId::ZERO)?, mind(AgentId::ONE)?];
        Ok(Self { agents, beliefs, searches, idle: settings.idle })
    }

    fn decide(&mut self) -> Result<([Action; AGENT_COUNT], [Thought; AGENT_COUNT]), SimulationError> {
        let (first, why_first) = self.decide_for(AgentId::ZERO)?;
        let (second, why_second) = self.decide_for(AgentId::ONE)?;
        Ok(([first, second], [why_first, why_second]))
    }

    fn decide_for(&mut self, agent: AgentId) -> Result<(Action, Thought), SimulationError> {
        if self.idle == Some(agent) {
            return Ok((Action::Stop, Thought::IDLE));
        }
        Ok(self.agents[agent].decide(&mut self.searches[agent])?)
    }

    fn perceive(&mut self, state: &State, actions: [Action; AGENT_COUNT]) {
        for (agent, mind) in AgentId::ALL.into_iter().zip(&mut self.agents) {
            if self.idle == Some(agent) {
                continue;
            }
            mind.perceive(actions[agent], state, &mut self.beliefs[agent]);
        }
    }
}

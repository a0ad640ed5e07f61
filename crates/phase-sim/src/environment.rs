//! The environment that an event is simulated in, by any engine.

use crate::Engine;
use phase_forward::{ForwardWorld, OriginalWorld};
use phase_model::{AGENT_COUNT, Action, PhysicsConfig, State, arena::SUBSTEPS};
use phase_world::World;

/// The world that an event happens in: the true dynamics, as opposed to the agents' models of it.
///
/// It is a state of all bodies with the memory of the engine, such as contact impulses, so that two
/// environments in the same state need not go on alike. A copy has that memory, too, and goes on as the
/// original, bit for bit.
///
/// # Examples
/// A strong agent that pushes forward moves:
///
/// ```
/// use phase_model::{Action, AgentId, Entity, Scene};
/// use phase_sim::{Engine, Environment};
///
/// let scene = Scene::from_json(
///     r#"{"layout": {"base": 0}, "objects": [], "event": "independent", "agents": [
///         {"size_level": 0, "strength_level": 3, "alpha": 0, "start": {"x": 23.5, "y": 8, "angle": 0},
///          "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 1, "sign": 1}},
///         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 8.5, "y": 8, "angle": 0},
///          "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 0, "sign": 1}}]}"#,
/// )?;
/// let start = scene.initial_state();
/// let mut environment = Environment::new(Engine::World, &scene.physics(), &start);
/// let substeps = environment.step([Action::Up, Action::Stop]);
/// let me = Entity::Agent(AgentId::ZERO);
/// assert!(substeps[4].position(me).distance(start.position(me)) > 0.05);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Environment(Inner);

impl core::fmt::Debug for Environment {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let engine = match self.0 {
            Inner::World(_) => Engine::World,
            Inner::Forward(_) => Engine::Forward,
            Inner::Original(_) => Engine::Original,
        };
        formatter.debug_tuple("Environment").field(&engine).finish()
    }
}

#[derive(Clone)]
enum Inner {
    World(Box<World>),
    Forward(Box<ForwardWorld>),
    Original(Box<OriginalWorld>),
}

impl Environment {
    /// A newly set-up world in a state, without any memory of earlier steps. `physics` has the walls, and the
    /// sizes and forces of the bodies.
    #[must_use]
    pub fn new(engine: Engine, physics: &PhysicsConfig, state: &State) -> Self {
        Self(match engine {
            Engine::World => Inner::World(Box::new(World::new(physics, state))),
            Engine::Forward => Inner::Forward(Box::new(ForwardWorld::new(physics, state))),
            Engine::Original => {
                let mut world = OriginalWorld::new(physics, state);
                world.settle();
                Inner::Original(Box::new(world))
            }
        })
    }

    /// Lets both agents carry out their actions, of agent 0 and of agent 1, for one step of 0.25 s; returns
    /// the states after each of its five substeps.
    pub fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        match &mut self.0 {
            Inner::World(world) => world.step(actions),
            Inner::Forward(world) => world.step(actions),
            Inner::Original(world) => world.step(actions),
        }
    }

    /// Sets both agents' velocities to zero, as the paper's two-player game does after every step, and
    /// returns the state; objects keep their velocities.
    pub fn stop_agents(&mut self) -> State {
        match &mut self.0 {
            Inner::World(world) => {
                world.stop_agents();
                world.state()
            }
            Inner::Forward(world) => {
                world.stop_agents();
                *world.state()
            }
            Inner::Original(world) => {
                world.stop_agents();
                *world.state()
            }
        }
    }
}

//! The policy of one PHASE agent, its mind: from belief to subgoal to action (paper, Algorithm 1).
//!
//! [`Agent::perceive`] updates the belief; [`Agent::decide`] plans from every particle, evaluates the subgoals, and
//! searches for an action with the particles that agree on the best one. [`Mind::decide`] does the latter for a
//! given belief, such as one estimated by inference.
//!
//! Key design decision: a mind has its own model of the world ([`phase_model::Dynamics`]) and no access to
//! the true state; everything it knows comes from observations. The cost is a second simulation of the
//! physics.
//!
//! An agent that faces the landmark it wants to reach, 5.5 u ahead in the same room, pushes forward:
//!
//! ```
//! use phase_agent::{Agent, MindParameters};
//! use phase_forward::Forward;
//! use phase_model::{Action, AgentId, Scene, random::{Purpose, stream}};
//! use phase_perception::observe;
//!
//! let scene = Scene::from_json(
//!     r#"{"layout": {"base": 0}, "objects": [], "event": "independent", "agents": [
//!         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 23.5, "y": 14, "angle": 0},
//!          "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 1, "sign": 1}},
//!         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 8.5, "y": 14, "angle": 0},
//!          "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 0, "sign": 1}}]}"#,
//! )?;
//! let forward = Forward::new(&scene.physics());
//! let observation = observe(&scene.physics(), &scene.initial_state(), AgentId::ZERO);
//! let settings = MindParameters { particles: 5, simulations: 100, ..MindParameters::default() };
//! let mut random = stream(1, Purpose::Search, 0);
//! let mut agent = Agent::new(&scene, AgentId::ZERO, forward, settings, &observation, &mut random)?;
//! let (action, thought) = agent.decide(&mut random)?;
//! assert_eq!(thought.subgoal.to_string(), "On(agent 0, landmark 1)");
//! assert_eq!(action, Action::Up);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod action_set;
pub mod agent;
mod habits;
pub mod mind;
pub mod objective;
pub mod overrides;
pub mod rollout_policy;
pub mod search_model;
pub mod settings;

pub use agent::Agent;
pub use mind::{BeliefView, Mind};
pub use overrides::ParametersError;
pub use settings::{Foresight, MindKind, MindParameters};

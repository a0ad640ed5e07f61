//! One PHASE agent's mind: from belief to subgoal to action (paper, Algorithm 1).
//!
//! [`Agent::perceive`] updates the belief, [`Agent::decide`] plans from every particle, weighs the subgoals,
//! and searches an action for the best of them with the particles that agree on it. The latter is [`Mind::decide`],
//! which inference uses with beliefs that it has estimated.
//!
//! The key design decision is that a mind owns its model of the world ([`phase_model::Dynamics`]) and never
//! sees the true one: whatever it knows it has perceived. The price is a second simulation of the physics.
//!
//! An agent that faces the landmark it wants to reach, 5.5 u ahead in the same room, pushes forward:
//!
//! ```
//! use phase_agent::{Agent, Settings};
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
//! let forward = Forward::new(&scene.physique());
//! let observation = observe(&scene.physique(), &scene.initial_state(), AgentId::ZERO);
//! let settings = Settings { particles: 5, simulations: 100, ..Settings::default() };
//! let mut random = stream(1, Purpose::Search, 0);
//! let mut agent = Agent::new(&scene, AgentId::ZERO, forward, settings, &observation, &mut random)?;
//! let (action, thought) = agent.decide(&mut random)?;
//! assert_eq!(thought.subgoal.to_string(), "On(agent 0, landmark 1)");
//! assert_eq!(action, Action::Up);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod agent;
pub mod convoy;
pub mod course;
pub mod guidance;
pub mod imagination;
mod load;
pub mod mind;
pub mod objective;
pub mod patience;
pub mod repertoire;
pub mod settings;

pub use agent::Agent;
pub use mind::{Mind, Outlook};
pub use settings::{Foresight, Settings};

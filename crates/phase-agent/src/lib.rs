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
//! use phase_model::random::{Purpose, stream};
//! use phase_model::{
//!     Action, AgentId, AgentSpec, Attitude, Body, EventKind, Goal, LandmarkId, Layout, Scene, Sign, Size,
//!     Strength, Vec2,
//! };
//! use phase_perception::observe;
//!
//! let spec = |agent, landmark, x| AgentSpec {
//!     size: Size::Small,
//!     strength: Strength::Strong,
//!     goal: Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive },
//!     attitude: Attitude::Neutral,
//!     start: Body::at_rest(Vec2::new(x, 14.0), 0.0), // faces +y
//! };
//! let agents = [spec(AgentId::ZERO, LandmarkId::TOP_RIGHT, 23.5), spec(AgentId::ONE, LandmarkId::TOP_LEFT, 8.5)];
//! let scene = Scene { layout: Layout::new(0, None)?, agents, objects: Vec::new(), kind: EventKind::Independent };
//!
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

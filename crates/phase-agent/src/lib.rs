//! The policy of one PHASE agent, its mind: from belief to subgoal to action (paper, Algorithm 1).
//!
//! [`Mind::decide`] plans from every particle of a belief, evaluates the subgoals, and searches for an action
//! with the particles that agree on the best one. The belief is an argument, so that inference can use a mind
//! with an estimated one; `phase_minds::Agent` joins a mind and a belief that follows observations.
//!
//! Key design decision: a mind has its own model of the world ([`phase_model::Dynamics`]) and no access to
//! the true state; everything it knows comes from observations. The cost is a second simulation of the
//! physics.
//!
//! An agent that faces the landmark it wants to reach, 5.5 u ahead in the same room, pushes forward:
//!
//! ```
//! use phase_agent::{BeliefView, Contest, Mind, PhaseParameters};
//! use phase_forward::Forward;
//! use phase_model::{Action, AgentId, Scene, random::{Purpose, stream}};
//! use phase_perception::observed_set;
//!
//! let scene = Scene::from_json(
//!     r#"{"layout": {"base": 0}, "objects": [], "event": "independent", "agents": [
//!         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 23.5, "y": 14, "angle": 0},
//!          "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 1, "sign": 1}},
//!         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 8.5, "y": 14, "angle": 0},
//!          "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 0, "sign": 1}}]}"#,
//! )?;
//! let physics = scene.physics();
//! let state = scene.initial_state();
//! let parameters = PhaseParameters { simulations: 100, ..PhaseParameters::default() };
//! let mut mind = Mind::new(&scene, AgentId::ZERO, Forward::new(&physics), parameters)?;
//! let observed = observed_set(&physics, &state, AgentId::ZERO);
//! let (last_action, suppositions, contest) = (None, &[][..], Contest::default());
//! let belief = BeliefView { particles: &[state], observed, last_action, suppositions, contest };
//! let (action, thought) = mind.decide(belief, &mut stream(1, Purpose::Search, 0))?;
//! assert_eq!(thought.subgoal.to_string(), "On(agent 0, landmark 1)");
//! assert_eq!(action, Action::Up);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod action_set;
mod ascription;
mod habits;
mod ignorance;
mod matter;
mod mind;
pub mod objective;
mod parameters;
pub mod policy;
mod pretext;
pub mod rollout_policy;
pub mod search_model;
mod suspicion;
mod theory;
mod view;

pub use ascription::{AscribedPolicy, HabitPolicy, TheoryParameters};
pub use matter::Consideration;
pub use mind::Mind;
pub use parameters::{Foresight, PhaseParameters, Prior};
pub use phase_belief::Contest;
pub use policy::PolicyNetwork;
pub use pretext::Scrutiny;
pub use theory::{Supposition, TheoryOfMind};
pub use view::BeliefView;

//! Simulation of social events: two PHASE agents in an environment (paper, Algorithm 1).
//!
//! [`simulate`] takes a scene and a seed and returns the [`Event`](phase_event::Event): both agents' actions
//! at every step with their explanations, and all substeps of the resulting motion. The event is simulated in
//! `phase-world`, or on request in `phase-forward` ([`Engine`]); the agents' observations, beliefs and
//! searches are computed in the same way for both.
//!
//! To choose the actions, for example when training a learner, play an [`Episode`] step by step: it has
//! rewards, [`Distances`] to go, and observations, these also as vectors of numbers ([`vector`]). A copy of
//! it is a place to go back to.
//!
//! Key design decision: every random stream belongs to one agent and one purpose. The same seed reproduces
//! the same event bit for bit, and an agent's beliefs can be recomputed from the recorded trajectory without
//! planning ([`beliefs()`]). An agent draws from its search stream once per decision, to seed a separate
//! generator for that decision. The trade-off is that a change in the number of draws of a belief update
//! changes all its later draws.
//!
//! Two agents go to two landmarks straight ahead, with less search than in the paper. After six steps both
//! are closer:
//!
//! ```
//! use phase_minds::MindParameters;
//! use phase_model::{AgentId, Entity, LandmarkId, Scene, arena};
//! use phase_sim::{SimulationSettings, simulate};
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let scene = Scene::from_json(
//!         r#"{"layout": {"base": 0}, "objects": [], "event": "independent", "agents": [
//!             {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 23.5, "y": 8, "angle": 0},
//!              "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 1, "sign": 1}},
//!             {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 8.5, "y": 8, "angle": 0},
//!              "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 0, "sign": 1}}]}"#,
//!     )?;
//!     let minds = MindParameters::default().with_particles(5).with_simulations(50);
//!     let settings = SimulationSettings { max_steps: 6, minds, ..SimulationSettings::default() };
//!     let event = simulate(&scene, 1, &settings)?;
//!     assert_eq!(event.steps.len(), 6);
//!     let last = event.steps[5].substeps[4];
//!     let aims = [(AgentId::ZERO, LandmarkId::TOP_RIGHT), (AgentId::ONE, LandmarkId::TOP_LEFT)];
//!     for (agent, landmark) in aims {
//!         let distance = last.position(Entity::Agent(agent)).distance(arena::LANDMARKS[landmark]);
//!         assert!(distance < 10.5); // 11.5 at the start
//!     }
//!     Ok(())
//! }
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod beliefs;
mod distances;
mod environment;
mod episode;
mod error;
mod minds;
mod replay;
mod settings;
mod simulation;
pub mod vector;

pub use beliefs::{BeliefSnapshot, belief_view, beliefs};
pub use distances::Distances;
pub use environment::Environment;
pub use episode::{Episode, View};
pub use error::SimulationError;
pub use minds::Given;
pub use replay::replay;
pub use settings::{Engine, SimulationSettings};
pub use simulation::{Simulation, simulate, simulate_with};

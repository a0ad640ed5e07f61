//! Two PHASE agents and a world make a social event (paper, Algorithm 1).
//!
//! [`simulate`] takes a scene and a seed and returns the [`Event`](phase_event::Event): what both did at every step and why, and
//! all substeps of what became of it. The event plays in `phase-world`, or on request in `phase-forward`
//! ([`Engine`]); what agents perceive, believe and imagine is made in the same way for both.
//!
//! The key design decision is that every random stream belongs to one agent and one purpose. The same seed
//! makes the same event bit for bit, and what an agent believed can be recomputed from the recorded
//! trajectory without planning ([`beliefs()`]). From its search stream an agent draws once a decision, for a generator
//! of that decision's own. The price is that a change in how often a belief draws changes all its later draws.
//!
//! Two agents go to two landmarks straight ahead, with less search than in the paper. After six steps both are nearer:
//!
//! ```
//! use phase_model::{AgentId, Entity, LandmarkId, Scene, arena};
//! use phase_sim::{Settings, simulate};
//!
//! let scene = Scene::from_json(
//!     r#"{"layout": {"base": 0}, "objects": [], "event": "independent", "agents": [
//!         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 23.5, "y": 8, "angle": 0},
//!          "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 1, "sign": 1}},
//!         {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 8.5, "y": 8, "angle": 0},
//!          "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 0, "sign": 1}}]}"#,
//! )?;
//! let minds = phase_agent::Settings { particles: 5, simulations: 50, ..phase_agent::Settings::default() };
//! let event = simulate(&scene, 1, &Settings { max_steps: 6, minds, ..Settings::default() })?;
//! assert_eq!(event.steps.len(), 6);
//! let last = event.steps[5].substeps[4];
//! for (agent, landmark) in [(AgentId::ZERO, LandmarkId::TOP_RIGHT), (AgentId::ONE, LandmarkId::TOP_LEFT)] {
//!     let distance = last.position(Entity::Agent(agent)).distance(arena::LANDMARKS[landmark]);
//!     assert!(distance < 10.5); // 11.5 at the start
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod beliefs;
pub mod settings;
pub mod simulation;
mod truth;

pub use beliefs::{BeliefSnapshot, beliefs};
pub use settings::{Engine, Settings};
pub use simulation::{SimulationError, simulate, simulate_with};

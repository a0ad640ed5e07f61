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
//! Two agents on their way to two landmarks, with less search than the paper's. After six steps both are nearer to them:
//!
//! ```
//! use phase_model::{
//!     AgentId, AgentSpec, Attitude, Body, Entity, EventKind, Goal, LandmarkId, Layout, Scene, Sign, Size,
//!     Strength, Vec2, arena,
//! };
//! use phase_sim::{Settings, simulate};
//!
//! let goals = [(AgentId::ZERO, LandmarkId::TOP_RIGHT, 23.5), (AgentId::ONE, LandmarkId::TOP_LEFT, 8.5)];
//! let agents = goals.map(|(agent, landmark, x)| AgentSpec {
//!     size: Size::Small,
//!     strength: Strength::Strong,
//!     goal: Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive },
//!     attitude: Attitude::Neutral,
//!     start: Body::at_rest(Vec2::new(x, 8.0), 0.0), // faces +y
//! });
//! let scene = Scene { layout: Layout::new(0, None)?, agents, objects: Vec::new(), kind: EventKind::Independent };
//!
//! let minds = phase_agent::Settings { particles: 5, simulations: 50, ..phase_agent::Settings::default() };
//! let event = simulate(&scene, 1, &Settings { max_steps: 6, minds, ..Settings::default() })?;
//! assert_eq!(event.steps.len(), 6);
//! let last = event.steps[5].substeps[4];
//! for (agent, landmark, _) in goals {
//!     let distance = last.position(Entity::Agent(agent)).distance(arena::LANDMARKS[landmark]);
//!     assert!(distance < 11.5); // as it was at the start
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

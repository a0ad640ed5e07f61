//! Scenes for every kind of PHASE event.
//!
//! [`sample`] draws the physical and social variables of the paper (section "Procedural Generation") so that
//! a scene can show its label: help is needed, hindrance is possible. A [`Request`] names the [`Variant`] of
//! a kind, the index of the pair of goals and the layouts that may be drawn.
//!
//! Key design decision: rejection sampling. A recipe for each variant proposes scenes, and common checks,
//! some of them by the planner, reject infeasible ones. The cost is a few hundred proposals a scene,
//! microseconds each.
//!
//! A scene in which one agent is too weak for the object that it wants moved, and the other helps:
//!
//! ```
//! use phase_model::random::{Purpose, stream};
//! use phase_model::{AgentId, Attitude, Layout, Relation, Strength};
//! use phase_sampler::{Request, Starts, Variant, feasibility, sample};
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let layouts: Vec<Layout> = Layout::all_used().collect();
//!     let starts = Starts::Near;
//!     let request = Request { variant: Variant::Lift, goal_index: 0, layouts: &layouts, starts };
//!     let scene = sample(&request, &mut stream(1, Purpose::Scene, 0))?;
//!     assert_eq!(scene.relation(), Relation::Friendly);
//!
//!     // Which of the two helps is drawn.
//!     let helper = if scene.agents[0].attitude == Attitude::Help { AgentId::ZERO } else { AgentId::ONE };
//!     let helpee = helper.other();
//!     assert_eq!(scene.agents[helpee].strength, Strength::Weak);
//!     let goal = scene.agents[helpee].goal;
//!     assert!(feasibility::together(&scene, goal) && !feasibility::alone(&scene, helpee, goal));
//!     Ok(())
//! }
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod adversarial;
pub mod contrast;
pub mod draft;
pub mod feasibility;
mod friendly;
mod hiding;
pub mod named;
mod neutral;
pub mod recipe;
mod requirements;
pub mod stage;
pub mod variant;

pub use contrast::{About, Contrast, ContrastRequest, Stance};
pub use draft::Starts;
pub use named::{NamedError, sample_named};
pub use recipe::{Request, SampleError, sample, sample_kind, sample_variant};
pub use stage::{Part, Stage};
pub use variant::Variant;

//! High-level planning in PHASE: which subgoal an agent should achieve next.
//!
//! From one possible world (a belief particle) [`Planner::plan`] finds the agent's best plan: the physical
//! state is reduced to a few named locations, doors, widths, forces and grips, A* searches the symbolic
//! actions of one or both agents, and the agent's own part of the cheapest plan is translated into predicates
//! ([`Subgoal`](phase_model::Subgoal)). [`value::candidates`] then evaluates the first subgoals of all
//! particles (V with λ = 0.05).
//!
//! Key design decision: no action that can be attempted is pruned. A door that is too narrow or a load that
//! is too heavy costs more than any detour. A weak agent without help still pulls at its load, as viewers
//! expect. The cost is that the existence of a plan does not imply its success;
//! [`Plan::is_feasible`] says whether it can succeed.
//!
//! The search itself knows nothing of PHASE: [`search::solve`] finds the cheapest plan, of one agent or of
//! several together, for any [`search::SymbolicProblem`].
//!
//! This crate does not depend on a physics engine: it uses only widths, forces and straight-line distances,
//! so it can plan for any agent with a map. In this example one agent has to get from the upper left room to
//! the upper right one, where walls leave a single path:
//!
//! ```
//! use phase_model::{
//!     AgentBody, AgentId, Attitude, Body, BodySet, Goal, LandmarkId, Layout, PhysicsConfig, Sign, State,
//!     Vec2,
//! };
//! use phase_planner::Planner;
//!
//! fn main() -> Result<(), phase_model::LayoutError> {
//!     let layout = Layout::new(2, None)?;
//!     let body = AgentBody { radius: 0.8, max_force: 450.0 };
//!     let walls = layout.walls();
//!     let physics = PhysicsConfig { walls, agents: [body; 2], object_radii: [0.0; 2], object_count: 0 };
//!     let places = [Vec2::new(8.0, 18.0), Vec2::new(24.0, 8.0), Vec2::ZERO, Vec2::ZERO];
//!     let state = State::new(places.map(|place| Body::at_rest(place, 0.0)));
//!     let goals = [(AgentId::ZERO, LandmarkId::TOP_RIGHT), (AgentId::ONE, LandmarkId::TOP_LEFT)]
//!         .map(|(agent, landmark)| Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive });
//!     let planner = Planner::new(physics, layout, AgentId::ZERO, goals, Attitude::Neutral);
//!     let plan = planner.plan(&state, BodySet::EMPTY);
//!     let words: Vec<String> = plan.subgoals.iter().map(|subgoal| subgoal.to_string()).collect();
//!     println!("{}", words.join(", "));
//!     assert_eq!(words[0], "Close(agent 0, landmark 3)"); // the next room on the way
//!     assert_eq!(words[3], "On(agent 0, landmark 1)");
//!     assert!(plan.distance > 16.0); // longer than the straight line
//!     Ok(())
//! }
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod accuracy;
pub mod interference;
pub mod parameters;
pub mod plan;
pub mod planner;
pub mod problem;
pub mod search;
pub mod symbolic;
pub mod task;
mod to_subgoals;
pub mod value;
mod yielding;

pub use parameters::PlannerParameters;
pub use plan::Plan;
pub use planner::Planner;
pub use problem::{Location, PlanningProblem};
pub use search::{SearchOutcome, SymbolicPlan, SymbolicProblem};
pub use value::Candidate;

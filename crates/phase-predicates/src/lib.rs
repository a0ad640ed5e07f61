//! On, Touch, Attach and Close: the predicates with which PHASE agents plan.
//!
//! A physical [`State`](phase_model::State) becomes a [`SymbolicState`], the set of predicates true in it
//! (paper, appendix "Predicates, Symbolic States, Goals, and Subgoals"). Goals and subgoals are
//! [`Literal`](phase_model::Literal)s: predicates or their negations.
//! ```
//! use phase_model::{
//!     AgentBody, AgentId, Body, Entity, Goal, LandmarkId, Literal, PhysicsConfig, Predicate,
//!     PredicateTarget, Sign, State, Vec2, arena,
//! };
//! use phase_predicates::{SymbolicState, achieved};
//!
//! let body = AgentBody { radius: 0.8, max_force: 450.0 };
//! let physics =
//!     PhysicsConfig { walls: Vec::new(), agents: [body; 2], object_radii: [0.0; 2], object_count: 0 };
//! let agent = AgentId::ZERO;
//! let landmark = LandmarkId::BOTTOM_RIGHT;
//! let places = [arena::LANDMARKS[landmark], Vec2::new(8.0, 18.0), Vec2::ZERO, Vec2::ZERO];
//! let state = State::new(places.map(|place| Body::at_rest(place, 0.0)));
//!
//! let goal = Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive };
//! assert!(achieved(&physics, &state, goal));
//! assert_eq!(Literal::from(goal).to_string(), "On(agent 0, landmark 2)");
//! let symbolic = SymbolicState::of(&physics, &state);
//! assert!(symbolic.holds(Predicate::Close(Entity::Agent(agent), PredicateTarget::Landmark(landmark))));
//! assert!(!symbolic.holds(Predicate::Touch(agent, Entity::Agent(agent.other()))));
//! ```
//!
//! Key design decision: *Close to a landmark* means *in the landmark's room*. The paper defines it as "within
//! a certain distance" without a number; with the room as that distance, passing through a door changes one
//! predicate, and symbolic plans can refer to rooms without a fifth kind of predicate. The trade-off is that
//! two nearby points on either side of a border are close to different landmarks.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod evaluate;
pub mod lead;
pub mod symbolic;
pub mod threshold;

pub use evaluate::{achieved, holds, is_true};
pub use lead::landmark_lead;
pub use symbolic::SymbolicState;

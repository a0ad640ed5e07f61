//! The vocabulary of PHASE: plain types without physics or I/O.
//!
//! PHASE (Netanyahu et al., AAAI 2021) describes social events as a decentralised partially observable Markov
//! decision process: two agents share a physical state, observe parts of it and act simultaneously. This
//! crate defines the types that all other crates share: [`Scene`], [`Layout`], [`Entity`], [`State`],
//! [`Action`], [`Goal`], [`Attitude`], the ids in [`id`], and the trait [`Dynamics`].
//!
//! Key design decision: a [`State`] is plain `Copy` data of fixed size (two agents, at most two objects). A
//! planner that simulates a hundred million steps copies states instead of cloning graphs. The trade-off is
//! that the maximum numbers of agents and objects are compile-time limits.
//!
//! Units everywhere: world units (u), radians, seconds, newtons. Angle 0 faces +y and forward is
//! (−sin θ, cos θ); positive angles turn left (counter-clockwise).
//!
//! Agent 0 helps agent 1 to a landmark. The scene is checked, stored as JSON and read again:
//!
//! ```
//! use phase_model::{
//!     AgentId, AgentSpec, Attitude, Awareness, Body, EventKind, Goal, LandmarkId, Layout, Relation, Scene,
//!     Sign, Size, Strength, Vec2,
//! };
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let landmark = LandmarkId::TOP_LEFT;
//!     let goal = Goal::AgentOnLandmark { agent: AgentId::ONE, landmark, sign: Sign::Positive };
//!     let spec = |attitude, x| AgentSpec {
//!         size: Size::Small,
//!         strength: Strength::Strong,
//!         goal, // a helper's goal is the other's
//!         attitude,
//!         awareness: Awareness::default(),
//!         start: Body::at_rest(Vec2::new(x, 8.0), 0.0),
//!     };
//!     let agents = [spec(Attitude::Help, 12.0), spec(Attitude::Neutral, 20.0)];
//!     let layout = Layout::new(2, None)?;
//!     let scene = Scene { layout, agents, objects: Vec::new(), kind: EventKind::Helping };
//!     scene.validate()?;
//!     assert_eq!(scene.relation(), Relation::Friendly);
//!     assert_eq!(scene.physics().walls.len(), 2); // of layout 2
//!     assert_eq!(Scene::from_json(&scene.to_json()?)?, scene);
//!     Ok(())
//! }
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod action;
pub mod arena;
mod awareness;
pub mod entity;
pub mod foreign;
pub mod geometry;
pub mod goal;
pub mod id;
mod intent;
pub mod json;
pub mod judgement;
pub mod layout;
pub mod path;
mod penetration;
pub mod physics;
pub mod predicate;
pub mod random;
pub mod reward;
pub mod scene;
pub mod scene_json;
pub mod setting;
pub mod state;
pub mod subgoal;
pub mod validate;
pub mod warning;
pub mod words;

pub use action::Action;
pub use awareness::{Awareness, Knowledge, Level, MOST_WAITING, Sight};
pub use entity::{AGENT_COUNT, BodySet, Entity, MAX_ENTITIES, MAX_OBJECTS};
pub use geometry::Segment;
pub use glam::Vec2;
pub use goal::{Attitude, Goal, Relation, Sign};
pub use id::{AgentId, IdError, LandmarkId, ObjectId, RoomId, SlotId};
pub use intent::{Intent, physical_goals};
pub use judgement::{Forecast, Judgement, RelationProbabilities, RoleProbabilities};
pub use layout::{Flip, Layout, LayoutError};
pub use physics::{AgentBody, PhysicsConfig, Size, Strength};
pub use predicate::{Literal, Predicate, PredicateTarget};
pub use scene::{AgentSpec, EventKind, ObjectSpec, Scene};
pub use scene_json::SceneReadError;
pub use state::{Body, Contacts, Dynamics, Grip, Side, State};
pub use subgoal::Subgoal;
pub use validate::SceneError;
pub use warning::SceneWarning;

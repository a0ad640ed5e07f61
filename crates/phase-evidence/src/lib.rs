//! Evidence in an event, judged from its trajectory.
//!
//! A [`Track`] is one state for each step. From it [`GoalOutcome`] tells whether and when a goal was reached,
//! [`mod@holding`] which agent held what and when, [`mod@contact`] which entities touched, [`mod@contest`]
//! how far each of two competitors got an object its way, [`mod@blocking`] which agent obstructed the other,
//! [`mod@pursuit`] which agent pursued the other, [`mod@exploration`] which region an agent explored first,
//! [`mod@search`] where it looks for what was moved, [`mod@motion`] how fast and how far an agent moved and
//! [`mod@rest`] how quietly an event ended.
//! [`Parting`](parting::Parting) tells where two events that begin alike part, and [`Effect`] compares an
//! event with the same one in which an agent did nothing, which distinguishes help from mere presence.
//! [`mod@selection`] checks whether an event shows its label: whether the intended social event is visible in
//! it, and [`Narrative`] tells an event in words.
//!
//! Key design decision: evidence does not depend on intentions. An event in which helping was intended but
//! had no effect shows no help. Only [`Discovery`], of an agent that finds out what the other wants, reads
//! thoughts. The same functions therefore serve simulated events, measured recordings
//! (which contain neither grips nor contacts; outlines replace contacts) and predicted ones. The trade-off
//! is that what happens between two steps, a quarter of a second apart, is not seen.
//!
//! Agent 0 goes 2 u a step towards a landmark and arrives in step 3; agent 1 rests far from its own:
//!
//! ```
//! use phase_evidence::{GoalOutcome, Track};
//! use phase_model::{
//!     AgentBody, AgentId, Body, Entity, Goal, LandmarkId, PhysicsConfig, Sign, State, Vec2, arena,
//! };
//!
//! let body = AgentBody { radius: 0.8, max_force: 450.0 };
//! let physics =
//!     PhysicsConfig { walls: Vec::new(), agents: [body; 2], object_radii: [0.0; 2], object_count: 0 };
//! let target = arena::LANDMARKS[LandmarkId::TOP_RIGHT];
//! let states = [6.0, 4.0, 2.0, 0.0, 0.0].map(|left| {
//!     let places = [target - Vec2::new(0.0, left), Vec2::new(9.0, 9.0), Vec2::ZERO, Vec2::ZERO];
//!     State::new(places.map(|place| Body::at_rest(place, 0.0)))
//! });
//! let track = Track { physics, states: states.to_vec() };
//!
//! let goal = |agent| Goal::AgentOnLandmark { agent, landmark: LandmarkId::TOP_RIGHT, sign: Sign::Positive };
//! assert_eq!(GoalOutcome::of(&track, goal(AgentId::ZERO)), GoalOutcome { reached: true, steps: Some(3) });
//! assert_eq!(GoalOutcome::of(&track, goal(AgentId::ONE)), GoalOutcome { reached: false, steps: None });
//! assert_eq!(track.distance_travelled(Entity::Agent(AgentId::ZERO), 1..5), 6.0);
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod blocking;
pub mod clarity;
pub mod contact;
pub mod contest;
pub mod discovery;
pub mod effect;
pub mod exploration;
pub mod holding;
pub mod manner;
pub mod motion;
pub mod narrative;
pub mod outcome;
pub mod parting;
pub mod pursuit;
pub mod rest;
pub mod search;
pub mod selection;
pub mod track;

pub use clarity::Clarity;
pub use discovery::Discovery;
pub use effect::Effect;
pub use manner::Manner;
pub use motion::{MotionStatistics, VideoMotion};
pub use narrative::Narrative;
pub use outcome::GoalOutcome;
pub use rest::Rest;
pub use track::Track;

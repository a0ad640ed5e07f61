//! What an event shows, judged from where everybody was.
//!
//! A [`Track`] is one state for each step. From it [`Outcome`] tells whether and when a goal was reached,
//! [`mod@holding`] who held what when, [`mod@contact`] who touched whom, [`mod@blocking`] who stood in whose
//! way, [`mod@pursuit`] who went after whom, [`mod@exploration`] where someone looked first, [`mod@motion`] how
//! fast and how far someone moved and [`mod@rest`] how quietly an event ended. [`Effect`] compares an event with the same one in which an agent did nothing,
//! which is what tells help from company. [`mod@selection`] asks whether an event shows its label.
//!
//! The key design decision is that nobody's thoughts are asked: an event in which help was meant and nothing
//! came of it shows no help. The same functions so serve simulated events, measured recordings (which know
//! neither grips nor contacts; outlines stand in for contacts) and imagined ones. The price is that what
//! happens between two steps, a quarter of a second apart, is not seen.
//!
//! Agent 0 goes 2 u a step towards a landmark and arrives in step 3; agent 1 rests far from its own:
//!
//! ```
//! use phase_evidence::{Outcome, Track};
//! use phase_model::{AgentBody, AgentId, Body, Entity, Goal, LandmarkId, Physique, Sign, State, Vec2, arena};
//!
//! let body = AgentBody { radius: 0.8, max_force: 450.0 };
//! let physique = Physique { walls: Vec::new(), agents: [body; 2], object_radii: [0.0; 2], object_count: 0 };
//! let target = arena::LANDMARKS[LandmarkId::TOP_RIGHT];
//! let states = [6.0, 4.0, 2.0, 0.0, 0.0].map(|left| {
//!     let places = [target - Vec2::new(0.0, left), Vec2::new(9.0, 9.0), Vec2::ZERO, Vec2::ZERO];
//!     State::new(places.map(|place| Body::at_rest(place, 0.0)))
//! });
//! let track = Track { physique, states: states.to_vec() };
//!
//! let goal = |agent| Goal::AgentOnLandmark { agent, landmark: LandmarkId::TOP_RIGHT, sign: Sign::Positive };
//! assert_eq!(Outcome::of(&track, goal(AgentId::ZERO)), Outcome { reached: true, steps: Some(3) });
//! assert_eq!(Outcome::of(&track, goal(AgentId::ONE)), Outcome { reached: false, steps: None });
//! assert_eq!(track.distance_travelled(Entity::Agent(AgentId::ZERO), 1..5), 6.0);
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod blocking;
pub mod contact;
pub mod effect;
pub mod exploration;
pub mod holding;
pub mod motion;
pub mod outcome;
pub mod pursuit;
pub mod rest;
pub mod selection;
pub mod track;

pub use effect::Effect;
pub use motion::Motion;
pub use outcome::Outcome;
pub use rest::Rest;
pub use track::Track;

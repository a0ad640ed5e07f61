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

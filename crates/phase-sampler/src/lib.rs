//! Scenes for every kind of PHASE event.
//!
//! [`sample`] draws the physical and social variables of the paper (section "Procedural Generation") so that a
//! scene can show what its kind promises: someone who helps is needed, someone who hinders can. A [`Request`]
//! says which [`Variant`] of a kind, whose goals' turn it is, and which layouts may be drawn.
//!
//! The key design decision is rejection: a recipe for each variant draws freely, and a common set of checks, some
//! of them made by the planner itself, throws away what cannot work. The price is a few hundred draws a scene;
//! they cost microseconds.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod adversarial;
pub mod draft;
pub mod feasibility;
mod friendly;
mod neutral;
pub mod recipe;
pub mod variant;

pub use recipe::{Request, SampleError, sample, sample_kind};
pub use variant::Variant;

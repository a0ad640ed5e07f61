//! Scenes for every kind of PHASE event.
//!
//! [`sample`] draws the physical and social variables of the paper (section "Procedural Generation") so that a
//! scene can show what its kind promises: someone who helps is needed, someone who hinders can.
//!
//! The key design decision is rejection: a recipe for each kind draws freely, and a common set of checks, some
//! of them made by the planner itself, throws away what cannot work. The price is a few hundred draws a scene;
//! they cost microseconds.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod draft;
pub mod feasibility;
pub mod recipe;

pub use recipe::{SampleError, sample};

//! Checks by fuzzing: every reader, both engines, planners and searches, each as a function of some bytes.
//!
//! ```
//! use phase_fuzz::scenes::{Doing, Start, actions, physique, start};
//! use phase_model::random::{Purpose, stream};
//!
//! let mut random = stream(1, Purpose::Scene, 0);
//! let physics = physique(&mut random);
//! let state = start(&physics, Start::Odd, &mut random);
//! let state = state.expect("there is always room for overlapping bodies");
//! assert!(state.is_finite(&physics));
//! assert_eq!(actions(Doing::Anything, 20, &mut random).len(), 20);
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

#[cfg(feature = "command")]
pub mod command;
pub mod draw;
pub mod engines;
pub mod fuzzing;
mod mutate;
pub mod scenes;
pub mod seeds;
pub mod targets;

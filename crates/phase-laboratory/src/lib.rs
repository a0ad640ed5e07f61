//! PHASE events as stimuli of experiments.
//!
//! - [`clip`] cuts an event between two steps, with its labels and what of them is still true in the clip.
//! - [`regressors`] measures motion frame by frame; [`interest`] has the areas of bodies and landmarks in
//!   pixels.
//! - [`representation`] has representational dissimilarity matrices and their correlations.
//! - [`matching`] finds subsets of kinds that are alike in low-level motion.
//! - [`counterbalance`] makes lists of stimuli, and [`platform`] the files that experiment platforms read.
//!
//! Key design decision: everything here is a function of events in memory, without files, so that the same
//! clip has the same labels, frames and areas wherever it is used. The trade-off is that a command that needs
//! a clip's frames reads the whole event: a clip in a file has rows, not the substeps of the simulation.
//!
//! # Example
//!
//! ```
//! use phase_laboratory::clip::{Cut, Start};
//!
//! // Ten seconds from the middle of an event of 25 s: steps 30 to 70.
//! let cut = Cut::of_seconds(10.0, None)?;
//! let window = cut.window("demo-0000", 100)?;
//! assert_eq!((window.first_step, window.steps), (30, 40));
//! assert_eq!(Cut::of_seconds(10.0, Some(2.5))?.start, Start::Step(10));
//! assert!(Cut::of_seconds(10.1, None).is_err());
//! # Ok::<(), phase_laboratory::clip::ClipError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod clip;
pub mod counterbalance;
pub mod interest;
pub mod matching;
pub mod platform;
pub mod regressors;
pub mod representation;

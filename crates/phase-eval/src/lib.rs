//! How well a method perceives social events: the metrics of both tasks, with intervals.
//!
//! - [`method`] is what a method has to be: a [`Recogniser`] for Task 1 (goals and relations), a [`Forecaster`] for
//!   Task 2 (trajectories); [`plain`] has the plainest of both, below which no method should fall.
//! - [`goals`] and [`trajectories`] score answers; [`estimate`] puts intervals around every score.
//! - [`benchmark`] puts many methods on the same events side by side.
//! - [`results`] is what programs read, and [`predictions`] the answers of somebody else's method to either task.
//!
//! The key design decision is that every score is a mean over events of one number for each event. So one bootstrap
//! over events serves all of them, and whatever is kept of an event is enough to score it again. The price is
//! that figures which are no such means (the calibration error, the confusion matrix) come without an interval.
//!
//! Nothing here reads a file, looks at a clock or prints.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod benchmark;
pub mod estimate;
pub mod goals;
mod group;
pub mod method;
pub mod plain;
pub mod predictions;
pub mod results;
pub mod trajectories;

pub use estimate::Estimate;
pub use group::Group;
pub use method::{Forecaster, MethodError, Recogniser, Tick};

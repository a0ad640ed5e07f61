//! Evaluation of methods that perceive social events: the metrics of both tasks, with confidence intervals.
//!
//! - [`goals`] scores the answers of a [`Recogniser`](phase_event::Recogniser) (Task 1: goals and relations),
//!   [`trajectories`] those of a [`Forecaster`](phase_event::Forecaster) (Task 2); [`estimate`] puts
//!   intervals around every score.
//! - [`trivial`] has trivial baselines for both tasks, below which no method should fall.
//! - [`benchmark`] is many methods on the same events, and [`comparison`] two of them event by event.
//! - [`ratings`] are people's judgements of relations, with which [`goals::Agreement`] compares a method's.
//! - [`results`] is output for programs, and [`predictions`] the answers of an external method to either
//!   task.
//!
//! Key design decision: every score is a mean over events of one number for each event. So one bootstrap over
//! events serves all of them, and the stored data of an event suffices to score it again. The trade-off is
//! that figures which are not such means come without an interval (the calibration error, the confusion
//! matrix), or resample the events themselves (correlations with people).
//!
//! Nothing here reads a file, accesses a clock or prints.
//!
//! Extrapolation at constant velocity predicts that agent 0 continues at 6 u/s, which is 0.5 u in each step
//! of 1/12 s. In truth it stopped:
//!
//! ```
//! use core::ops::ControlFlow;
//! use phase_eval::{trajectories::Errors, trivial::ConstantVelocity};
//! use phase_event::{Forecaster, ObservedEvent};
//! use phase_model::{Body, Layout, Size, Vec2};
//!
//! let places = [Vec2::new(10.0, 5.0), Vec2::new(20.0, 15.0), Vec2::ZERO, Vec2::ZERO];
//! let mut row = places.map(|place| Body::at_rest(place, 0.0));
//! row[0].velocity = Vec2::new(6.0, 0.0);
//! let observed = ObservedEvent::new(Layout::new(0, None)?, [Size::Small; 2], Vec::new(), vec![row])?;
//!
//! let answer = ConstantVelocity.forecast(&observed, 4, 1, &mut || ControlFlow::Continue(()))?;
//! let (prediction, _details) = answer.ok_or("interrupted")?;
//! let truth = vec![vec![row[0].position; 4], vec![row[1].position; 4]];
//! let [agents, _entities] = Errors::of(&prediction.forecast, &truth)?;
//! // The errors of agent 0 are 0.5, 1, 1.5 and 2 u, those of agent 1 are 0.
//! assert!((agents.ade - 1.25 / 2.0).abs() < 1e-5);
//! assert!((agents.fde - 2.0 / 2.0).abs() < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod beliefs;
pub mod benchmark;
pub mod comparison;
pub mod estimate;
pub mod goals;
mod group;
pub mod intents;
pub mod predictions;
pub mod ratings;
pub mod results;
pub mod trajectories;
pub mod trivial;

pub use estimate::{CONFIDENCE, Estimate, RESAMPLES};
pub use group::GroupScores;

//! Errors of a physics engine with respect to recorded motion.
//!
//! Three kinds of record are replayed with their actions: [`Probe`]s, a few steps of one effect each;
//! [`Run`]s, a hundred steps of varied actions each; and [`Replay`]s, measured recordings whose actions are
//! known. Any [`Engine`] can be compared with them by [`probes_report`], [`run_reports`], [`replay_reports`]
//! and [`horizon_errors`]; the result is a [`Report`] of medians and percentiles.
//!
//! Key design decision: an engine is anything that can be set up in a state, settle, and be stepped. So the
//! command line and the tests of every engine measure with the same reader, the same replay and the same
//! statistics, and their figures are comparable. The trade-off is a small adapter for each engine; those of
//! the project's own, [`WorldEngine`], [`WarmForward`] and [`ColdForward`], are here, so that the command
//! line and the tests drive them alike, and the engines use this crate in their tests only.
//!
//! # What is measured
//!
//! The error of a step is the maximum over all bodies, of the distance between positions (u) and, separately,
//! of the difference of the unbounded angles (rad). Motion with contacts is chaotic, so a run simulated
//! freely is hardly informative after the first divergence. It is therefore also restarted from each of its
//! recorded states and simulated for one and for ten steps.
//!
//! Measured recordings are not restarted: their rows are means over the five substeps of a step and not
//! states, and a state of our own replay would compare the engine with itself.
//!
//! # Example
//!
//! A run of one step without actions, whose record nevertheless has agent 0 moved by 0.25 u. The engine
//! leaves it in place, so that is its error:
//!
//! ```
//! use phase_calibration::{Run, WorldEngine, run_reports};
//!
//! let runs = Run::parse(
//!     r#"{"runs": [{"name": "still", "walls": [], "radii": [0.8, 0.8, 0.8, 0.8], "max_force": [450, 450],
//!         "actions": [["noforce"], ["noforce"]], "attached_after_step": [[null, null]],
//!         "states": [[[8, 12, 0, 0, 0, 0], [24, 12, 0, 0, 0, 0], [12, 4, 0, 0, 0, 0], [20, 20, 0, 0, 0, 0]],
//!                    [[8, 12.25, 0, 0, 0, 0], [24, 12, 0, 0, 0, 0], [12, 4, 0, 0, 0, 0],
//!                     [20, 20, 0, 0, 0, 0]]]}]}"#,
//! )?;
//! let reports = run_reports::<WorldEngine>(&runs);
//! assert_eq!((reports.len(), reports[0].steps), (1, 1));
//! assert!((reports[0].position.max - 0.25).abs() < 1e-3);
//! # Ok::<(), phase_calibration::ReadError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod deviation;
mod engine;
mod engines;
mod error;
mod family;
mod measure;
mod probe;
mod read;
mod replay;
mod report;
mod run;
mod spread;

pub use deviation::Deviation;
pub use engine::Engine;
pub use engines::{ColdForward, OriginalEngine, WarmForward, WorldEngine};
pub use error::ReadError;
pub use family::family;
pub use measure::{horizon_errors, probes_report, replay_reports, run_reports};
pub use probe::{Probe, ProbeErrors};
pub use replay::Replay;
pub use report::{
    FamilyReport, HorizonErrors, ProbeReport, ProbesReport, Report, RunReport, StatelessErrors, SubstepReport,
};
pub use run::{Run, grip_of};
pub use spread::ErrorQuantiles;

//! How far an engine of the PHASE physics comes out from recorded motion.
//!
//! Three kinds of record are replayed with the actions that made them: [`Probe`]s, each a few steps of one
//! effect; [`Run`]s, a hundred steps of everything; and [`Replay`]s, real recordings whose actions are known.
//! Any [`Engine`] can be held against them with [`probes_report`], [`run_reports`], [`replay_reports`] and
//! [`ahead`]; what comes out is a [`Report`] of medians and percentiles.
//!
//! The key design decision is that an engine is whatever can be set up in a state, settle, and be stepped. So
//! the command line and the tests of every engine measure with the same reader, the same replay and the same
//! statistics, and numbers from different places can be held side by side. The price is a small adapter for
//! each engine; those of the project's own, [`WorldEngine`], [`WarmForward`] and [`ColdForward`], are here, so
//! that the command line and the tests drive them alike, and the engines use this crate in their tests only.
//!
//! # What is measured
//!
//! The error of a step is the largest over all bodies, of the distance between positions (u) and, separately,
//! of the difference of the unbounded angles (rad). Motion with contacts is chaotic, so a run that is followed
//! freely says little after the first divergence. It is therefore also restarted from each of its recorded
//! states and followed for one and for ten steps.
//!
//! Real recordings are not restarted: their rows are means over the five substeps of a step and no states, and
//! a state of our own replay would hold the engine against itself.
//!
//! # Example
//!
//! A run of one step in which nobody acts, and which nevertheless claims that agent 0 moved by 0.25 u. The engine leaves
//! it where it was, so that is its error:
//!
//! ```
//! use phase_calibration::{Run, WorldEngine, run_reports};
//!
//! let runs = Run::parse(
//!     r#"{"runs": [{"name": "still", "walls": [], "radii": [0.8, 0.8, 0.8, 0.8], "max_force": [450, 450],
//!         "actions": [["noforce"], ["noforce"]], "attached_after_step": [[null, null]],
//!         "states": [[[8, 12, 0, 0, 0, 0], [24, 12, 0, 0, 0, 0], [12, 4, 0, 0, 0, 0], [20, 20, 0, 0, 0, 0]],
//!                    [[8, 12.25, 0, 0, 0, 0], [24, 12, 0, 0, 0, 0], [12, 4, 0, 0, 0, 0], [20, 20, 0, 0, 0, 0]]]}]}"#,
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
pub use engines::{ColdForward, WarmForward, WorldEngine};
pub use error::ReadError;
pub use family::family;
pub use measure::{ahead, probes_report, replay_reports, run_reports};
pub use probe::{Followed, Probe};
pub use replay::Replay;
pub use report::{
    Ahead, FamilyReport, ProbeReport, ProbesReport, Report, RunReport, StateAlone, SubstepReport,
};
pub use run::{Run, grip_of};
pub use spread::Spread;

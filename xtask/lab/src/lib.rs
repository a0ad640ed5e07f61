//! Fits of minds and inference to recordings and events whose labels are known, and checks of minds,
//! behaviour, physics and tracks: commands of `cargo xtask`.
//!
//! - `check-behaviour` shows how reliably agents do what they are planned to do,
//! - `check-forecasts` divides the error of forecasts into inference, minds and chance,
//! - `check-minds` compares minds with recorded agents,
//! - `check-physics` compares an engine with recorded motion,
//! - `check-track` compares tracks with the motion in videos that it draws,
//! - `fit-beliefs` fits how strongly actions tell SIMPLE what agents know,
//! - `fit-forecast` fits how SIMPLE combines simulated futures,
//! - `fit-inference` fits how SIMPLE weighs its evidence,
//! - `fit-intents` fits what SIMPLE takes neutral agents to know,
//! - `fit-minds` fits the parameters of minds to recorded agents,
//! - `fit-reports` fits how people report what they saw,
//! - `fit-selection` measures in recordings what selection limits.
//!
//! Key design decision: a number that was fitted can be fitted again, by a command that anyone can run. The
//! price is a package that users of PHASE never need, so `cargo xtask` builds it only when one of these
//! commands is asked for.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod check_behaviour;
pub mod check_forecasts;
pub mod check_minds;
pub mod check_physics;
pub mod check_search;
pub mod check_track;
pub mod cli;
pub mod error;
mod evaluations_file;
pub mod fit_beliefs;
pub mod fit_events;
pub mod fit_forecast;
pub mod fit_inference;
pub mod fit_intents;
pub mod fit_minds;
pub mod fit_reports;
pub mod fit_selection;
mod folds;
mod recognition;

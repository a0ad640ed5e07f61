//! The commands of the lab.

use crate::{
    check_behaviour::{self, options::CheckBehaviour},
    check_forecasts,
    check_minds::{self, options::CheckMinds},
    check_physics::{self, options::CheckPhysics},
    check_search,
    check_track::{self, CheckTrack},
    error::LabError,
    fit_beliefs,
    fit_events::FitEvents,
    fit_forecast,
    fit_inference::{self, options::FitInference},
    fit_intents,
    fit_minds::{self, options::FitMinds},
    fit_reports::{self, options::FitReports},
    fit_selection::{self, FitSelection},
};
use clap::Subcommand;
use phase_cli::{
    context::Context,
    program::{CommandLine, Interface},
};

/// The command line.
pub type Cli = CommandLine<Command>;

/// A command of the lab.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Compare an engine of the physics with recorded motion
    CheckPhysics(CheckPhysics),
    /// Measure how reliably agents show the intended behaviour
    CheckBehaviour(CheckBehaviour),
    /// Divide the error of forecasts into inference, minds and chance
    CheckForecasts(FitEvents),
    /// Compare minds with the agents of recordings or events whose labels are known
    CheckMinds(CheckMinds),
    /// Compare the decisions of short searches with those of a long one, by the priors of their root
    CheckSearch(FitEvents),
    /// Compare tracks with the motion in videos of known events that are drawn in several styles
    CheckTrack(CheckTrack),
    /// Fit the parameters of the minds to recordings or events whose labels are known
    FitMinds(FitMinds),
    /// Fit how SIMPLE weighs its evidence to events whose labels are known
    FitInference(FitInference),
    /// Fit how strongly actions tell SIMPLE what agents know
    FitBeliefs(FitEvents),
    /// Fit what SIMPLE takes neutral agents to know of the other's goal
    FitIntents(FitEvents),
    /// Fit how SIMPLE combines simulated futures
    FitForecast(FitEvents),
    /// Fit how people report what they saw to raters of recordings
    FitReports(FitReports),
    /// Measure in recordings what selection limits and how two part who get nowhere
    FitSelection(FitSelection),
}

impl Interface for Command {
    type Error = LabError;

    const ABOUT: &'static str =
        "Fits of minds and inference, and checks of minds, behaviour, physics and tracks";

    fn run(&self, context: &Context) -> Result<(), LabError> {
        match self {
            Self::CheckPhysics(arguments) => check_physics::run(arguments, context),
            Self::CheckBehaviour(arguments) => check_behaviour::run(arguments, context),
            Self::CheckForecasts(arguments) => check_forecasts::run(arguments, context),
            Self::CheckMinds(arguments) => check_minds::run(arguments, context),
            Self::CheckSearch(arguments) => check_search::run(arguments, context),
            Self::CheckTrack(arguments) => check_track::run(arguments, context),
            Self::FitInference(arguments) => fit_inference::run(arguments, context),
            Self::FitMinds(arguments) => fit_minds::run(arguments, context),
            Self::FitBeliefs(arguments) => fit_beliefs::run(arguments, context),
            Self::FitIntents(arguments) => fit_intents::run(arguments, context),
            Self::FitForecast(arguments) => fit_forecast::run(arguments, context),
            Self::FitReports(arguments) => fit_reports::run(arguments),
            Self::FitSelection(arguments) => fit_selection::run(arguments, context),
        }
    }
}

//! The commands of `cargo xtask`.

use crate::{
    book::{self, Book},
    check_behaviour::{self, options::CheckBehaviour},
    check_engines::{self, CheckEngines},
    check_minds::{self, options::CheckMinds},
    check_physics::{self, options::CheckPhysics},
    check_verify::{self, CheckVerify},
    draw_behaviour::{self, DrawBehaviour},
    error::XtaskError,
    fit_events::FitEvents,
    fit_forecast,
    fit_inference::{self, options::FitInference},
    fit_minds::{self, options::FitMinds},
    fit_reports::{self, options::FitReports},
    fuzz::{self, Fuzz},
    golden::{self, GoldenOptions},
    leaderboard::{self, Leaderboard},
    results::{self, Results},
    tidy,
    torture::{self, Torture},
    wasm,
};
use clap::{Parser, Subcommand};
use phase_cli::{
    context::{Context, Verbosity},
    playground::{self, Playground},
    program::Interface,
};

/// The commands of phase, and the development commands of this workspace
#[derive(Parser, Debug)]
#[command(version)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// Verbosity.
    #[command(flatten)]
    pub verbosity: Verbosity,
}

/// What to do.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// A command of `phase`.
    #[command(flatten)]
    Phase(phase_cli::cli::Command),
    /// Compare an engine of the physics with recorded motion
    CheckPhysics(CheckPhysics),
    /// Look for energy from nowhere, overlaps and other oddities of both engines in random scenes
    CheckEngines(CheckEngines),
    /// Run readers, engines, planner and searches on mutated inputs
    Fuzz(Fuzz),
    /// Measure how reliably agents show the intended behaviour
    CheckBehaviour(CheckBehaviour),
    /// Draw scenes for check-behaviour from the sampler
    DrawBehaviour(DrawBehaviour),
    /// Compare minds with the agents of recordings or events whose labels are known
    CheckMinds(CheckMinds),
    /// Edit a dataset many times, and count what verify finds
    CheckVerify(CheckVerify),
    /// Fit the parameters of the minds to recordings or events whose labels are known
    FitMinds(FitMinds),
    /// Fit how SIMPLE weighs its evidence to events whose labels are known
    FitInference(FitInference),
    /// Fit how SIMPLE combines simulated futures to events whose continuation is known
    FitForecast(FitEvents),
    /// Fit how people report what they saw to raters of recordings
    FitReports(FitReports),
    /// Run the golden tests of all crates, or rewrite the values that they compare with
    Golden(GoldenOptions),
    /// Make the book of the documents, with mdBook
    Book(Book),
    /// Score the predictions in docs/leaderboard, and rewrite its page
    Leaderboard(Leaderboard),
    /// Rewrite the documents that show results from docs/results.json, which `benchmark --page` writes
    Results(Results),
    /// Check the project rules that the compiler cannot
    Tidy,
    /// Stop commands while they write, and check that nothing is lost
    Torture(Torture),
}

impl Interface for Cli {
    type Error = XtaskError;

    fn verbosity(&self) -> Verbosity {
        self.verbosity
    }

    fn run(&self, context: &Context) -> Result<(), XtaskError> {
        match &self.command {
            // The source can build what an installed program includes.
            Command::Phase(phase_cli::cli::Command::Playground(Playground { out, wasm: None })) => {
                let wasm = Some(wasm::build(context)?);
                Ok(playground::run(&Playground { out: out.clone(), wasm }, context)?)
            }
            Command::Phase(command) => Ok(command.run(context)?),
            Command::CheckPhysics(arguments) => check_physics::run(arguments, context),
            Command::CheckEngines(arguments) => check_engines::run(arguments, context),
            Command::Fuzz(arguments) => fuzz::run(arguments, context),
            Command::CheckBehaviour(arguments) => Ok(check_behaviour::run(arguments, context)?),
            Command::DrawBehaviour(arguments) => draw_behaviour::run(arguments),
            Command::CheckMinds(arguments) => check_minds::run(arguments, context),
            Command::CheckVerify(arguments) => check_verify::run(arguments, context),
            Command::FitInference(arguments) => fit_inference::run(arguments, context),
            Command::FitMinds(arguments) => fit_minds::run(arguments, context),
            Command::FitForecast(arguments) => fit_forecast::run(arguments, context),
            Command::FitReports(arguments) => fit_reports::run(arguments),
            Command::Golden(options) => golden::run(options),
            Command::Book(options) => book::run(options),
            Command::Leaderboard(options) => leaderboard::run(options, context),
            Command::Results(options) => results::run(options),
            Command::Tidy => tidy::run(),
            Command::Torture(arguments) => torture::run(arguments, context),
        }
    }
}

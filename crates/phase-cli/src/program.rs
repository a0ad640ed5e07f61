//! From a command line to an exit code.

use crate::{
    console::{Unprinted, print_message},
    context::{Context, Program, Verbosity},
    surroundings,
};
use clap::{Command, CommandFactory, FromArgMatches, Parser, Subcommand, error::ErrorKind};
use phase_model::foreign;
use std::{error::Error, ffi::OsString, process::ExitCode};

/// The commands of a program.
pub trait Interface: Subcommand {
    /// Why a command fails.
    type Error: Failure;

    /// A line on the purpose of the program.
    const ABOUT: &'static str;

    /// Runs the command.
    ///
    /// # Errors
    /// If it fails.
    fn run(&self, context: &Context) -> Result<(), Self::Error>;
}

/// The command line of a program.
#[derive(Parser, Debug)]
#[command(name = "phase", version, about = C::ABOUT)]
pub struct CommandLine<C: Interface> {
    /// The command.
    #[command(subcommand)]
    pub command: C,
    /// Verbosity.
    #[command(flatten)]
    pub verbosity: Verbosity,
}

/// An error that decides the exit code of a program.
pub trait Failure: Error {
    /// 2 for something about the input or output folder, 130 for an interruption, 1 for everything else.
    fn exit_code(&self) -> u8;
}

/// A command line that failed.
#[derive(Debug)]
pub struct Failed {
    /// Sentence that says what the problem is, or the help for a line without a command.
    pub sentence: String,
    /// The causes of it, nearest first.
    pub causes: Vec<String>,
    /// As of [`Failure::exit_code`].
    pub exit_code: u8,
    /// Whether the command line could not be understood.
    pub usage: bool,
}

/// Runs a command line, program name first.
///
/// # Errors
/// [`Failed`].
pub fn run_with<I: Interface>(
    program: Program,
    arguments: impl IntoIterator<Item = OsString>,
) -> Result<(), Failed> {
    let command = with_negative_numbers(CommandLine::<I>::command());
    let command = command.name(program.name).bin_name(program.name);
    let parsed = command.try_get_matches_from(arguments);
    let outside = parsed.as_ref().map_or(Ok(()), surroundings::check);
    outside.map_err(|rule| {
        let sentence = foreign::message(&rule).into_owned();
        Failed { sentence, causes: Vec::new(), exit_code: 2, usage: false }
    })?;
    match parsed.and_then(|matches| CommandLine::<I>::from_arg_matches(&matches)) {
        Ok(CommandLine { command, verbosity }) => {
            let context = Context { program, verbosity };
            command.run(&context).map_err(|error| {
                let causes = if context.verbosity.verbose { causes(&error) } else { Vec::new() };
                let exit_code = error.exit_code();
                let sentence = foreign::message(&error.to_string()).into_owned();
                Failed { sentence, causes, exit_code, usage: false }
            })
        }
        Err(error) if !error.use_stderr() => {
            // Help or version was requested.
            error.print().map_err(|source| {
                let sentence = Unprinted(source).to_string();
                Failed { sentence, causes: Vec::new(), exit_code: 1, usage: false }
            })
        }
        Err(error) => {
            let sentence = foreign::message(&one_sentence(&error)).into_owned();
            Err(Failed { sentence, causes: Vec::new(), exit_code: 2, usage: true })
        }
    }
}

/// Runs a command line, program name first, and returns its exit code.
pub fn main_with<I: Interface>(program: Program, arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let Err(failed) = run_with::<I>(program, arguments) else { return ExitCode::SUCCESS };
    let prefix = if failed.usage { "" } else { "error: " };
    print_message(format!("{prefix}{}", failed.sentence));
    failed.causes.iter().for_each(|cause| print_message(format!("  caused by: {cause}")));
    ExitCode::from(failed.exit_code)
}

/// The command, whose options take a negative number as a value, not as an option of that name: one below a
/// range is refused as one above it.
fn with_negative_numbers(command: Command) -> Command {
    let command = command.mut_args(|argument| {
        let takes = !argument.is_positional() && argument.get_action().takes_values();
        if takes { argument.allow_negative_numbers(true) } else { argument }
    });
    command.mut_subcommands(with_negative_numbers)
}

/// The chain of causes of an error, nearest first.
fn causes(error: &dyn Error) -> Vec<String> {
    std::iter::successors(error.source(), |cause| (*cause).source()).map(ToString::to_string).collect()
}

/// The problem of a command line, on one line; the whole help for a line without a command.
fn one_sentence(error: &clap::Error) -> String {
    let text = error.render().to_string();
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return text;
    }
    let paragraphs = text.split("\n\n");
    let about_it = paragraphs.take_while(|part| !part.starts_with("Usage") && !part.starts_with("For more"));
    let lines = about_it.map(|part| part.split_whitespace().collect::<Vec<_>>().join(" "));
    format!("{} (--help lists the options)", lines.collect::<Vec<_>>().join("; "))
}

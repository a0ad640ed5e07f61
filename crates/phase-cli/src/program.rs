//! From a command line to an exit code.

use crate::{
    console::print_message,
    context::{Context, Program, Verbosity},
};
use clap::{Parser, error::ErrorKind};
use std::{error::Error, ffi::OsString, process::ExitCode};

/// The commands of a program.
pub trait Interface: Parser {
    /// Why a command fails.
    type Error: Failure;

    /// The program's verbosity.
    fn verbosity(&self) -> Verbosity;

    /// Runs the command that was parsed.
    ///
    /// # Errors
    /// If it fails.
    fn run(&self, context: &Context) -> Result<(), Self::Error>;
}

/// An error that decides the exit code of a program.
pub trait Failure: Error {
    /// 2 for something about the input or output folder, 130 for an interruption, 1 for everything else.
    fn exit_code(&self) -> u8;
}

/// Runs a command line, program name first, and returns its exit code.
pub fn main_with<I: Interface>(program: Program, arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let command = I::command().name(program.name).bin_name(program.name);
    let parsed = command.try_get_matches_from(arguments);
    match parsed.and_then(|matches| I::from_arg_matches(&matches)) {
        Ok(interface) => {
            let context = Context { program, verbosity: interface.verbosity() };
            match interface.run(&context) {
                Ok(()) => ExitCode::SUCCESS,
                Err(error) => {
                    print_message(format!("error: {error}"));
                    causes(&error).for_each(|cause| context.detail(format!("  caused by: {cause}")));
                    ExitCode::from(error.exit_code())
                }
            }
        }
        Err(error) if !error.use_stderr() => {
            // Help or version was requested; a closed pipe is not reported.
            let _ = error.print();
            ExitCode::SUCCESS
        }
        Err(error) => {
            print_message(one_sentence(&error));
            ExitCode::from(2)
        }
    }
}

/// The chain of causes of an error, nearest first.
fn causes(error: &dyn Error) -> impl Iterator<Item = &(dyn Error + 'static)> {
    std::iter::successors(error.source(), |cause| (*cause).source())
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

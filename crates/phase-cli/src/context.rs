//! What every command is given beside its own options.

use crate::{console::print_message, progress::Progress};
use clap::Args;
use std::fmt::Display;

/// A program that runs the commands of this crate, as its messages name it.
#[derive(Clone, Copy, Debug)]
pub struct Program {
    /// What is typed to start it.
    pub name: &'static str,
    /// What to do for neural networks where it was built without them.
    pub networks_hint: &'static str,
    /// The command line that completions and man pages are made for.
    pub interface: fn() -> clap::Command,
}

/// How much is said on stderr; results on stdout do not depend on it.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct Verbosity {
    /// Print nothing but errors on stderr: no progress and no notes
    #[arg(long, short, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Print more on stderr: the settings in effect, what was rejected and why, and the causes of an error
    #[arg(long, short, global = true)]
    pub verbose: bool,
}

/// What every command is given beside its own options.
#[derive(Clone, Copy, Debug)]
pub struct Context {
    /// The program that was started.
    pub program: Program,
    /// How much it says.
    pub verbosity: Verbosity,
}

impl Context {
    /// Says something worth knowing, on stderr, unless told to be quiet.
    pub fn note(&self, line: impl Display) {
        if !self.verbosity.quiet {
            print_message(line);
        }
    }

    /// Says something of interest to few, on stderr, if told to be verbose.
    pub fn detail(&self, line: impl Display) {
        if self.verbosity.verbose {
            print_message(line);
        }
    }

    /// Progress over events that take at most `steps_each` steps each. `activity` says what goes on, such as
    /// `simulating 12 events`.
    #[must_use]
    pub fn progress(&self, activity: &str, events: usize, steps_each: usize) -> Progress {
        Progress::new(activity, events, events * steps_each, steps_each, self.verbosity.quiet)
    }

    /// Progress over so many steps that belong to no event in particular.
    #[must_use]
    pub fn progress_over(&self, activity: &str, steps: usize) -> Progress {
        Progress::new(activity, 0, steps, 0, self.verbosity.quiet)
    }
}

//! Context of every command beside its own options.

use crate::{console::print_message, progress::Progress};
use clap::Args;
use phase_runs::listener::{self, Listener, Work};
use std::fmt::Display;

/// A program that runs the commands of this crate, as named in its messages.
#[derive(Clone, Copy, Debug)]
pub struct Program {
    /// The command that starts it.
    pub name: &'static str,
    /// Instructions for neural networks if it was built without them.
    pub networks_hint: &'static str,
    /// Instructions for the server and rating studies if it was built without them.
    pub serve_hint: &'static str,
    /// The command line for which completions and man pages are generated.
    pub interface: fn() -> clap::Command,
}

/// Verbosity on stderr; results on stdout do not depend on it.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct Verbosity {
    /// Print nothing but errors on stderr: no progress and no notes
    #[arg(long, short, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Print more on stderr: the settings in effect, what was rejected and why, and the causes of an error
    #[arg(long, short, global = true)]
    pub verbose: bool,
}

/// Context of every command beside its own options.
#[derive(Clone, Copy, Debug)]
pub struct Context {
    /// The program that was started.
    pub program: Program,
    /// Its verbosity.
    pub verbosity: Verbosity,
}

impl Context {
    /// Prints a note on stderr, unless `--quiet` is given.
    pub fn note(&self, line: impl Display) {
        if !self.verbosity.quiet {
            print_message(line);
        }
    }

    /// Prints details on stderr, if `--verbose` is given.
    pub fn detail(&self, line: impl Display) {
        if self.verbosity.verbose {
            print_message(line);
        }
    }

    /// Progress over events that take at most `steps_each` steps each. `activity` describes the work, such as
    /// `simulating 12 events`.
    #[must_use]
    pub fn progress(&self, activity: &str, events: usize, steps_each: usize) -> Progress {
        Progress::new(activity, events, events * steps_each, steps_each, self.verbosity.quiet)
    }

    /// Progress over the given number of steps that do not belong to a particular event.
    #[must_use]
    pub fn progress_over(&self, activity: &str, steps: usize) -> Progress {
        Progress::new(activity, 0, steps, 0, self.verbosity.quiet)
    }
}

impl Listener for Context {
    fn note(&self, line: &str) {
        Self::note(self, line);
    }

    fn detail(&self, line: &str) {
        Self::detail(self, line);
    }

    fn begin(&self, work: &Work<'_>) -> Box<dyn listener::Progress> {
        let Work { activity, events, steps, steps_each } = *work;
        Box::new(Progress::new(activity, events, steps, steps_each, self.verbosity.quiet))
    }
}

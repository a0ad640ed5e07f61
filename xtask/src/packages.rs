//! Commands of the packages below `xtask/`, which are built only when one of them is asked for.

use crate::{error::XtaskError, results::root};
use clap::{Arg, ArgAction, ArgMatches, Command, FromArgMatches, Subcommand, builder::ValueParser};
use phase_cli::context::Verbosity;
use std::{env, ffi::OsString, process};

/// Packages with their commands and what `--help` says of each.
pub const PACKAGES: [(&str, &[(&str, &str)]); 4] = [
    (
        "phase-lab",
        &[
            ("check-behaviour", "Measure how reliably agents show the intended behaviour"),
            ("check-forecasts", "Divide the error of forecasts into inference, minds and chance"),
            ("check-minds", "Compare minds with the agents of recordings or events whose labels are known"),
            ("check-physics", "Compare an engine of the physics with recorded motion"),
            (
                "check-search",
                "Compare the decisions of short searches with those of a long one, by the priors of their root",
            ),
            (
                "check-track",
                "Compare tracks with the motion in videos of known events that are drawn in several styles",
            ),
            ("fit-beliefs", "Fit how strongly actions tell SIMPLE what agents know"),
            ("fit-forecast", "Fit how SIMPLE combines simulated futures"),
            ("fit-inference", "Fit how SIMPLE weighs its evidence to events whose labels are known"),
            ("fit-intents", "Fit what SIMPLE takes neutral agents to know of the other's goal"),
            ("fit-minds", "Fit the parameters of the minds to recordings or events whose labels are known"),
            ("fit-reports", "Fit how people report what they saw to raters of recordings"),
            ("fit-selection", "Measure in recordings what selection limits and how two part who get nowhere"),
        ],
    ),
    (
        "phase-torture",
        &[
            ("check-verify", "Edit a dataset many times, and count what verify finds"),
            ("torture", "Stop commands while they write, and check that nothing is lost"),
        ],
    ),
    (
        "phase-fuzz",
        &[
            (
                "check-engines",
                "Look for energy from nowhere, overlaps and other oddities of both engines in random scenes",
            ),
            ("fuzz", "Run readers, engines, planner and searches on mutated inputs"),
        ],
    ),
    (
        "phase-golden",
        &[("golden", "Run the golden tests of all crates, or rewrite the values that they compare with")],
    ),
];
/// The package that has xtask's feature `networks`, too.
const WITH_NETWORKS: &str = "phase-torture";
/// Name of the words that are handed on.
const WORDS: &str = "words";

/// A command line for one of the packages.
#[derive(Debug)]
pub struct Elsewhere {
    package: &'static str,
    command: &'static str,
    words: Vec<OsString>,
}

impl Elsewhere {
    /// Builds the package if need be, and runs the command in it. On Unix it takes the place of this program,
    /// so that signals and the exit code are its own; elsewhere this program ends with its exit code.
    ///
    /// # Errors
    /// If cargo cannot be started.
    pub fn run(&self, verbosity: Verbosity) -> Result<(), XtaskError> {
        // Cargo names the executable that started this one.
        let mut cargo = process::Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo.args(["run", "--package", self.package, "--manifest-path"]).arg(root().join("Cargo.toml"));
        cargo.args((!cfg!(debug_assertions)).then_some("--release"));
        if cfg!(feature = "networks") && self.package == WITH_NETWORKS {
            cargo.args(["--features", "networks"]);
        }
        cargo.args(["--", self.command]).args(&self.words);
        let given = [(verbosity.quiet, "--quiet"), (verbosity.verbose, "--verbose")];
        cargo.args(given.into_iter().filter_map(|(given, word)| given.then_some(word)));
        Err(XtaskError::Cargo(become_it(cargo)))
    }
}

#[cfg(unix)]
fn become_it(mut command: process::Command) -> std::io::Error {
    std::os::unix::process::CommandExt::exec(&mut command)
}

#[cfg(not(unix))]
fn become_it(mut command: process::Command) -> std::io::Error {
    match command.status() {
        Ok(status) => process::exit(status.code().unwrap_or(1)),
        Err(error) => error,
    }
}

/// The package of a command, with the command's name.
fn owner(name: &str) -> Option<(&'static str, &'static str)> {
    let commands =
        PACKAGES.iter().flat_map(|(package, commands)| commands.iter().map(move |it| (*package, it.0)));
    commands.into_iter().find(|(_, command)| *command == name)
}

/// A command line in which `help COMMAND` is `COMMAND --help` where a package has the command.
pub(crate) fn with_help(words: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let mut words: Vec<OsString> = words.into_iter().collect();
    if let [_, help, command] = &mut words[..]
        && help == "help"
        && command.to_str().is_some_and(|name| owner(name).is_some())
    {
        std::mem::swap(help, command);
        *command = "--help".into();
    }
    words
}

impl FromArgMatches for Elsewhere {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let unknown = || clap::Error::new(clap::error::ErrorKind::InvalidSubcommand);
        let (name, matches) = matches.subcommand().ok_or_else(unknown)?;
        let (package, command) = owner(name).ok_or_else(unknown)?;
        let words = matches.get_many(WORDS).into_iter().flatten().cloned().collect();
        Ok(Self { package, command, words })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Subcommand for Elsewhere {
    fn augment_subcommands(program: Command) -> Command {
        let commands = PACKAGES.iter().flat_map(|(_, commands)| commands.iter());
        program.subcommands(commands.map(|&(name, about)| {
            // The package understands the words, `--help` among them.
            let words = Arg::new(WORDS).action(ArgAction::Append).num_args(0..).trailing_var_arg(true);
            let words = words.allow_hyphen_values(true).value_parser(ValueParser::os_string());
            Command::new(name).about(about).disable_help_flag(true).arg(words)
        }))
    }

    fn augment_subcommands_for_update(program: Command) -> Command {
        Self::augment_subcommands(program)
    }

    fn has_subcommand(name: &str) -> bool {
        owner(name).is_some()
    }
}

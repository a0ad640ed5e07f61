//! The commands of `phase`. The options of each are defined beside its implementation.

use crate::{
    benchmark::{self, options::Benchmark},
    completions::{self, Completions},
    context::Context,
    error::CliError,
    eval::{self, options::Eval},
    export::{self, Export},
    gen_dataset::{
        self,
        options::{GenDataset, Merge},
    },
    laboratory::{
        self, AreaOptions, ClipOptions, ObserveOptions,
        sets::{self, MatrixOptions, PackOptions, PairingOptions},
    },
    man::{self, ManPages},
    narrate::{self, Narrate},
    new_scene::{self, options::NewScene},
    playground::{self, Playground},
    program::{CommandLine, Interface},
    questions::{self, Questions, ScoreOptions},
    render::{self, Render},
    seal::{self, SealOptions, UnsealOptions},
    serve::{self, options::Serve},
    simulate::{self, options::Simulate},
    splits::{self, Splits},
    stats::{self, Stats},
    study::{self, options::Study},
    submit::{self, Submit},
    track::{self, TrackOptions},
    train::{self, options::Train},
    verify::{self, options::Verify},
};
use clap::Subcommand;

/// The command line.
pub type Cli = CommandLine<Command>;

/// Command to carry out.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Write an initial scene, with comments, for simulate
    NewScene(NewScene),
    /// Generate a dataset of social events, with videos and a page to view them
    GenDataset(GenDataset),
    /// Merge the shards of a dataset
    Merge(Merge),
    /// Export a dataset as WebDataset: tar files that are read from the first byte to the last
    Export(Export),
    /// Check how a dataset is divided into train, validation and test, or divide it
    Splits(Splits),
    /// Compare the figures of the paper's dataset with those of another, and plot them
    Stats(Stats),
    /// Simulate the scenes of a phase-events/1 file, each from its first row
    Simulate(Simulate),
    /// Check that a dataset is complete: all checksums, no extra files, and that its files agree
    Verify(Verify),
    /// Turn events into videos, or into pictures of their key frames
    Render(Render),
    /// Read the motion of bodies in videos, pictures or tables as events without labels
    Track(TrackOptions),
    /// Tell in words what happens in events
    Narrate(Narrate),
    /// Cut clips of one length out of events, as videos, frames or GIFs, with their labels
    Clip(ClipOptions),
    /// Write what SIMPLE makes of events, and their motion, in chunks of time, as tables of regressors (BIDS)
    Observe(ObserveOptions),
    /// Write where bodies and landmarks are in every frame, as areas of interest for eye tracking
    Aoi(AreaOptions),
    /// Make dissimilarity matrices of answers, ratings and other features, and correlate them
    Rdm(MatrixOptions),
    /// Find events of different kinds that are alike in low-level motion
    Match(PairingOptions),
    /// Pack videos for PsychoPy, Pavlovia, Gorilla, Children Helping Science or Qualtrics
    Pack(PackOptions),
    /// Make a benchmark of questions about events, in the forms that evaluators of other models read
    Questions(Questions),
    /// Score answers to a benchmark of questions
    Score(ScoreOptions),
    /// Publish the motion of a dataset, and digests of its labels, so that nobody can look them up
    Seal(SealOptions),
    /// Prove that published motion and questions are those of a dataset that was sealed
    Unseal(UnsealOptions),
    /// Evaluate how well a method perceives events: recognises goals and relations, or predicts trajectories
    #[command(subcommand)]
    Eval(Eval),
    /// Train a neural network on a dataset
    #[command(subcommand)]
    Train(Train),
    /// Evaluate all methods at both tasks and compare them with published results, in one report
    Benchmark(Benchmark),
    /// Check and score the answers of a method, and write the files of a pull request for the leaderboard
    Submit(Submit),
    /// Write the playground, a page on which minds play in a browser, as static files
    Playground(Playground),
    /// Prepare a rating study of videos, export its answers, or analyse them
    #[command(subcommand)]
    Study(Study),
    /// Serve the playground, the two-player game and what belongs to them to browsers
    Serve(Serve),
    /// Print a script with which a shell completes the commands and options of phase
    Completions(Completions),
    /// Write the manual pages of phase
    Man(ManPages),
}

impl Interface for Command {
    type Error = CliError;

    const ABOUT: &'static str = "Physically grounded social events: two agents see, believe, plan and act";

    fn run(&self, context: &Context) -> Result<(), CliError> {
        match self {
            Self::NewScene(arguments) => new_scene::run(arguments, context),
            Self::GenDataset(arguments) => gen_dataset::run(arguments, context),
            Self::Verify(arguments) => verify::run(arguments, context),
            Self::Merge(arguments) => gen_dataset::run_merge(arguments, context),
            Self::Export(arguments) => export::run(arguments, context),
            Self::Splits(arguments) => splits::run(arguments, context),
            Self::Stats(arguments) => stats::run(arguments, context),
            Self::Simulate(arguments) => simulate::run(arguments, context),
            Self::Render(arguments) => render::run(arguments, context),
            Self::Track(arguments) => track::run(arguments, context),
            Self::Narrate(arguments) => narrate::run(arguments, context),
            Self::Clip(arguments) => laboratory::clip(arguments, context),
            Self::Observe(arguments) => laboratory::observe(arguments, context),
            Self::Aoi(arguments) => laboratory::areas(arguments, context),
            Self::Rdm(arguments) => sets::matrices(arguments, context),
            Self::Match(arguments) => sets::pairing(arguments, context),
            Self::Pack(arguments) => sets::pack(arguments, context),
            Self::Questions(arguments) => questions::questions(arguments, context),
            Self::Score(arguments) => questions::score(arguments, context),
            Self::Seal(arguments) => seal::run(arguments, context),
            Self::Unseal(arguments) => seal::run_unseal(arguments, context),
            Self::Eval(arguments) => eval::run(arguments, context),
            Self::Train(arguments) => train::run(arguments, context),
            Self::Benchmark(arguments) => benchmark::run(arguments, context),
            Self::Submit(arguments) => submit::run(arguments, context),
            Self::Playground(arguments) => playground::run(arguments, context),
            Self::Study(arguments) => study::run(arguments, context),
            Self::Serve(arguments) => serve::run(arguments, context),
            Self::Completions(arguments) => completions::run(arguments, context),
            Self::Man(arguments) => man::run(arguments, context),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Cli;
    use clap::{Command, CommandFactory, error::ErrorKind};

    /// Options that name something by a number, or take numbers that are not bounded: seeds, shares of a
    /// whole, amounts beyond which nothing changes.
    const WITHOUT_BOUNDS: [&str; 10] = [
        "seed",
        "resimulate",
        "resimulate-seed",
        "shard",
        "id",
        "belief",
        "videos",
        "catch",
        "watched",
        "time-units",
    ];

    fn leaves(command: &Command, words: &[String], found: &mut Vec<(Vec<String>, Command)>) {
        if !command.has_subcommands() {
            found.push((words.to_vec(), command.clone()));
        }
        for below in command.get_subcommands() {
            let words: Vec<String> = words.iter().cloned().chain([below.get_name().to_owned()]).collect();
            leaves(below, &words, found);
        }
    }

    /// Every option that takes a number says in its help which ones, and takes no others.
    #[test]
    fn the_help_of_a_number_states_its_bounds() {
        let mut found = Vec::new();
        leaves(&Cli::command(), &["phase".into()], &mut found);
        let mut checked = 0;
        for (words, command) in found {
            let is_refused = |option: &str, value: &str| {
                let line = words.iter().cloned().chain([format!("--{option}={value}")]);
                let refused = Cli::command().try_get_matches_from(line);
                refused.is_err_and(|error| error.kind() == ErrorKind::ValueValidation)
            };
            for argument in command.get_arguments() {
                let Some(option) = argument.get_long().filter(|name| !WITHOUT_BOUNDS.contains(name)) else {
                    continue;
                };
                if !argument.get_action().takes_values()
                    || is_refused(option, "1") && is_refused(option, "5")
                    || !is_refused(option, "x")
                {
                    continue;
                }
                let help = argument.get_help().map(ToString::to_string).unwrap_or_default();
                let words: Vec<&str> = help.split([' ', ',', ';', ':']).collect();
                let bounds = words.windows(3).find_map(|three| match three {
                    [low, "to", high] => Some((low.parse::<u64>().ok()?, high.parse::<u64>().ok()?)),
                    _ => None,
                });
                let (low, high) = bounds.unwrap_or_else(|| panic!("--{option} has no bounds: {help}"));
                for (value, fits) in [(low, true), (high, true), (high + 1, false)] {
                    let refused = is_refused(option, &value.to_string());
                    assert_eq!(refused, !fits, "--{option}={value} and its help: {help}");
                }
                assert!(low == 0 || is_refused(option, &(low - 1).to_string()), "--{option}: {help}");
                checked += 1;
            }
        }
        assert!(checked > 20, "{checked}");
    }
}

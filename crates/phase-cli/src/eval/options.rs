//! The options of `eval`.

use crate::{effort::MindOptions, json_file::JsonFile, named::named, parallel::Jobs, shard_option::shard};
use clap::{Args, Subcommand, builder::PossibleValuesParser, value_parser};
use phase_dataset::splits::Split;
use phase_event::BeliefOrder;
use phase_runs::eval::{Answers, Evaluation, methods};
use std::path::PathBuf;

/// Task to evaluate.
#[derive(Subcommand, Debug)]
pub enum Eval {
    /// Task 1 of the paper: accuracy of recognised goals and relations
    Goals(EvalGoals),
    /// Task 2 of the paper: errors of predicted trajectories, 20 steps after the first 20
    Trajectories(EvalTrajectories),
    /// Places at which agents believe entities to be, in simulated events
    Beliefs(EvalBeliefs),
    /// Intents that agents which do not know them take each other to have, in simulated events
    Intents(EvalIntents),
}

/// Options of `eval goals`.
#[derive(Args, Debug)]
pub struct EvalGoals {
    /// The method to measure
    #[arg(long, value_name = "METHOD", value_parser = PossibleValuesParser::new(methods::recognisers()),
          required_unless_present = "predictions")]
    pub method: Option<String>,
    /// Also ask the method after the given numbers of seconds of each event, up to 3600, such as
    /// 5,10,15,20; each takes as long again
    #[arg(
        long,
        value_name = "SECONDS",
        value_delimiter = ',',
        value_parser = seconds,
        conflicts_with = "predictions"
    )]
    pub watched: Vec<f64>,
    /// Ratings by people of the relations of the events (phase-ratings/1; see
    /// docs/reference/formats/studies.md): also report how closely the method's probabilities agree with them
    #[arg(long, value_name = "FILE")]
    pub ratings: Option<PathBuf>,
    /// Other answers.
    #[command(flatten)]
    pub others: Others,
    /// Events and output.
    #[command(flatten)]
    pub common: Common,
}

/// Options of `eval trajectories`.
#[derive(Args, Debug)]
pub struct EvalTrajectories {
    /// The method to measure
    #[arg(long, value_name = "METHOD", value_parser = PossibleValuesParser::new(methods::FORECASTERS),
          required_unless_present = "predictions")]
    pub method: Option<String>,
    /// Other answers.
    #[command(flatten)]
    pub others: Others,
    /// Events and output.
    #[command(flatten)]
    pub common: Common,
}

/// Options of `eval beliefs`.
#[derive(Args, Debug)]
pub struct EvalBeliefs {
    /// The method to measure: simple, the belief network, or a rule: the room where the agent that believes
    /// could last see an entity, where (with --order 2) the agent that ascribes the belief could, where it is
    /// now, or where it was at the start
    #[arg(long, value_name = "METHOD", value_parser = PossibleValuesParser::new(methods::BELIEF_READERS))]
    pub method: String,
    /// Order of the beliefs, 1 to 2: where each agent believes each entity to be, or where it believes the
    /// other to believe it
    #[arg(long, value_name = "1|2", default_value_t = 1, value_parser = value_parser!(u8).range(1..=2))]
    pub order: u8,
    /// The weights of the belief network (safetensors, as `train` writes them) [default: those that come
    /// with the program]
    #[arg(long, value_name = "FILE")]
    pub weights: Option<PathBuf>,
    /// Events and output.
    #[command(flatten)]
    pub common: Common,
}

/// Options of `eval intents`.
#[derive(Args, Debug)]
pub struct EvalIntents {
    /// The method to measure: simple-knowledge; simple, which takes every agent to know what the other wants;
    /// or even, for which all intents are as likely
    #[arg(long, value_name = "METHOD", value_parser = PossibleValuesParser::new(methods::INTENT_READERS))]
    pub method: String,
    /// Events and output.
    #[command(flatten)]
    pub common: Common,
}

/// Options of the tasks of the paper, about other answers than those of SIMPLE and rules.
#[derive(Args, Debug, Default)]
pub struct Others {
    /// The weights of a neural network (safetensors, as `train` writes them) [default: those that come with
    /// the program]
    #[arg(long, value_name = "FILE", conflicts_with = "predictions")]
    pub weights: Option<PathBuf>,
    /// Score the answers in this file instead of asking a method (`events` as in results.json; see
    /// docs/reference/formats/evaluation.md)
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all =
            ["method", "minds", "one_way_turns", "strongest_coasts", "original_random", "simulations"]
    )]
    pub predictions: Option<PathBuf>,
    /// Also print the differences from another method, with intervals: its results.json for the same events.
    /// May be given several times
    #[arg(long, value_name = "FILE", conflicts_with = "shard")]
    pub compare: Vec<PathBuf>,
}

/// Options of all tasks.
#[derive(Args, Debug)]
pub struct Common {
    /// The minds that SIMPLE imagines.
    #[command(flatten)]
    pub minds: MindOptions,
    /// A file in the format phase-events/1, or the folder of a dataset or of simulations
    #[arg(long, value_name = "FILE|DIR")]
    pub events: PathBuf,
    /// Only this part of a dataset: train, validation or test
    #[arg(long, value_name = "SPLIT", hide_possible_values = true,
        value_parser = named(Split::ALL, Split::name))]
    pub split: Option<Split>,
    /// Only the first N events, 1 to 1000000000
    #[arg(long, value_name = "N", value_parser = value_parser!(u64).range(1..=1_000_000_000))]
    pub limit: Option<u64>,
    /// Random seed of the method and the intervals
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// The results as JSON.
    #[command(flatten)]
    pub json: JsonFile,
    /// Folder for results and report; new, empty, or of the same run [default: out/eval/TASK-METHOD-EVENTS]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Part of the events, and the parts that are merged.
    #[command(flatten)]
    pub parts: Parts,
    /// Number of events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// An evaluation in several parts, on as many machines.
#[derive(Args, Clone, Debug, Default)]
pub struct Parts {
    /// Ask the method about the events K, K + N, K + 2 N … only, and report nothing. The same command with
    /// --merge instead combines all parts. In a task of a job array K may be `auto`, as for gen-dataset
    #[arg(long, value_name = "K/N", value_parser = shard)]
    pub shard: Option<(usize, usize)>,
    /// Take the answers from the folders of all shards instead of asking the method. Results are those of a
    /// single run, byte for byte
    #[arg(long, value_name = "DIR", num_args = 1.., conflicts_with = "shard")]
    pub merge: Vec<PathBuf>,
}

impl EvalBeliefs {
    /// The beliefs to ask about.
    pub(super) const fn order(&self) -> BeliefOrder {
        if self.order == 1 { BeliefOrder::First } else { BeliefOrder::Second }
    }
}

impl Eval {
    /// The name of the task.
    pub(super) const fn task(&self) -> &'static str {
        match self {
            Self::Goals(_) => "goals",
            Self::Trajectories(_) => "trajectories",
            Self::Beliefs(_) => "beliefs",
            Self::Intents(_) => "intents",
        }
    }

    /// The options of all tasks.
    pub(super) const fn common(&self) -> &Common {
        match self {
            Self::Goals(options) => &options.common,
            Self::Trajectories(options) => &options.common,
            Self::Beliefs(options) => &options.common,
            Self::Intents(options) => &options.common,
        }
    }

    /// The files and folders that are read.
    pub(super) fn inputs(&self) -> Vec<&PathBuf> {
        let (others, more) = match self {
            Self::Goals(options) => (Some(&options.others), options.ratings.as_ref()),
            Self::Trajectories(options) => (Some(&options.others), None),
            Self::Beliefs(options) => (None, options.weights.as_ref()),
            Self::Intents(_) => (None, None),
        };
        let of_others = others
            .into_iter()
            .flat_map(|others| others.weights.iter().chain(&others.predictions).chain(&others.compare));
        let common = self.common();
        [&common.events].into_iter().chain(&common.parts.merge).chain(more).chain(of_others).collect()
    }

    /// The results of other methods to compare with.
    pub(super) fn compare(&self) -> &[PathBuf] {
        match self {
            Self::Goals(EvalGoals { others, .. }) | Self::Trajectories(EvalTrajectories { others, .. }) => {
                &others.compare
            }
            Self::Beliefs(_) | Self::Intents(_) => &[],
        }
    }
}

impl From<&Eval> for Evaluation {
    fn from(options: &Eval) -> Self {
        let common = options.common();
        let (watched, ratings) = match options {
            Eval::Goals(options) => (options.watched.clone(), options.ratings.clone()),
            Eval::Trajectories(_) | Eval::Beliefs(_) | Eval::Intents(_) => (Vec::new(), None),
        };
        Self {
            split: common.split,
            limit: common.limit.map(|limit| limit as usize),
            seed: common.seed,
            out: common.out.clone(),
            watched,
            ratings,
            shard: common.parts.shard,
            merge: common.parts.merge.clone(),
            threads: common.jobs.given(),
            ..Self::new(&common.events)
        }
    }
}

impl From<&Eval> for Answers {
    fn from(options: &Eval) -> Self {
        let minds = options.common().minds.into();
        let (method, weights, predictions) = match options {
            Eval::Beliefs(options) => (Some(&options.method), options.weights.clone(), None),
            Eval::Intents(options) => (Some(&options.method), None, None),
            Eval::Goals(EvalGoals { method, others, .. })
            | Eval::Trajectories(EvalTrajectories { method, others, .. }) => {
                (method.as_ref(), others.weights.clone(), others.predictions.clone())
            }
        };
        match predictions {
            Some(file) => Self::Predictions(file),
            None => Self::Method { name: method.cloned().unwrap_or_default(), weights, minds },
        }
    }
}

/// Reads a number of seconds after which an event has a row.
fn seconds(text: &str) -> Result<f64, String> {
    let rule = || format!("must be above 0, at most 3600 and a multiple of 0.25, not {text:?}");
    let number: f64 = text.trim().parse().map_err(|_| rule())?;
    let fits = number > 0.0 && number <= 3600.0 && (number * 4.0).fract() == 0.0;
    fits.then_some(number).ok_or_else(rule)
}

//! `questions` and `score`: a benchmark of questions about events, and the score of answers.

use crate::{
    context::Context, error::CliError, eval::require_networks, interrupt, named::named, output::Output,
    parallel::Jobs,
};
use clap::{Args, builder::PossibleValuesParser, value_parser};
use phase_dataset::splits::Split;
use phase_questions::Row;
use phase_runs::{
    eval::{methods::recognisers, networks::is_network},
    questions::{Asked, QuestionRun, Scored, answerers, score_file},
};
use serde_json::json;
use std::{collections::BTreeMap, fmt::Write as _, path::PathBuf};

/// Options of `questions`.
#[derive(Args, Debug)]
pub struct Questions {
    /// Datasets (those of minimal pairs also give questions about two videos), or files in the format
    /// phase-events/1
    #[arg(value_name = "DIR|FILE", required = true)]
    pub events: Vec<PathBuf>,
    /// Only the events of this part, of datasets that are divided
    #[arg(long, value_name = "SPLIT", value_parser = named(Split::ALL, Split::name))]
    pub split: Option<Split>,
    /// Ratings of the events by people, in the format phase-ratings/1: they give the share of people for
    /// each option
    #[arg(long, value_name = "FILE")]
    pub ratings: Option<PathBuf>,
    /// Method that certifies how many frames questions about goals and relations need; `simple` takes
    /// about a second for each event and number of frames
    #[arg(
        long,
        value_name = "METHOD",
        default_value = "intent-network",
        value_parser = PossibleValuesParser::new(recognisers())
    )]
    pub certify: String,
    /// Methods whose answers are written, too, separated by commas, to the types of questions that they
    /// judge; `guess` is a random forest that is given the words, or the words and the first frame, and
    /// `rules` answers what motion shows
    #[arg(
        long,
        value_name = "METHODS",
        value_delimiter = ',',
        value_parser = PossibleValuesParser::new(answerers())
    )]
    pub answers: Vec<String>,
    /// Most questions of each type, 1 to 1000000; others are left out at random
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=1_000_000))]
    pub per_type: Option<u32>,
    /// Side of the pictures in pixels, 64 to 2000, even
    #[arg(long, value_name = "N", default_value_t = 480, value_parser = value_parser!(u32).range(64..=2000))]
    pub size: u32,
    /// Write no videos
    #[arg(long, conflicts_with = "size")]
    pub no_video: bool,
    /// Random seed of words and orders
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Folder for the benchmark; new, empty, or of the same command
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
    /// Number of events at once.
    #[command(flatten)]
    pub jobs: Jobs,
}

/// Runs `questions`.
///
/// # Errors
/// Any [`CliError`].
pub fn questions(arguments: &Questions, context: &Context) -> Result<(), CliError> {
    if !arguments.size.is_multiple_of(2) {
        return Err(CliError::Usage(format!("--size {}: must be even", arguments.size)));
    }
    let mut methods = arguments.answers.iter().chain([&arguments.certify]);
    if methods.any(|method| is_network(method)) {
        require_networks(context)?;
    }
    interrupt::listen();
    let run = QuestionRun {
        events: arguments.events.clone(),
        split: arguments.split,
        ratings: arguments.ratings.clone(),
        certify: arguments.certify.clone(),
        answers: arguments.answers.clone(),
        per_type: arguments.per_type.map(|most| most as usize),
        side: if arguments.no_video { 0 } else { arguments.size },
        seed: arguments.seed,
        out: arguments.out.clone(),
        threads: arguments.jobs.threads(),
    };
    let Asked { types, videos, is_new } = run.run(context)?;
    let count: usize = types.iter().map(|(_, count)| count).sum();
    let out = arguments.out.display();
    let mut text = match is_new {
        true => format!("{count} questions about {videos} videos in {out}\n"),
        false => format!("{out} holds these {count} questions already\n"),
    };
    for (name, count) in types.iter().filter(|(_, count)| *count > 0) {
        let _ = writeln!(text, "  {name} {count}");
    }
    let missing: Vec<&str> = types.iter().filter(|(_, count)| *count == 0).map(|(name, _)| *name).collect();
    if !missing.is_empty() {
        let _ = writeln!(text, "none, because not every answer occurs: {}", missing.join(", "));
    }
    let types: BTreeMap<&str, usize> = types.into_iter().collect();
    arguments
        .output
        .print(text, &json!({ "questions": count, "videos": videos, "types": types, "new": is_new }))
}

/// Options of `score`.
#[derive(Args, Debug)]
pub struct ScoreOptions {
    /// Answers, one a line: {"id": …, "answer": …}, with `control` where something else than the video was
    /// shown, and `probabilities` of the options if they are known
    #[arg(value_name = "JSONL")]
    pub answers: PathBuf,
    /// The folder of the benchmark, or its questions.jsonl
    #[arg(long, value_name = "DIR|FILE")]
    pub questions: PathBuf,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Runs `score`.
///
/// # Errors
/// Any [`CliError`].
pub fn score(arguments: &ScoreOptions, _context: &Context) -> Result<(), CliError> {
    let Scored { score, answers, questions } = score_file(&arguments.answers, &arguments.questions)?;
    let mut text =
        format!("{answers} answers to {questions} questions, {} of them unreadable\n\n", score.unreadable);
    text += "| shown | questions | right | accuracy | 95 % interval | chance |\n|---|---|---|---|---|---|\n";
    for Row { control, group, accuracy: it } in &score.rows {
        let _ = writeln!(
            text,
            "| {control} | {group} | {} of {} | {:.3} | {:.3} to {:.3} | {:.3} |",
            it.right, it.of, it.accuracy, it.low, it.high, it.chance
        );
    }
    if let Some(sets) = &score.sets {
        let _ = writeln!(text, "\nSets of which every relation is right: {} of {}", sets.right, sets.of);
    }
    if let Some(pairs) = &score.belief_pairs {
        let _ = writeln!(text, "\nPairs of beliefs of which both are right: {} of {}", pairs.right, pairs.of);
    }
    if let (Some(cross), Some(own)) = (score.cross_entropy, score.human_entropy) {
        let _ = writeln!(text, "\nCross-entropy against people: {cross:.3} nat (at least {own:.3})");
    }
    arguments.output.print(text, &json!({ "answers": answers, "questions": questions, "score": score }))
}

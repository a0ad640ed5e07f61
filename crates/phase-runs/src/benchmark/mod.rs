//! `benchmark`: every method at both tasks, compared with published results, in one report.
//!
//! [`plan`] selects the methods, `rows` has each of them evaluated, exactly as `eval` would, and the results
//! are combined in one report. Evaluations stay in their folders, so a benchmark can be interrupted and
//! resumed.

pub mod options;
pub mod plan;
mod rows;

use crate::{
    context::Context,
    error::CliError,
    eval::{networks, task},
};
use options::Benchmark;
use phase_files::{
    WriteError, atomic,
    folder::{self, Contents, Folder},
    run::Run,
};
use phase_report::evaluation;
use plan::{entries, needs_networks};
use rows::Rows;
use serde_json::json;

/// The benchmark's figures; written last.
const BENCHMARK_FILE: &str = "benchmark.json";

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Benchmark, context: &Context) -> Result<(), CliError> {
    if needs_networks(arguments) {
        networks::require(context)?;
    }
    let entries = entries(arguments)?;
    let mut rows = Rows::open(arguments, context)?;
    for file in &arguments.results {
        rows.add_results(file)?;
    }
    let (out, run) = (&arguments.out, Run::new([("command", "benchmark".into())]));
    if let Contents::Unfinished(other) = folder::inspect(out, BENCHMARK_FILE)? {
        run.check(out, "an unfinished", &other)?;
    }
    // A part has no report.
    let folder = match arguments.parts.shard {
        None => Some(Folder::claim(out, &run)?),
        Some(_) => None,
    };
    let asked = entries.iter().map(|entry| (0..rows.sets()).filter(|&set| rows.asks(entry, set)).count());
    let (mut begun, all) = (0, asked.sum::<usize>());
    for entry in &entries {
        let training = match &entry.weights {
            Some(file) => Some(networks::training_of(file)?),
            None => networks::training(&entry.method)?,
        };
        let training = training.map(|training| rows.add_training(training));
        for set in 0..rows.sets() {
            if !rows.asks(entry, set) {
                continue;
            }
            begun += 1;
            context.note(format!("{begun} of {all}: {}, {}", entry.description(), rows.name(set)));
            rows.add(entry, training, set, context)?;
        }
    }
    if let Some((shard, of)) = arguments.parts.shard {
        let part = arguments.evaluations.display();
        let text =
            format!("part {shard} of {of} is in {part}; give the same command with --merge and all parts");
        return arguments
            .output
            .print(text, &json!({ "evaluations": arguments.evaluations, "shard": shard, "of": of }));
    }
    let benchmark = rows.finish();
    let document = evaluation::benchmark(&benchmark);
    task::write_report(out, &document)?;
    if let Some(file) = &arguments.figures {
        let text = evaluation::to_lines(&evaluation::figures(&benchmark));
        atomic::write(file, text.map_err(|error| WriteError::json(file, error))?.as_bytes())?;
    }
    atomic::write_json(&out.join(BENCHMARK_FILE), &benchmark)?;
    folder.map_or(Ok(()), Folder::finish)?;
    let report = out.join(task::REPORT_FILE);
    let text = format!("{}\nreport in {}", document.first_table().trim_end(), report.display());
    arguments.output.print(text, &benchmark)
}

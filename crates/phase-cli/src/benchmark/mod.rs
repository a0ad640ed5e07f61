//! `benchmark`: every method at both tasks, compared with published results, in one report.

pub mod options;

use crate::{context::Context, error::CliError, eval::require_networks, interrupt, json_file};
use options::Benchmark;
use phase_runs::{
    benchmark::BenchmarkRun,
    eval::{REPORT_FILE, methods},
};
use serde_json::json;

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Benchmark, context: &Context) -> Result<(), CliError> {
    let run = BenchmarkRun::from(arguments);
    let methods = &run.methods;
    let minds = methods.is_empty() || methods.iter().any(|method| methods::has_minds(method));
    if run.minds.is_some() && !minds {
        return Err(CliError::Usage("--minds: none of the methods has minds".into()));
    }
    if run.needs_networks() {
        require_networks(context)?;
    }
    if let Some(file) = &run.figures {
        let alone = run.real.iter().chain(&run.ratings).chain(&run.pairs);
        let several = run.trained.iter().chain(&run.results).chain(&run.merge);
        json_file::check("--figures", file, [&run.data].into_iter().chain(alone).chain(several))?;
    }
    interrupt::listen();
    if let Some((benchmark, document)) = run.run(context)? {
        let report = run.out.join(REPORT_FILE);
        let text = format!("{}\nreport in {}", document.first_table().trim_end(), report.display());
        return arguments.output.print(text, &benchmark);
    }
    let (shard, of) = run.shard.unwrap_or((1, 1));
    let part = run.evaluations.display();
    let text = format!("part {shard} of {of} is in {part}; give the same command with --merge and all parts");
    let value = json!({ "evaluations": run.evaluations, "shard": shard, "of": of });
    arguments.output.print(text, &value)
}

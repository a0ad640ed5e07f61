//! `splits`: makes or checks the split of a dataset.

use crate::{context::Context, error::CliError, json_file, output::Output};
use clap::Args;
use phase_dataset::{
    split_list::SplitList,
    splits::{self, Rule},
};
use phase_files::{FileError, told};
use phase_runs::source::items_and_splits;
use serde_json::json;
use std::path::PathBuf;

/// Options of `splits`.
#[derive(Args, Debug)]
pub struct Splits {
    /// The folder of a dataset, or a file in the format phase-events/1
    #[arg(value_name = "DIR|FILE")]
    pub events: PathBuf,
    /// Check this split (phase-splits/1) instead of the dataset's own
    #[arg(long, value_name = "FILE", conflicts_with = "make")]
    pub splits: Option<PathBuf>,
    /// Divide the events and write the split (phase-splits/1) here
    #[arg(long, value_name = "FILE")]
    pub make: Option<PathBuf>,
    /// Random seed of the choices that the rules leave open, with --make
    #[arg(long, value_name = "S", default_value_t = 1, requires = "make", conflicts_with = "splits")]
    pub seed: u64,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Runs the command.
///
/// # Errors
/// Any [`CliError`]; [`CliError::RulesBroken`] if the split breaks a rule.
pub fn run(arguments: &Splits, context: &Context) -> Result<(), CliError> {
    if let Some(file) = &arguments.make {
        json_file::check("--make", file, [&arguments.events])?;
    }
    let (items, own) = items_and_splits(&arguments.events, context)?;
    let parts = match (&arguments.make, &arguments.splits) {
        (Some(file), _) => {
            let parts = splits::make(&items, arguments.seed);
            let list = SplitList::of(&items, &parts);
            list.write(file).map_err(CliError::Output)?;
            context.note(format!("{} made", file.display()));
            parts
        }
        (None, Some(file)) => SplitList::read(file)?
            .parts(&items)
            .map_err(|problem| FileError { file: file.clone(), problem })?,
        (None, None) => own.ok_or_else(|| {
            let place = arguments.events.display();
            CliError::Usage(format!(
                "{place}: is not divided into train, validation and test; use --make FILE or --splits FILE"
            ))
        })?,
    };
    let rules = splits::check(&items, &parts);
    let lines = rules.iter().map(line).collect::<Vec<_>>().join("\n");
    let text = format!("| rule | wanted | found | |\n|---|---|---|---|\n{lines}");
    let each = |rule: &Rule| {
        json!({
            "rule": rule.what, "wanted": rule.wanted, "found": rule.found, "met": rule.met(),
        })
    };
    let value = json!({
        "events": items.len(), "split": arguments.make.as_deref().map(told),
        "rules": rules.iter().map(each).collect::<Vec<_>>(),
    });
    arguments.output.print(text, &value)?;
    match rules.iter().filter(|rule| !rule.met()).count() {
        0 => Ok(()),
        broken => Err(CliError::RulesBroken { events: arguments.events.clone(), broken }),
    }
}

fn line(rule: &Rule) -> String {
    let verdict = if rule.met() { "met" } else { "broken" };
    format!("| {} | {} | {} | {verdict} |", rule.what, rule.wanted, rule.found)
}

//! `gen-dataset` and `merge`: generate a dataset, or one shard of it, from a preset and a seed, and combine
//! shards.

pub mod options;

use crate::{context::Context, error::CliError, interrupt, output::Output};
use options::{GenDataset, Merge};
use phase_dataset::manifest::{MANIFEST_FILE, PAGE_FILE};
use phase_files::told;
use phase_report::acceptance;
use phase_runs::{
    gen_dataset::{Generated, Generation, Outcome, complete::Completed, merge},
    words,
};
use serde_json::json;
use std::path::{Path, PathBuf};

/// Runs `gen-dataset`.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &GenDataset, context: &Context) -> Result<(), CliError> {
    interrupt::listen();
    let generated = Generation::from(arguments).run(context)?;
    announce(&generated, arguments.output, "")
}

/// Runs `merge`.
///
/// # Errors
/// Any [`CliError`].
pub fn run_merge(arguments: &Merge, context: &Context) -> Result<(), CliError> {
    interrupt::listen();
    let generated = merge::merge(&arguments.shards, &arguments.out, context)?;
    let more = format!("the {} shards are no longer needed", arguments.shards.len());
    announce(&generated, arguments.output, &more)
}

/// Prints what a finished dataset or shard contains, and how it was generated.
fn announce(generated: &Generated, output: Output, more: &str) -> Result<(), CliError> {
    let Generated { folder: out, events, outcome } = generated;
    let place = out.display();
    match outcome {
        Outcome::Made(completed) => announce_new(out, completed, output, more),
        Outcome::MadeShard(shard, of) => {
            let text = format!("{} in {place}; merge all {of} shards with merge", words::events(*events));
            let value =
                json!({ "folder": told(out), "events": events, "shard": shard, "of": of, "new": true });
            output.print(text, &value)
        }
        Outcome::Kept(what) => {
            let text = format!("{place} holds this {what} already; all {events} events are whole\n");
            let page = told_page(out);
            let value = json!({ "folder": told(out), "events": events, "page": page, "new": false });
            output.print(text + &page_line(out), &value)
        }
    }
}

fn announce_new(out: &Path, completed: &Completed, output: Output, more: &str) -> Result<(), CliError> {
    let Completed { overview, digest } = completed;
    let mut text = String::new();
    if !overview.selection.is_empty() {
        text += &format!("{}\n", acceptance::table(&overview.selection).trim_end());
    }
    let events = words::events(overview.events);
    text += &format!("{events} in {}\nSHA-256 of {MANIFEST_FILE}: {digest}\n", out.display());
    text += &format!("{}{more}", page_line(out));
    let value = json!({
        "folder": told(out), "events": overview.events, "seed": overview.seed, "page": told_page(out),
        "selection": overview.selection, "manifest_sha256": digest, "new": true,
    });
    output.print(text, &value)
}

/// The page on which the events can be watched, if they have videos.
fn page(out: &Path) -> Option<PathBuf> {
    Some(out.join(PAGE_FILE)).filter(|page| page.exists())
}

fn told_page(out: &Path) -> Option<String> {
    page(out).as_deref().map(told)
}

fn page_line(out: &Path) -> String {
    page(out).map_or_else(String::new, |page| format!("open {} to watch them\n", page.display()))
}

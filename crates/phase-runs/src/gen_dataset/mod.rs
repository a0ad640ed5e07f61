//! `gen-dataset`: generates a dataset, or one shard of it, from a preset and a seed.
//!
//! A dataset is a list of slots, each of which tries scenes until one shows its label ([`slot`]). The result
//! of a slot depends only on the dataset's seed and the slot's number, so threads, interruptions and shards
//! do not affect it. [`schedule`] decides what is done next, also ahead, and `crew` does it on several threads. When all slots are filled, [`mod@complete`] writes the files that describe the whole.

mod attempt;
pub mod complete;
mod crew;
pub mod merge;
pub mod options;
pub mod plan;
pub(crate) mod scenes;
pub mod schedule;
mod set;
pub mod slot;

use crate::{console, context::Context, error::CliError, interrupt, output::Output};
use complete::{Completed, complete};
use options::GenDataset;
use phase_dataset::{
    manifest::{MANIFEST_FILE, Manifest, PAGE_FILE},
    parquet,
    shard::{self, DatasetDescription, SHARD_FILE, Shard},
};
use phase_files::{
    folder::{self, Contents, Folder},
    run::Run,
};
use phase_report::acceptance;
use plan::Plan;
use serde_json::json;
use slot::{FilledSlots, Slots};
use std::path::{Path, PathBuf};

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &GenDataset, context: &Context) -> Result<(), CliError> {
    let plan = Plan::of(arguments)?;
    let out = arguments.out.clone().unwrap_or_else(|| plan.default_folder());
    let last_file = if plan.shard.is_some() { SHARD_FILE } else { MANIFEST_FILE };
    match folder::inspect(&out, last_file)? {
        Contents::Finished if plan.shard.is_some() => {
            return check_finished_shard(&plan, &out, arguments.output);
        }
        Contents::Finished => return check_finished(&out, plan.slot_count, &plan.run(), arguments.output),
        Contents::Unfinished(run) => {
            plan.run().check(&out, "an unfinished", &run)?;
            context.note(format!("continuing in {}", out.display()));
        }
        Contents::Nothing => {}
    }
    interrupt::listen();
    context.detail(format!("seed {}: {}", plan.seed, crate::effort::description(&plan.settings)));
    let folder = Folder::claim(&out, &plan.run())?;
    folder.subfolder("events")?;
    if plan.videos {
        folder.subfolder("videos")?;
    }
    folder.subfolder(parquet::FOLDER)?;
    let indices = plan.slots();
    let events = plan.events_in(&indices);
    let slots = Slots::new(&plan, &folder, events, *context)?;
    if !crew::fill(&slots, &indices, &arguments.jobs)? {
        return Err(CliError::Interrupted(out));
    }
    // The progress bar goes with them, before anything else is printed.
    drop(slots);
    let records = FilledSlots { plan: &plan, folder: &folder };
    if let Some((shard, of)) = plan.shard {
        shard::write_slots(&out, &records)?;
        let header = Shard::of_records(&out, (shard, of), plan.whole(), plan.fingerprint.clone());
        header.map_err(CliError::ReadBack)?.write(&out)?;
        folder.finish()?;
        let text =
            format!("{} in {}; merge all {of} shards with merge", console::events(events), out.display());
        let value = json!({ "folder": out, "events": events, "shard": shard, "of": of, "new": true });
        return arguments.output.print(text, &value);
    }
    let completed = complete(&out, &plan.whole(), &records, context)?;
    folder.finish()?;
    announce(&out, &completed, arguments.output, "")
}

/// Prints what a finished dataset contains, and how it was generated.
fn announce(out: &Path, completed: &Completed, output: Output, more: &str) -> Result<(), CliError> {
    let Completed { overview, digest } = completed;
    let mut text = String::new();
    if !overview.selection.is_empty() {
        text += &format!("{}\n", acceptance::table(&overview.selection).trim_end());
    }
    let events = console::events(overview.events);
    text += &format!("{events} in {}\nSHA-256 of {MANIFEST_FILE}: {digest}\n", out.display());
    text += &format!("{}{more}", page_line(out));
    let value = json!({
        "folder": out, "events": overview.events, "seed": overview.seed, "page": page(out),
        "selection": overview.selection, "manifest_sha256": digest, "new": true,
    });
    output.print(text, &value)
}

/// The page on which the events can be watched, if they have videos.
fn page(out: &Path) -> Option<PathBuf> {
    Some(out.join(PAGE_FILE)).filter(|page| page.exists())
}

fn page_line(out: &Path) -> String {
    page(out).map_or_else(String::new, |page| format!("open {} to watch them\n", page.display()))
}

/// A finished and complete shard is used unchanged if it is the requested one.
fn check_finished_shard(plan: &Plan, out: &Path, output: Output) -> Result<(), CliError> {
    let shard = Shard::read(out)?;
    let run = run_of(&shard.whole, Some((shard.shard, shard.of)));
    plan.run().check(out, "a finished", run.value())?;
    for record in shard.records(out) {
        record?.files().try_for_each(|file| file.verify(out)).map_err(CliError::Altered)?;
    }
    let events = plan.events_in(&plan.slots());
    keep_finished(out, &run, ("shard", events), output)
}

/// A finished and complete dataset is used unchanged if it is that of a run.
fn check_finished(out: &Path, slots: usize, expected: &Run, output: Output) -> Result<(), CliError> {
    let manifest = Manifest::read(&out.join(MANIFEST_FILE))?;
    let description = description(&manifest, slots);
    let run = run_of(&description, None);
    expected.check(out, "a finished", run.value())?;
    manifest.all_files().try_for_each(|file| file.verify(out)).map_err(CliError::Altered)?;
    keep_finished(out, &run, ("dataset", description.events), output)
}

/// What a finished dataset says of itself, but for the command that made it.
pub(crate) fn description(manifest: &Manifest, slots: usize) -> DatasetDescription {
    DatasetDescription {
        preset: manifest.preset.clone(),
        events: manifest.events.len(),
        slots,
        seed: manifest.seed,
        generator: manifest.generator.clone(),
        settings: manifest.settings.clone(),
        selected: !manifest.selection.is_empty(),
        videos: manifest.events.iter().all(|entry| entry.video.is_some()),
        date_published: manifest.date_published.clone(),
        command: String::new(),
    }
}

/// Removes what a run that was killed at its very end has left, and says that everything is there.
fn keep_finished(
    out: &Path,
    run: &Run,
    (what, events): (&str, usize),
    output: Output,
) -> Result<(), CliError> {
    folder::remove_leftovers(out, run)?;
    let text = format!("{} holds this {what} already; all {events} events are whole\n", out.display());
    let value = json!({ "folder": out, "events": events, "page": page(out), "new": false });
    output.print(text + &page_line(out), &value)
}

/// The identity of the run that makes a dataset, or a shard of it.
pub(crate) fn run_of(whole: &DatasetDescription, shard: Option<(usize, usize)>) -> Run {
    Run::new([
        ("command", "gen-dataset".into()),
        ("preset", whole.preset.as_str().into()),
        ("events", whole.events.into()),
        ("seed", whole.seed.into()),
        ("generator", whole.generator.as_str().into()),
        ("settings", whole.settings.clone()),
        ("videos", whole.videos.into()),
        ("date_published", whole.date_published.as_deref().into()),
        ("shard", shard.map(|(shard, of)| format!("{shard}/{of}")).into()),
    ])
}

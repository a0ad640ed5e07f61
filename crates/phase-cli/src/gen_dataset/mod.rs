//! `gen-dataset`: a preset and a seed make a dataset, or one shard of it.
//!
//! A dataset is a list of slots, each of which tries scenes until one shows its label ([`slot`]). What a slot comes
//! to depends on the dataset's seed and the slot's number alone, so threads, interruptions and shards leave no
//! trace. When all slots are filled, [`mod@complete`] writes what describes the whole.

pub mod complete;
pub mod merge;
pub mod options;
pub mod plan;
pub mod slot;

use crate::{
    console::{remark, tell},
    error::CliError,
    interrupt,
    parallel::for_all,
};
use complete::complete;
use options::GenDataset;
use phase_dataset::{
    checksum::FileEntry,
    folder::{self, Contents, Folder},
    manifest::{EventEntry, MANIFEST_FILE, Manifest, PAGE_FILE},
    parquet,
    record::Record,
    shard::{SHARD_FILE, SHARD_FORMAT, Shard, Whole},
};
use phase_report::acceptance;
use phase_sim::Engine;
use plan::Plan;
use serde_json::{Value, json};
use slot::Slots;
use std::path::Path;

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &GenDataset) -> Result<(), CliError> {
    let plan = Plan::of(arguments)?;
    let out = arguments.out.clone().unwrap_or_else(|| plan.default_folder());
    let last_file = if plan.shard.is_some() { SHARD_FILE } else { MANIFEST_FILE };
    match folder::inspect(&out, last_file)? {
        Contents::Finished => return check_finished(&plan, &out),
        Contents::Unfinished(run) => {
            check_same(&out, "an unfinished", &run, &plan.run())?;
            remark(format!("going on in {}", out.display()));
        }
        Contents::Nothing => {}
    }
    interrupt::listen();
    let folder = Folder::claim(&out, &plan.run())?;
    folder.subfolder("events")?;
    if plan.videos {
        folder.subfolder("videos")?;
    }
    folder.subfolder(parquet::FOLDER)?;
    let indices = plan.slots();
    let slots = Slots::new(&plan, &folder, indices.len());
    if !for_all(&arguments.jobs, indices.len(), |k| slots.fill(indices[k]))? {
        return Err(CliError::Interrupted(out));
    }
    let records = || indices.iter().map(|&index| slots.record(index));
    if let Some((shard, of)) = plan.shard {
        let slots: Vec<Record> = records().collect();
        let (format, whole) = (SHARD_FORMAT.into(), plan.whole());
        let shard = Shard { format, shard, of, whole, slots };
        shard.write(&out.join(SHARD_FILE))?;
        folder.finish()?;
        tell(format!("{} events in {}; merge all {of} shards with merge", indices.len(), out.display()));
        return Ok(());
    }
    let manifest = complete(&out, &plan.whole(), records())?;
    folder.finish()?;
    announce(&out, &manifest);
    Ok(())
}

/// Says what a finished dataset holds, and how it came to it.
fn announce(out: &Path, manifest: &Manifest) {
    if !manifest.selection.is_empty() {
        tell(acceptance::table(&manifest.selection).trim_end());
    }
    tell(format!("{} events in {}", manifest.events.len(), out.display()));
    tell_page(out);
}

/// Says where the events can be watched, if they have videos.
fn tell_page(out: &Path) {
    let page = out.join(PAGE_FILE);
    if page.exists() {
        tell(format!("open {} to watch them", page.display()));
    }
}

/// A finished dataset or shard is taken as it is if it is the one asked for and whole.
fn check_finished(plan: &Plan, out: &Path) -> Result<(), CliError> {
    let (whole, files) = if plan.shard.is_some() {
        let shard = Shard::read(&out.join(SHARD_FILE))?;
        let entries = shard.slots.into_iter().filter_map(|slot| slot.entry);
        let files: Vec<FileEntry> =
            entries.flat_map(|entry| entry.files().cloned().collect::<Vec<_>>()).collect();
        (run_value(&shard.whole, Some((shard.shard, shard.of))), files)
    } else {
        let manifest = Manifest::read(&out.join(MANIFEST_FILE))?;
        let whole = Whole {
            preset: manifest.preset,
            events: manifest.events.len(),
            seed: manifest.seed,
            generator: manifest.generator,
            settings: manifest.settings,
            selected: !manifest.selection.is_empty(),
            videos: manifest.events.iter().all(|entry| entry.video.is_some()),
            command: String::new(),
        };
        let of_events = manifest.events.iter().flat_map(EventEntry::files);
        (run_value(&whole, None), of_events.chain(&manifest.files).cloned().collect())
    };
    check_same(out, "a finished", &whole, &plan.run())?;
    files.iter().try_for_each(|file| file.verify(out)).map_err(CliError::Altered)?;
    if folder::has_leftovers(out) {
        Folder::claim(out, &whole)?.finish()?;
    }
    let (count, what) = (plan.slots().len(), if plan.shard.is_some() { "shard" } else { "dataset" });
    tell(format!("{} holds this {what} already; all {count} events are whole", out.display()));
    tell_page(out);
    Ok(())
}

/// What a run is, as it stands in the folder it works in.
fn run_value(whole: &Whole, shard: Option<(usize, usize)>) -> Value {
    let mut value = json!({
        "command": "gen-dataset", "preset": whole.preset, "events": whole.events, "seed": whole.seed,
        "generator": whole.generator, "settings": whole.settings,
    });
    if !whole.videos {
        value["videos"] = false.into();
    }
    if let Some((shard, of)) = shard {
        value["shard"] = format!("{shard}/{of}").into();
    }
    value
}

/// Checks that the run of a folder is this one.
///
/// # Errors
/// [`CliError::OtherRun`].
pub fn check_same(out: &Path, state: &'static str, other: &Value, run: &Value) -> Result<(), CliError> {
    let mut other = other.clone();
    if let Some(settings) = other.get_mut("settings").and_then(Value::as_object_mut) {
        // Runs from before there was a choice.
        settings.entry("engine").or_insert_with(|| Engine::default().name().into());
    }
    match difference(&other, run) {
        None => Ok(()),
        Some(difference) => Err(CliError::OtherRun { path: out.to_owned(), state, difference }),
    }
}

/// The first thing in which another run differs from this one, in words.
fn difference(other: &Value, this: &Value) -> Option<String> {
    match (other, this) {
        (Value::Object(a), Value::Object(b)) => {
            let mut keys: Vec<&String> = b.keys().chain(a.keys()).collect();
            keys.sort();
            keys.dedup();
            // The command first: with another one nothing else compares.
            keys.sort_by_key(|key| *key != "command");
            keys.into_iter().find_map(|key| {
                let (a, b) = (a.get(key).unwrap_or(&Value::Null), b.get(key).unwrap_or(&Value::Null));
                match (a, b) {
                    (Value::Object(_), Value::Object(_)) => {
                        difference(a, b).map(|inner| format!("{key}.{inner}"))
                    }
                    _ if a == b => None,
                    _ => Some(format!("{key} {a} instead of {b}")),
                }
            })
        }
        _ if other == this => None,
        _ => Some(format!("{other} instead of {this}")),
    }
}

//! Generation of a dataset, or of one shard of it, from a preset and a seed.
//!
//! A dataset is a list of slots, each of which tries scenes until one shows its label (`slot`). The result
//! of a slot depends only on the dataset's seed and the slot's number, so threads, interruptions and shards
//! do not affect it. Each thread fills one slot after the other. When all slots are filled,
//! [`mod@complete`] writes the files that describe the whole.

mod command;

pub mod complete;
pub mod merge;
pub mod plan;
pub(crate) mod scenes;
mod set;
pub(crate) mod slot;

use crate::{
    effort::{self, Effort},
    error::RunError,
    listener::Listener,
    parallel::{self, make_all},
    resume::is_finished,
};
pub use command::steps_of;
use complete::{Completed, complete};
use phase_dataset::{
    form::StimulusForm,
    manifest::{MANIFEST_FILE, Manifest},
    parquet,
    shard::{self, DatasetDescription, SHARD_FILE, Shard},
};
use phase_files::{
    folder::{self, Folder},
    run::Run,
};
use plan::DatasetPlan;
pub use scenes::any_scene;
use serde_json::json;
use slot::{FilledSlots, Slots};
use std::path::{Path, PathBuf};

/// A dataset to be generated, or one shard of it.
///
/// Its fields determine the files, byte for byte, on any machine and for any number of threads; merged shards
/// give the same files. Interrupted, the same generation goes on from what is finished.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Generation {
    /// The name of a bundled preset, such as `demo` or `phase-500`, or a file in the format `phase-preset/3`
    /// whose name ends in `.json`.
    pub preset: String,
    /// Number of events of the whole dataset, at least 1; without it the preset's.
    pub events: Option<usize>,
    /// Seed of the whole dataset; without it the preset's.
    pub seed: Option<u64>,
    /// Folder for the dataset: new, empty, or of the same generation; without it one below `out`, named after
    /// preset and seed.
    pub out: Option<PathBuf>,
    /// Whether events get videos, and the dataset a page to watch them.
    pub videos: bool,
    /// Date of publication in `croissant.json`, YYYY-MM-DD.
    pub date_published: Option<String>,
    /// Length and look of the events.
    pub form: StimulusForm,
    /// The shard to generate, from 1, and the number of shards; without it the whole.
    pub shard: Option<(usize, usize)>,
    /// Engine, minds, and their search.
    pub effort: Effort,
    /// Number of threads; without it that of this machine's cores.
    pub threads: Option<usize>,
}

/// A dataset or shard that is there.
#[derive(Debug)]
pub struct Generated {
    /// Its folder.
    pub folder: PathBuf,
    /// Number of its events.
    pub events: usize,
    /// Origin of the dataset or shard: made now, or there before.
    pub outcome: Outcome,
}

/// Origin of a dataset or shard: made now, or there before.
#[derive(Debug)]
pub enum Outcome {
    /// The whole dataset is made.
    Made(Box<Completed>),
    /// A shard is made, by its number from 1 and the number of shards.
    MadeShard(usize, usize),
    /// It was there already, and is whole: `dataset` or `shard`.
    Kept(&'static str),
}

impl Generation {
    /// The whole of a preset with videos, on all cores.
    #[must_use]
    pub fn new(preset: impl Into<String>) -> Self {
        Self {
            preset: preset.into(),
            events: None,
            seed: None,
            out: None,
            videos: true,
            date_published: None,
            form: StimulusForm::default(),
            shard: None,
            effort: Effort::default(),
            threads: None,
        }
    }

    /// Generates the dataset, goes on with what an interrupted run has left of it, or finds that it is there.
    ///
    /// # Errors
    /// If the preset or the folder cannot be used, no scene of a slot shows its label, a file cannot be
    /// written, or a stop was requested.
    pub fn run(&self, listener: &dyn Listener) -> Result<Generated, RunError> {
        let plan = DatasetPlan::of(self)?;
        let out = self.out.clone().unwrap_or_else(|| plan.default_folder());
        let last_file = if plan.shard.is_some() { SHARD_FILE } else { MANIFEST_FILE };
        if is_finished(&out, last_file, &plan.run(), listener)? {
            return match plan.shard {
                Some(_) => finished_shard(&plan, &out),
                None => finished(&out, plan.slot_count, &plan.run()),
            };
        }
        listener.detail(&format!("seed {}: {}", plan.seed, effort::description(&plan.settings)));
        self.make(&plan, out, listener)
    }

    fn make(&self, plan: &DatasetPlan, out: PathBuf, listener: &dyn Listener) -> Result<Generated, RunError> {
        let folder = Folder::claim(&out, &plan.run())?;
        folder.subfolder("events")?;
        if plan.videos {
            folder.subfolder("videos")?;
        }
        folder.subfolder(parquet::FOLDER)?;
        let indices = plan.slots();
        let events = plan.events_in(&indices);
        let slots = Slots::new(plan, &folder, events, listener)?;
        let filled = make_all(parallel::threads(self.threads), indices.len(), |k| slots.fill(indices[k]))?;
        if filled.is_none() {
            return Err(RunError::Interrupted(out));
        }
        // Its progress goes with it, before anything else is told.
        drop(slots);
        let records = FilledSlots { plan, folder: &folder };
        if let Some((shard, of)) = plan.shard {
            let slots = shard::write_slots(&out, &records)?;
            Shard::of_records((shard, of), plan.whole(), plan.fingerprint.clone(), slots).write(&out)?;
            folder.finish()?;
            return Ok(Generated { folder: out, events, outcome: Outcome::MadeShard(shard, of) });
        }
        let completed = complete(&out, &plan.whole(), &records, listener)?;
        folder.finish()?;
        Ok(Generated {
            folder: out,
            events: completed.overview.events,
            outcome: Outcome::Made(Box::new(completed)),
        })
    }
}

/// A finished and complete shard is used unchanged if it is the requested one.
fn finished_shard(plan: &DatasetPlan, out: &Path) -> Result<Generated, RunError> {
    let shard = Shard::read(out)?;
    let run = run_of(&shard.whole, Some((shard.shard, shard.of)));
    plan.run().check(out, "a finished", run.value())?;
    for record in shard.records(out) {
        record?.files().try_for_each(|file| file.verify(out)).map_err(RunError::Altered)?;
    }
    let events = plan.events_in(&plan.slots());
    keep_finished(out, &run, "shard", events)
}

/// A finished and complete dataset is used unchanged if it is that of a run.
fn finished(out: &Path, slots: usize, expected: &Run) -> Result<Generated, RunError> {
    let manifest = Manifest::read(&out.join(MANIFEST_FILE))?;
    let description = description(&manifest, slots);
    let run = run_of(&description, None);
    expected.check(out, "a finished", run.value())?;
    manifest.all_files().try_for_each(|file| file.verify(out)).map_err(RunError::Altered)?;
    keep_finished(out, &run, "dataset", description.events)
}

/// Description of a finished dataset, without the command that made it.
pub(crate) fn description(manifest: &Manifest, slots: usize) -> DatasetDescription {
    DatasetDescription {
        preset: manifest.preset.clone(),
        events: manifest.events.len(),
        slots,
        seed: manifest.seed,
        generator: manifest.generator.clone(),
        settings: manifest.settings.clone(),
        form: manifest.form.clone(),
        selected: !manifest.selection.is_empty(),
        videos: manifest.events.iter().all(|entry| entry.video.is_some()),
        date_published: manifest.date_published.clone(),
        command: String::new(),
    }
}

/// Removes what a run that was killed at its very end has left.
fn keep_finished(out: &Path, run: &Run, what: &'static str, events: usize) -> Result<Generated, RunError> {
    folder::remove_leftovers(out, run)?;
    Ok(Generated { folder: out.to_owned(), events, outcome: Outcome::Kept(what) })
}

/// The identity of the run that makes a dataset, or a shard of it.
pub(crate) fn run_of(whole: &DatasetDescription, shard: Option<(usize, usize)>) -> Run {
    let form = (!whole.form.is_default()).then(|| json!(whole.form));
    Run::new([
        ("command", "gen-dataset".into()),
        ("preset", whole.preset.as_str().into()),
        ("events", whole.events.into()),
        ("seed", whole.seed.into()),
        ("generator", whole.generator.as_str().into()),
        ("settings", whole.settings.clone()),
        ("form", form.into()),
        ("videos", whole.videos.into()),
        ("date_published", whole.date_published.as_deref().into()),
        ("shard", shard.map(|(shard, of)| format!("{shard}/{of}")).into()),
    ])
}

//! `gen-dataset`: a preset and a seed make a dataset.

use crate::{
    cli::GenDataset,
    console::{remark, tell},
    engine::{self, GENERATOR},
    error::CliError,
    interrupt,
    parallel::make_all,
    production::{Order, Production, settings_value},
};
use phase_agent::Foresight;
use phase_dataset::{
    atomic,
    card::{self, CARD_FILE, card},
    checksum::FileEntry,
    croissant::{CROISSANT_FILE, croissant},
    folder::{self, Contents, Folder},
    gallery::{self, PAGE_FILE, Timeline},
    manifest::{DATASET_FORMAT, EventEntry, MANIFEST_FILE, Manifest, event_path, video_path},
    parquet,
    preset::Preset,
};
use phase_sim::{Engine, Settings};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The presets that come with the program.
const PRESETS: [(&str, &str); 1] = [("demo", include_str!("../../data/presets/demo.json"))];

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &GenDataset) -> Result<(), CliError> {
    let plan = Plan::of(arguments)?;
    let out = arguments.out.clone().unwrap_or_else(|| plan.default_folder());
    match folder::inspect(&out, MANIFEST_FILE)? {
        Contents::Finished => return plan.check_finished(&out),
        Contents::Unfinished(run) => {
            check_same(&out, "an unfinished", &run, &plan.run())?;
            remark(format!("going on in {}", out.display()));
        }
        Contents::Nothing => {}
    }
    interrupt::listen();
    let folder = Folder::claim(&out, &plan.run())?;
    folder.subfolder("events")?;
    folder.subfolder("videos")?;
    folder.subfolder(parquet::FOLDER)?;
    let production = Production::new(&folder, plan.settings, plan.count);
    let made = make_all(&arguments.jobs, plan.count, |index| plan.make(&production, folder.path(), index))?;
    drop(production);
    let Some(made) = made else { return Err(CliError::Interrupted(out)) };
    if !plan.complete(&folder, made)? {
        return Err(CliError::Interrupted(out));
    }
    folder.finish()?;
    tell(format!("{} events in {}", plan.count, out.display()));
    tell(format!("open {} to watch them", out.join(PAGE_FILE).display()));
    Ok(())
}

/// Everything that decides what a dataset holds.
struct Plan {
    preset: Preset,
    count: usize,
    seed: u64,
    settings: Settings,
    command: String,
}

impl Plan {
    fn of(arguments: &GenDataset) -> Result<Self, CliError> {
        let found = PRESETS.iter().find(|(name, _)| *name == arguments.preset);
        let (name, text) = found.ok_or_else(|| CliError::UnknownPreset {
            name: arguments.preset.clone(),
            known: PRESETS.map(|(name, _)| name).join(", "),
        })?;
        let preset = Preset::parse(name, text)?;
        let count = arguments.events.map_or(preset.events, |events| events as usize);
        let seed = arguments.seed.unwrap_or(preset.seed);
        let effort = arguments.effort.as_given();
        let command =
            format!("cargo xtask gen-dataset --preset {name} --events {count} --seed {seed}{effort}");
        Ok(Self { preset, count, seed, settings: arguments.effort.settings(), command })
    }

    /// A folder that differs with everything a user is likely to vary.
    fn default_folder(&self) -> PathBuf {
        let count = if self.count == self.preset.events { String::new() } else { format!("-{}", self.count) };
        let engine = match self.settings.engine {
            Engine::World => String::new(),
            other => format!("-{}", other.name()),
        };
        let foresight = match self.settings.minds.foresight {
            Foresight::Coarse => String::new(),
            other => format!("-{}", other.name()),
        };
        Path::new("out").join(format!("{}-seed{}{count}{engine}{foresight}", self.preset.name, self.seed))
    }

    fn run(&self) -> Value {
        run_value(&self.preset.name, self.count, self.seed, GENERATOR, &settings_value(&self.settings))
    }

    /// A finished dataset is taken as it is if it is the one asked for and whole.
    fn check_finished(&self, out: &Path) -> Result<(), CliError> {
        let manifest = Manifest::read(&out.join(MANIFEST_FILE))?;
        let (preset, count) = (&manifest.preset, manifest.events.len());
        let run = run_value(preset, count, manifest.seed, &manifest.generator, &manifest.settings);
        check_same(out, "a finished", &run, &self.run())?;
        manifest.verify(out).map_err(CliError::Altered)?;
        if folder::has_leftovers(out) {
            Folder::claim(out, &run)?.finish()?;
        }
        tell(format!("{} holds this dataset already; all {count} events are whole", out.display()));
        tell(format!("open {} to watch them", out.join(PAGE_FILE).display()));
        Ok(())
    }

    fn make(
        &self,
        production: &Production,
        out: &Path,
        index: usize,
    ) -> Result<Option<(EventEntry, Timeline)>, CliError> {
        let id = self.preset.id(index);
        let order = Order {
            seed: engine::event_seed(self.seed, index),
            relation: None,
            json: out.join(event_path(&id)),
            video: Some(out.join(video_path(&id))),
            id,
        };
        let scene = || engine::scene(self.preset.kind(index), self.seed, index);
        let Some(event) = production.make(&order, scene)? else { return Ok(None) };
        let entry = EventEntry::of(out, &order.id, &event).map_err(CliError::ReadBack)?;
        Ok(Some((entry, Timeline::of(&event))))
    }

    /// Writes what belongs to no single event; the manifest last, since with it the dataset is complete. False if it
    /// was interrupted.
    fn complete(&self, folder: &Folder, made: Vec<(EventEntry, Timeline)>) -> Result<bool, CliError> {
        let (events, timelines): (Vec<EventEntry>, Vec<Timeline>) = made.into_iter().unzip();
        let mut manifest = Manifest {
            format: DATASET_FORMAT.into(),
            generator: GENERATOR.into(),
            preset: self.preset.name.clone(),
            seed: self.seed,
            settings: settings_value(&self.settings),
            events,
            files: Vec::new(),
        };
        let out = folder.path();
        let Some(files) = parquet::export(out, &manifest.events, &interrupt::requested)? else {
            return Ok(false);
        };
        manifest.files = files;
        let page = gallery::page(&manifest, &timelines);
        describe(out, &mut manifest, PAGE_FILE, &page)?;
        let text = card(&manifest, &self.command);
        describe(out, &mut manifest, CARD_FILE, &text)?;
        let text = croissant(&manifest, card::about());
        describe(out, &mut manifest, CROISSANT_FILE, &text)?;
        atomic::write(&out.join(MANIFEST_FILE), manifest.to_json().as_bytes())?;
        Ok(true)
    }
}

/// Writes a file that belongs to no single event, and has the manifest name it.
fn describe(out: &Path, manifest: &mut Manifest, name: &str, text: &str) -> Result<(), CliError> {
    atomic::write(&out.join(name), text.as_bytes())?;
    manifest.files.push(FileEntry::of(out, name).map_err(CliError::ReadBack)?);
    Ok(())
}

fn run_value(preset: &str, events: usize, seed: u64, generator: &str, settings: &Value) -> Value {
    json!({
        "command": "gen-dataset", "preset": preset, "events": events, "seed": seed, "generator": generator,
        "settings": settings,
    })
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
        if let Some(minds) = settings.get_mut("minds").and_then(Value::as_object_mut) {
            minds.entry("foresight").or_insert_with(|| Foresight::Exact.name().into());
        }
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

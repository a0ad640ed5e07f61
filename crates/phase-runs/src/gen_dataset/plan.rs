//! Everything that determines a dataset.

use super::{Generation, run_of};
use crate::{
    engine::GENERATOR,
    error::RunError,
    event_writer::{program, settings_value},
    picture::Look,
};
use phase_dataset::{
    composition::Composition,
    form::StimulusForm,
    preset::Preset,
    shard::{self, DatasetDescription},
};
use phase_files::{
    FileError, Problem,
    checksum::hexadecimal,
    regular,
    run::{self, Run},
};
use phase_minds::{MindKind, MindParameters};
use phase_model::arena::STEP_VIDEO_SECONDS;
use phase_sim::{Engine, SimulationSettings};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// A preset with everything that a generation adds to it.
#[derive(Clone, Debug)]
pub struct DatasetPlan {
    /// The recipe.
    pub preset: Preset,
    /// Its slots.
    pub composition: Composition,
    /// Number of events of the whole dataset.
    pub count: usize,
    /// Number of its slots: as many, unless the events come in sets.
    pub slot_count: usize,
    /// Seed of the whole dataset.
    pub seed: u64,
    /// Settings of the simulation of events.
    pub settings: SimulationSettings,
    /// Whether events get videos.
    pub videos: bool,
    /// Length and look of the events.
    pub form: StimulusForm,
    /// The shard to generate (from 1) and the number of shards, if not the whole.
    pub shard: Option<(usize, usize)>,
    /// Digest of everything that determines an event besides its slot and the seed: this executable, its
    /// settings, the preset.
    pub fingerprint: String,
    date_published: Option<String>,
    settings_value: Value,
    command: String,
}

impl DatasetPlan {
    /// The plan of a generation.
    ///
    /// # Errors
    /// [`RunError::UnknownPreset`], or if the preset's file cannot be used.
    pub fn of(generation: &Generation) -> Result<Self, RunError> {
        Self::with_preset(generation, Path::new(&generation.preset), &preset_text(&generation.preset)?)
    }

    /// The plan of a generation with the preset in a file, in place of the one it names.
    pub(crate) fn with_preset_of(generation: &Generation, file: &Path) -> Result<Self, RunError> {
        Self::with_preset(generation, file, &regular::text(file)?)
    }

    fn with_preset(generation: &Generation, place: &Path, text: &str) -> Result<Self, RunError> {
        let mut preset = Preset::parse(place, text)?;
        let form = generation.form.clone();
        Look::of(&form)?;
        let count = generation.events.unwrap_or_else(|| preset.events());
        let seed = generation.seed.unwrap_or(preset.seed);
        let command = generation.command(count, seed);
        let videos = generation.videos;
        let minds = minds_of(&preset, place, generation.effort.minds.kind)?;
        let mut settings = generation.effort.settings_with(minds)?;
        if let Some(steps) = form.steps {
            if generation.effort.max_steps.is_some() {
                return Err(RunError::Usage(
                    "--seconds: every event has this length; --max-steps has no use".into(),
                ));
            }
            (settings.min_steps, settings.max_steps) = (steps as usize, steps as usize);
            if let Some(selection) = &mut preset.selection {
                (selection.min_steps, selection.max_steps) = (steps as usize, steps as usize);
            }
        }
        let settings_value = settings_value(&settings)?;
        let fingerprint = run::digest(&json!({
            "program": hexadecimal(&program()), "settings": settings_value, "seed": seed, "preset": text,
            "form": form,
        }));
        let composition = Composition::of(&preset);
        let shard = generation.shard;
        let slot_count = composition.slots(count).ok_or_else(|| {
            let (below, above) = composition.whole_sets_around(count);
            let near = if below == 0 { above.to_string() } else { format!("{below} or {above}") };
            let rule = format!("the last set would be incomplete; {near} events are whole sets");
            RunError::Usage(format!("--events {count}: {rule}"))
        })?;
        Ok(Self {
            preset,
            composition,
            count,
            slot_count,
            seed,
            settings,
            videos,
            form,
            shard,
            fingerprint,
            date_published: generation.date_published.clone(),
            settings_value,
            command,
        })
    }

    /// A default folder that depends on every option a user is likely to vary.
    #[must_use]
    pub(crate) fn default_folder(&self) -> PathBuf {
        let count =
            if self.count == self.preset.events() { String::new() } else { format!("-{}", self.count) };
        let engine = match self.settings.engine {
            Engine::World => String::new(),
            other => format!("-{}", other.name()),
        };
        let form = &self.form;
        let seconds = form
            .steps
            .map_or_else(String::new, |steps| format!("-{}s", f64::from(steps) * STEP_VIDEO_SECONDS));
        let shard = self.shard.map_or_else(String::new, |(shard, of)| format!("-shard{shard}of{of}"));
        Path::new("out")
            .join(format!("{}-seed{}{count}{engine}{seconds}{shard}", self.preset.name, self.seed))
    }

    /// The numbers of the slots to fill.
    #[must_use]
    pub fn slots(&self) -> Vec<usize> {
        let (shard, of) = self.shard.unwrap_or((1, 1));
        shard::slots(shard, of, self.slot_count).collect()
    }

    /// Number of events in some slots.
    #[must_use]
    pub(crate) fn events_in(&self, slots: &[usize]) -> usize {
        slots.iter().map(|&slot| self.composition.set(slot).map_or(1, |set| set.stances.len())).sum()
    }

    /// The dataset's properties, apart from its events.
    #[must_use]
    pub fn whole(&self) -> DatasetDescription {
        DatasetDescription {
            preset: self.preset.name.clone(),
            events: self.count,
            slots: self.slot_count,
            seed: self.seed,
            generator: GENERATOR.into(),
            settings: self.settings_value.clone(),
            form: self.form.clone(),
            selected: self.preset.selection.is_some(),
            videos: self.videos,
            date_published: self.date_published.clone(),
            command: self.command.clone(),
        }
    }

    /// The identity of this run, for the folder it works in.
    #[must_use]
    pub fn run(&self) -> Run {
        run_of(&self.whole(), self.shard)
    }
}

/// The parameters of the agents' minds: those of the preset, unless minds of another kind are wanted.
fn minds_of(preset: &Preset, place: &Path, wanted: Option<MindKind>) -> Result<MindParameters, RunError> {
    let defaults = MindParameters::of(wanted.unwrap_or_default());
    let Some(given) = &preset.minds else { return Ok(defaults) };
    let read = MindParameters::from_overrides(given.clone()).map_err(|error| FileError {
        file: place.to_owned(),
        problem: Problem::Shape { what: "preset", rule: format!("in `minds`, {error}") },
    })?;
    Ok(if wanted.is_none_or(|wanted| wanted == read.kind()) { read } else { defaults })
}

/// A preset that is bundled with the program, by its name, or of a file.
///
/// # Errors
/// [`RunError::UnknownPreset`], or if the file cannot be used.
pub fn preset(name: &str) -> Result<Preset, RunError> {
    Ok(Preset::parse(name, &preset_text(name)?)?)
}

/// The text of a preset: a bundled one, or a file.
fn preset_text(name: &str) -> Result<String, RunError> {
    if let Some((_, text)) = phase_data::PRESETS.iter().find(|(known, _)| *known == name) {
        return Ok((*text).into());
    }
    let is_file = Path::new(name).extension().is_some_and(|ending| ending == "json");
    let file = Path::new(name);
    match regular::text(file) {
        Ok(text) => Ok(text),
        Err(FileError { problem: Problem::Unreadable(_), .. }) if !is_file => Err(RunError::UnknownPreset {
            name: name.into(),
            known: phase_data::PRESETS.map(|(name, _)| name).join(", "),
        }),
        Err(error) => Err(error.into()),
    }
}

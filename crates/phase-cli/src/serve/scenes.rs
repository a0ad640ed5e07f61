//! The scenes that games are played in.

use super::options::Serve;
use crate::{context::Context, error::CliError};
use phase_dataset::manifest::{MANIFEST_FILE, Manifest};
use phase_game::playlist::Item;
use phase_model::{EventKind, Scene};
use phase_runs::source::EventInput;
use phase_sampler::{NamedError, sample_named};

/// Sampled scenes of each kind, where none are given.
const OF_EACH_KIND: u64 = 4;
/// Seed of the practice, and first seed of sampled scenes.
const SEED: u64 = 1;

/// The scene of the practice, in which nobody has a goal.
pub(super) fn practice() -> Result<Item, CliError> {
    Ok(Item { source: "practice".into(), scene: sampled(EventKind::Independent, SEED)? })
}

/// The scenes that were asked for.
pub(super) fn of(arguments: &Serve, context: &Context) -> Result<Vec<Item>, CliError> {
    let Some(path) = &arguments.scenes else {
        let all = EventKind::ALL.into_iter().flat_map(|kind| (0..OF_EACH_KIND).map(move |k| (kind, k)));
        let item = |(kind, k): (EventKind, u64)| {
            Ok(Item { source: format!("{}-{k}", kind.name()), scene: sampled(kind, SEED + 1 + k)? })
        };
        return all.map(item).collect();
    };
    let wrong = |rule: String| CliError::Usage(format!("{}: {rule}", path.display()));
    let mut ids = Vec::new();
    if let Some(split) = arguments.split {
        let file = path.join(MANIFEST_FILE);
        if !file.is_file() {
            return Err(wrong("is not a dataset with a manifest: --split needs a dataset".into()));
        }
        let events = Manifest::read(&file)?.events;
        ids = events.into_iter().filter(|entry| entry.split() == split).map(|entry| entry.id).collect();
        if ids.is_empty() {
            return Err(wrong(format!("has no {} events", split.name())));
        }
    }
    let input = EventInput::open(path, &ids, context)?;
    let item = |index: usize| {
        let recording = input.load(index)?.into_owned();
        Ok(Item { source: recording.id, scene: recording.scene })
    };
    (0..input.len()).map(item).collect()
}

fn sampled(kind: EventKind, seed: u64) -> Result<Scene, CliError> {
    sample_named(Some(kind.name()), None, seed).map_err(|error| match error {
        NamedError::Sample(error) => CliError::Sample(error),
        // The name is one of the kinds'.
        error => CliError::Usage(error.to_string()),
    })
}

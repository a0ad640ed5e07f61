//! Videos in folders, and what is known of them.

use super::options::NewStudy;
use crate::{context::Context, error::CliError};
use phase_dataset::manifest::{EventEntry, MANIFEST_FILE, Manifest};
use phase_event::Recording;
use phase_model::{
    Attitude, Relation, Scene,
    random::{Purpose, stream},
};
use phase_runs::source;
use phase_study::{
    config::{Labels, Stimulus},
    design::known_goals,
};
use rand::RngExt;
use std::{
    collections::BTreeMap,
    ffi::OsStr,
    fs,
    path::{Path, PathBuf},
};

/// The videos of all folders, in the order of folders and ids.
pub(super) fn stimuli(arguments: &NewStudy, context: &Context) -> Result<Vec<Stimulus>, CliError> {
    let mut known = BTreeMap::new();
    for file in &arguments.events {
        for (_, recording) in source::read(file, &[], context)? {
            known.insert(recording.id.clone(), recording);
        }
    }
    let base = arguments.out.parent().unwrap_or_else(|| Path::new(""));
    let mut all = Vec::new();
    for (k, given) in arguments.videos.iter().enumerate() {
        let (source, folder) = given.split_once('=').unwrap_or(("phase", given));
        let folder = Path::new(folder);
        let mut stimuli = if folder.join(MANIFEST_FILE).is_file() {
            of_dataset(folder, source, base)?
        } else {
            of_folder(folder, source, base, &known)?
        };
        if stimuli.is_empty() {
            return Err(CliError::Usage(format!("{}: holds no videos", folder.display())));
        }
        if let Some(count) = arguments.sample {
            stimuli = sample(stimuli, count as usize, arguments.seed, k as u64);
        }
        all.extend(stimuli);
    }
    Ok(all)
}

/// So many of the videos, drawn at random, in their order.
fn sample(mut stimuli: Vec<Stimulus>, count: usize, seed: u64, folder: u64) -> Vec<Stimulus> {
    let mut random = stream(seed, Purpose::Scene, folder);
    while stimuli.len() > count {
        stimuli.remove(random.random_range(0..stimuli.len()));
    }
    stimuli
}

fn of_dataset(folder: &Path, source: &str, base: &Path) -> Result<Vec<Stimulus>, CliError> {
    let manifest = Manifest::read(&folder.join(MANIFEST_FILE))?;
    let of = |entry: &EventEntry| {
        let Some(video) = &entry.video else {
            let sentence = format!("{}: event {} has no video", folder.display(), entry.id);
            return Err(CliError::Usage(sentence));
        };
        let attitudes =
            entry.agents.each_ref().map(|agent| Attitude::try_from(agent.alpha).unwrap_or_default());
        let goals = entry.agents.each_ref().map(|agent| agent.goal);
        Ok(Stimulus {
            id: entry.id.clone(),
            video: relative(&video.place(folder), base)?,
            source: source.into(),
            objects: objects(entry.object_size_levels.len()),
            labels: Labels {
                goals: known_goals(goals, attitudes),
                relation: Some(entry.relation.name().into()),
                kind: Some(entry.kind.name().into()),
            },
        })
    };
    manifest.events.iter().map(of).collect()
}

fn of_folder(
    folder: &Path,
    source: &str,
    base: &Path,
    known: &BTreeMap<String, Recording>,
) -> Result<Vec<Stimulus>, CliError> {
    let listed = fs::read_dir(folder).and_then(Iterator::collect::<Result<Vec<_>, _>>);
    let unreadable = |error| phase_files::FileError {
        file: folder.to_owned(),
        problem: phase_files::Problem::Unreadable(error),
    };
    let mut files: Vec<PathBuf> = listed.map_err(unreadable)?.into_iter().map(|entry| entry.path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "mp4"));
    files.sort();
    let of = |file: &PathBuf| {
        let id = file.file_stem().and_then(OsStr::to_str).ok_or_else(|| unnamed(file))?.to_owned();
        let video = relative(file, base)?;
        let (objects, labels) = known.get(&id).map_or((2, Labels::default()), |recording| {
            (objects(recording.scene.objects.len()), labels(&recording.scene, recording.relation))
        });
        Ok(Stimulus { id, video, source: source.into(), objects, labels })
    };
    files.iter().map(of).collect()
}

fn labels(scene: &Scene, relation: Relation) -> Labels {
    Labels {
        goals: known_goals(scene.goals(), scene.attitudes()),
        relation: Some(relation.name().into()),
        kind: Some(scene.kind.name().into()),
    }
}

fn objects(count: usize) -> u8 {
    u8::try_from(count).unwrap_or(u8::MAX)
}

/// A path relative to a folder above it, with `/`.
fn relative(file: &Path, base: &Path) -> Result<String, CliError> {
    let absolute = |path: &Path| {
        let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
        fs::canonicalize(path).map_err(|error| {
            let problem = phase_files::Problem::Unreadable(error);
            CliError::File(phase_files::FileError { file: path.to_owned(), problem })
        })
    };
    let file = absolute(file)?;
    let base = absolute(base)?;
    let Ok(below) = file.strip_prefix(&base) else {
        return Err(CliError::Usage(format!(
            "--videos: {} does not lie below {}, the folder of --out",
            file.display(),
            base.display()
        )));
    };
    let parts = below.components().map(|part| part.as_os_str().to_str());
    parts.collect::<Option<Vec<_>>>().map(|parts| parts.join("/")).ok_or_else(|| unnamed(below))
}

/// A configuration names videos in text.
fn unnamed(file: &Path) -> CliError {
    CliError::Usage(format!("--videos: {}: has a name that is no text (UTF-8)", file.display()))
}

//! Videos in folders, and what is known of them.

use super::options::NewStudy;
use crate::{context::Context, error::CliError};
use phase_dataset::manifest::{EventEntry, MANIFEST_FILE, Manifest};
use phase_event::Recording;
use phase_files::{WriteError, atomic, incidental::is_incidental, regular};
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
    collections::{BTreeMap, BTreeSet},
    ffi::OsStr,
    fs,
    path::{Path, PathBuf},
};

/// The folder of a study's configuration, below which its videos lie. Those that lie elsewhere are copied.
struct Base {
    folder: PathBuf,
    copies: Vec<Copy>,
}

/// A video to be copied.
#[derive(Debug)]
pub(super) struct Copy {
    from: PathBuf,
    to: PathBuf,
}

impl Copy {
    /// Copies the video, unless it is there.
    pub(super) fn make(&self) -> Result<(), CliError> {
        let bytes = regular::bytes(&self.from)?;
        if self.to.exists() {
            if regular::bytes(&self.to)? == bytes {
                return Ok(());
            }
            let to = self.to.display();
            let from = self.from.display();
            return Err(CliError::Usage(format!(
                "{to}: is there, and is not {from}, which would be copied there"
            )));
        }
        let folder = self.to.parent().unwrap_or_else(|| Path::new(""));
        fs::create_dir_all(folder).map_err(|source| {
            CliError::Output(WriteError { path: folder.to_owned(), action: "create the folder", source })
        })?;
        atomic::write(&self.to, &bytes).map_err(CliError::Output)
    }
}

/// The videos of all folders, in the order of folders and ids, and those of them to be copied.
pub(super) fn stimuli(
    arguments: &NewStudy,
    context: &Context,
) -> Result<(Vec<Stimulus>, Vec<Copy>), CliError> {
    let mut known = BTreeMap::new();
    let mut unshown: Vec<(&Path, BTreeSet<String>)> = Vec::new();
    for file in &arguments.events {
        let mut ids = BTreeSet::new();
        for (_, recording) in source::read(file, &[], context)? {
            ids.insert(recording.id.clone());
            known.insert(recording.id.clone(), recording);
        }
        unshown.push((file.as_path(), ids));
    }
    let folder = arguments.out.parent().unwrap_or_else(|| Path::new("")).to_owned();
    let mut base = Base { folder, copies: Vec::new() };
    let mut all = Vec::new();
    for (k, given) in arguments.videos.iter().enumerate() {
        let (source, folder) = given.split_once('=').unwrap_or(("phase", given));
        let folder = Path::new(folder);
        let mut stimuli = if folder.join(MANIFEST_FILE).is_file() {
            of_dataset(folder, source, &mut base)?
        } else {
            let stimuli = of_folder(folder, source, &mut base, &known)?;
            unshown.retain(|(_, ids)| !stimuli.iter().any(|stimulus| ids.contains(&stimulus.id)));
            stimuli
        };
        if stimuli.is_empty() {
            return Err(CliError::Usage(format!("{}: holds no videos", folder.display())));
        }
        if let Some(count) = arguments.sample {
            if stimuli.len() < count as usize {
                let (folder, found) = (folder.display(), stimuli.len());
                context.note(format!("note: {folder}: has {found} videos, fewer than --sample {count}"));
            }
            stimuli = sample(stimuli, count as usize, arguments.seed, k as u64);
        }
        all.extend(stimuli);
    }
    if let Some((file, _)) = unshown.first() {
        let rule = "has no event with the name of an .mp4 file of --videos, so it would have no effect";
        return Err(CliError::Usage(format!("--events {}: {rule}", file.display())));
    }
    let shown: BTreeSet<PathBuf> = all.iter().map(|stimulus| base.folder.join(&stimulus.video)).collect();
    base.copies.retain(|copy| shown.contains(&copy.to));
    Ok((all, base.copies))
}

/// So many of the videos, drawn at random, in their order.
fn sample(mut stimuli: Vec<Stimulus>, count: usize, seed: u64, folder: u64) -> Vec<Stimulus> {
    let mut random = stream(seed, Purpose::Scene, folder);
    while stimuli.len() > count {
        stimuli.remove(random.random_range(0..stimuli.len()));
    }
    stimuli
}

fn of_dataset(folder: &Path, source: &str, base: &mut Base) -> Result<Vec<Stimulus>, CliError> {
    let manifest = Manifest::read(&folder.join(MANIFEST_FILE))?;
    let mut of = |entry: &EventEntry| {
        let Some(video) = &entry.video else {
            let sentence = format!("{}: event {} has no video", folder.display(), entry.id);
            return Err(CliError::Usage(sentence));
        };
        video.verify(folder)?;
        let attitudes =
            entry.agents.each_ref().map(|agent| Attitude::try_from(agent.alpha).unwrap_or_default());
        let goals = entry.agents.each_ref().map(|agent| agent.goal);
        Ok(Stimulus {
            id: entry.id.clone(),
            video: base.place(&video.place(folder), source)?,
            source: source.into(),
            objects: objects(entry.object_size_levels.len()),
            // What a dataset varies: in a set the stance of one agent, else the kind of event.
            set: entry.set.as_ref().map(|place| place.set.clone()),
            condition: Some(match &entry.set {
                Some(place) => place.stance.name().into(),
                None => entry.kind.name().into(),
            }),
            labels: Labels {
                goals: known_goals(goals, attitudes),
                relation: Some(entry.relation.name().into()),
                kind: Some(entry.kind.name().into()),
            },
        })
    };
    manifest.events.iter().map(&mut of).collect()
}

fn of_folder(
    folder: &Path,
    source: &str,
    base: &mut Base,
    known: &BTreeMap<String, Recording>,
) -> Result<Vec<Stimulus>, CliError> {
    let listed = fs::read_dir(folder).and_then(Iterator::collect::<Result<Vec<_>, _>>);
    let unreadable = |error| phase_files::FileError {
        file: folder.to_owned(),
        problem: phase_files::Problem::Unreadable(error),
    };
    let listed = listed.map_err(unreadable)?.into_iter();
    let videos = listed.filter(|entry| !is_incidental(&entry.file_name()));
    let mut files: Vec<PathBuf> = videos.map(|entry| entry.path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "mp4"));
    files.sort();
    let mut of = |file: &PathBuf| {
        let id = file.file_stem().and_then(OsStr::to_str).ok_or_else(|| unnamed(file))?.to_owned();
        let video = base.place(file, source)?;
        let (objects, labels) = known.get(&id).map_or((2, Labels::default()), |recording| {
            (objects(recording.scene.objects.len()), labels(&recording.scene, recording.relation))
        });
        let condition = labels.kind.clone();
        Ok(Stimulus { id, video, source: source.into(), objects, set: None, condition, labels })
    };
    files.iter().map(&mut of).collect()
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

impl Base {
    /// The path of a video relative to the configuration, with `/`; of one that lies elsewhere that of its
    /// copy.
    fn place(&mut self, file: &Path, source: &str) -> Result<String, CliError> {
        let file = fs::canonicalize(file).map_err(|error| {
            let problem = phase_files::Problem::Unreadable(error);
            CliError::File(phase_files::FileError { file: file.to_owned(), problem })
        })?;
        // A folder that is not there has no videos.
        let folder = if self.folder.as_os_str().is_empty() { Path::new(".") } else { &self.folder };
        let base = fs::canonicalize(folder).ok();
        let below = base.and_then(|base| file.strip_prefix(base).ok().map(Path::to_owned));
        let below = match below {
            Some(below) => below,
            None => {
                let name = file.file_name().ok_or_else(|| unnamed(&file))?;
                let below = Path::new("videos").join(source).join(name);
                self.copies.push(Copy { to: self.folder.join(&below), from: file.clone() });
                below
            }
        };
        let parts = below.components().map(|part| part.as_os_str().to_str());
        parts.collect::<Option<Vec<_>>>().map(|parts| parts.join("/")).ok_or_else(|| unnamed(&below))
    }
}

/// A configuration names videos in text.
fn unnamed(file: &Path) -> CliError {
    CliError::Usage(format!("--videos: {}: has a name that is no text (UTF-8)", file.display()))
}

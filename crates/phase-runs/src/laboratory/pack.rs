//! Packs of videos for experiment platforms.

use super::{
    CLIPS_FILE,
    clips::{ClipList, Entry},
    tables::unusable,
};
use crate::{error::RunError, listener::Listener};
use phase_dataset::manifest::{MANIFEST_FILE, Manifest};
use phase_files::{new_folder::NewFolder, regular};
use phase_laboratory::{
    counterbalance::{Stimulus, lists},
    platform::{Platform, Question, Trial, files},
};
use phase_model::{
    arena::{STEP_VIDEO_SECONDS, SUBSTEPS},
    random::{Purpose, stream},
};
use std::path::{Path, PathBuf};

/// The question of a pack, as raters of studies read it, and its answers.
const QUESTION: Question<'static> = Question {
    text: "How do the two agents relate to each other?",
    answers: &["friendly", "neutral", "adversarial"],
};

/// A run that packs videos.
#[derive(Clone, Debug)]
pub struct Pack {
    /// A dataset, or the folder of `clip`.
    pub from: PathBuf,
    /// Only these, if there are any.
    pub ids: Vec<String>,
    /// The platform.
    pub platform: Platform,
    /// Number of lists, at least 1.
    pub lists: usize,
    /// Attention checks in every list.
    pub checks: usize,
    /// Address of the videos, for platforms that load them from elsewhere.
    pub address: String,
    /// Random seed of the order.
    pub seed: u64,
    /// The folder to write, which is new or empty.
    pub out: PathBuf,
}

/// A pack that was made.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Packed {
    /// Number of videos.
    pub videos: usize,
    /// Trials of every list.
    pub trials: Vec<usize>,
    /// Names of the texts.
    pub files: Vec<String>,
}

/// A video and what is known of it.
struct Item {
    trial: Trial,
    set: Option<String>,
    place: PathBuf,
}

impl Pack {
    /// Writes the pack.
    ///
    /// # Errors
    /// If videos are missing, the folder is not empty or cannot be written, or the lists cannot be
    /// counterbalanced.
    pub fn run(&self, listener: &dyn Listener) -> Result<Packed, RunError> {
        let new = NewFolder::create(&self.out)?;
        let items = self.items()?;
        if let Some(id) = self.ids.iter().find(|id| items.iter().all(|item| item.trial.id != **id)) {
            let known = items.iter().map(|item| item.trial.id.as_str());
            return Err(RunError::unknown_id(&self.from, id, known));
        }
        let items: Vec<Item> = items
            .into_iter()
            .filter(|item| self.ids.is_empty() || self.ids.contains(&item.trial.id))
            .collect();
        let stimuli: Vec<Stimulus> =
            items.iter().map(|item| Stimulus { id: item.trial.id.clone(), set: item.set.clone() }).collect();
        let mut random = stream(self.seed, Purpose::Assignment, 0);
        let orders = lists(&stimuli, self.lists, &mut random)
            .map_err(|error| RunError::Usage(format!("--lists: {error}")))?;
        let trials: Vec<Vec<Trial>> = orders.iter().map(|order| self.with_checks(order, &items)).collect();
        let texts = files(self.platform, &trials, QUESTION, &self.address)
            .map_err(|error| RunError::Usage(format!("the tables cannot be written: {error}")))?;
        let folder = Path::new(self.platform.stimuli());
        let progress = listener.progress_over("copying videos", items.len());
        for item in &items {
            new.write(folder.join(&item.trial.video), &regular::bytes(&item.place)?)?;
            if item.trial.frames > 0 && matches!(self.platform, Platform::Psychopy | Platform::Pavlovia) {
                let (from, to) = (item.place.with_extension(""), folder.join(&item.trial.id));
                for frame in 0..item.trial.frames {
                    let name = format!("{frame:04}.png");
                    new.write(to.join(&name), &regular::bytes(&from.join(&name))?)?;
                }
            }
            progress.steps(1);
        }
        drop(progress);
        for (name, text) in &texts {
            new.write(name, text.as_bytes())?;
        }
        new.commit()?;
        Ok(Packed {
            videos: items.len(),
            trials: trials.iter().map(Vec::len).collect(),
            files: texts.into_iter().map(|(name, _)| name).collect(),
        })
    }

    /// A list with its attention checks, evenly spaced. Each repeats a video of the list and asks for an
    /// answer that its trial says.
    fn with_checks(&self, order: &[usize], items: &[Item]) -> Vec<Trial> {
        let mut list: Vec<Trial> = order.iter().map(|&k| items[k].trial.clone()).collect();
        for check in (0..self.checks).rev() {
            let place = (check + 1) * order.len() / (self.checks + 1);
            let answer = QUESTION.answers[check % QUESTION.answers.len()];
            if let Some(&shown) = order.get(place.saturating_sub(1)) {
                let trial = &items[shown].trial;
                let id = format!("{}-check{}", trial.id, check + 1);
                list.insert(place, Trial { id, check: answer.to_owned(), ..trial.clone() });
            }
        }
        list
    }

    fn items(&self) -> Result<Vec<Item>, RunError> {
        let clips = self.from.join(CLIPS_FILE);
        if clips.is_file() {
            return of_clips(&self.from, &clips);
        }
        let file = self.from.join(MANIFEST_FILE);
        if !file.is_file() {
            return Err(unusable(
                &self.from,
                &format!(
                    "is neither a dataset nor a folder of clips: it has no {MANIFEST_FILE} and no {CLIPS_FILE}"
                ),
            ));
        }
        let manifest = Manifest::read(&file)?;
        let of = |entry: &phase_dataset::manifest::EventEntry| {
            let video = entry
                .video
                .as_ref()
                .ok_or_else(|| unusable(&self.from, &format!("event {} has no video", entry.id)))?;
            if self.ids.is_empty() || self.ids.contains(&entry.id) {
                video.verify(&self.from)?;
            }
            let set = entry.set.as_ref().map(|place| place.set.clone());
            Ok(Item {
                place: video.path.below(&self.from),
                trial: trial(
                    &entry.id,
                    entry.steps,
                    entry.kind.name(),
                    entry.relation.name(),
                    set.as_deref(),
                ),
                set,
            })
        };
        manifest.events.iter().map(of).collect()
    }
}

fn trial(id: &str, steps: usize, kind: &str, relation: &str, set: Option<&str>) -> Trial {
    Trial {
        id: id.to_owned(),
        video: format!("{id}.mp4"),
        frames: 0,
        milliseconds: (steps as f64 * STEP_VIDEO_SECONDS * 1000.0) as u64,
        kind: kind.to_owned(),
        relation: relation.to_owned(),
        set: set.unwrap_or_default().to_owned(),
        check: String::new(),
    }
}

fn of_clips(folder: &Path, file: &Path) -> Result<Vec<Item>, RunError> {
    let of = |clip: Entry| {
        let Entry { id, video, .. } = &clip;
        let video = video
            .as_ref()
            .ok_or_else(|| unusable(file, &format!("clip {id} has no video; cut clips as mp4")))?;
        let place = folder.join(video);
        let mut trial = trial(id, clip.steps, clip.kind.name(), clip.relation.name(), clip.set.as_deref());
        if clip.frames.is_some() {
            trial.frames = clip.steps * SUBSTEPS;
        }
        Ok(Item { place, trial, set: clip.set })
    };
    ClipList::read(file)?.clips.into_iter().map(of).collect()
}

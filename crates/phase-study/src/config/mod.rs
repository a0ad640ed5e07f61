//! `phase-study/1`: what a study asks, whom, about which videos.

mod read;
mod stimuli;

use crate::{forms::Form, question::Question};
use phase_model::json::{FieldError, JsonError};
use std::collections::{BTreeMap, BTreeSet};
use thiserror::Error;

/// The value of the field `format` of configurations.
pub const STUDY_FORMAT: &str = "phase-study/1";
/// Minutes without a sign of a rater after which their places go to others, unless the configuration says
/// otherwise.
pub(crate) const MINUTES: u32 = 60;
/// The members of the address that are kept, unless the configuration says otherwise: those of Prolific.
pub const PARAMETERS: [&str; 3] = ["PROLIFIC_PID", "STUDY_ID", "SESSION_ID"];

/// Why a configuration cannot be used.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum ConfigError {
    /// It is not JSON of the format.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// A field breaks a rule.
    #[error(transparent)]
    Field(#[from] FieldError),
}

/// A video that is rated, with its labels.
#[derive(Clone, PartialEq, Debug)]
pub struct Stimulus {
    /// Its id, that of the event: 1 to 100 letters, digits, `-`, `_`, `.`.
    pub id: String,
    /// Its file, relative to that of the configuration, with `/`.
    pub video: String,
    /// Origin of the video, such as `phase` or `human`.
    pub source: String,
    /// Number of objects in the video, 0 to 2, on which the goals depend that are offered.
    pub objects: u8,
    /// The set that it belongs to, such as a minimal pair; a name of its own, as of ids.
    pub set: Option<String>,
    /// The value in this video of whatever was varied, such as `helping` or `hinder`; a word, as of ids.
    pub condition: Option<String>,
    /// Labels of the video, for accuracies.
    pub labels: Labels,
}

/// Labels of a video. Judgements without a label do not count in accuracies.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Labels {
    /// For each agent the answers about its goal that are right.
    pub goals: Option<[BTreeSet<String>; 2]>,
    /// The relation: `friendly`, `neutral` or `adversarial`.
    pub relation: Option<String>,
    /// The kind of event, such as `helping`.
    pub kind: Option<String>,
}

/// A video with a known answer.
#[derive(Clone, PartialEq, Debug)]
pub struct CatchTrial {
    /// Its id.
    pub id: String,
    /// Its file, as of a [`Stimulus`].
    pub video: String,
    /// Number of objects in the video, 0 to 2.
    pub objects: u8,
    /// By question the right choices: a rater has to give one of them, or, of a question that wants several,
    /// all of them.
    pub expected: BTreeMap<String, BTreeSet<String>>,
}

/// The end of a study, as a rater sees it.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Completion {
    /// A code that shows that one has finished.
    pub code: Option<String>,
    /// Address to go to then; https only.
    pub url: Option<String>,
}

/// A study.
#[derive(Clone, PartialEq, Debug)]
pub struct StudyConfig {
    /// Its name, part of its address: 1 to 64 small letters, digits and `-`.
    pub name: String,
    /// Its title.
    pub title: String,
    /// The form with the questions about each video.
    pub form: Form,
    /// Paragraphs above the text of consent; perhaps none.
    pub introduction: Vec<String>,
    /// Paragraphs that a rater agrees to, at least one.
    pub consent: Vec<String>,
    /// Paragraphs that a rater reads before the first video, at least one.
    pub instructions: Vec<String>,
    /// Questions about the rater, perhaps none.
    pub demographics: Vec<Question>,
    /// The videos, at least one.
    pub stimuli: Vec<Stimulus>,
    /// Those with a known answer; each rater sees all of them.
    pub catch_trials: Vec<CatchTrial>,
    /// Number of catch trials that a rater may fail and still count.
    pub catch_failures_allowed: u32,
    /// Raters wanted for each video, k.
    pub raters_per_video: u32,
    /// Most raters of a video, at least k.
    pub raters_per_video_at_most: u32,
    /// Videos that a rater is asked about, catch trials not counted.
    pub videos_per_rater: u32,
    /// Whether a rater sees videos of one source alone.
    pub between_sources: bool,
    /// Whether a rater sees no two videos of a set.
    pub one_of_each_set: bool,
    /// Whether a rater may answer before the video has been played to its end.
    pub answer_before_end: bool,
    /// Raters that count, after whom the study is full.
    pub raters: u32,
    /// The end of the study, as raters see it.
    pub completion: Completion,
    /// Members of the address that are kept; the first identifies the rater.
    pub parameters: Vec<String>,
    /// Whether the first of them is required to take part.
    pub identity_required: bool,
    /// Minutes without a sign of a rater after which their places go to others.
    pub minutes: u32,
    /// Seed of assignments.
    pub seed: u64,
}

impl StudyConfig {
    /// The sources, sorted.
    #[must_use]
    pub fn sources(&self) -> Vec<&str> {
        let sources: BTreeSet<&str> = self.stimuli.iter().map(|stimulus| stimulus.source.as_str()).collect();
        sources.into_iter().collect()
    }

    /// The groups of stimuli (indices) of which a rater sees one: those of each source, or all.
    #[must_use]
    pub fn groups(&self) -> Vec<Vec<usize>> {
        if !self.between_sources {
            return vec![(0..self.stimuli.len()).collect()];
        }
        let of = |source: &str| {
            let all = self.stimuli.iter().enumerate();
            all.filter(|(_, stimulus)| stimulus.source == source).map(|(k, _)| k).collect()
        };
        self.sources().into_iter().map(of).collect()
    }

    /// The catch trial with an id.
    #[must_use]
    pub fn catch_trial(&self, id: &str) -> Option<&CatchTrial> {
        self.catch_trials.iter().find(|trial| trial.id == id)
    }

    /// The stimulus with an id.
    #[must_use]
    pub fn stimulus(&self, id: &str) -> Option<&Stimulus> {
        self.stimuli.iter().find(|stimulus| stimulus.id == id)
    }

    /// All videos, of stimuli and then of catch trials: id and file.
    pub fn videos(&self) -> impl Iterator<Item = (&str, &str)> {
        let stimuli = self.stimuli.iter().map(|stimulus| (stimulus.id.as_str(), stimulus.video.as_str()));
        stimuli.chain(self.catch_trials.iter().map(|trial| (trial.id.as_str(), trial.video.as_str())))
    }
}

/// Numbers of a group of videos, of which a rater sees one group.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct GroupSize {
    /// Videos in all.
    pub videos: usize,
    /// Those of them that one rater may see: all, or one of each set and those of no set.
    pub for_one: usize,
    /// The fewest raters by whom every video can be seen once.
    pub fewest: usize,
}

impl GroupSize {
    /// The numbers of some videos.
    #[must_use]
    pub fn of<'a>(stimuli: impl IntoIterator<Item = &'a Stimulus>, one_of_each_set: bool) -> Self {
        let (mut videos, mut sets) = (0, BTreeMap::<&str, usize>::new());
        let mut in_sets = 0;
        for stimulus in stimuli {
            videos += 1;
            if let Some(set) = stimulus.set.as_deref().filter(|_| one_of_each_set) {
                in_sets += 1;
                *sets.entry(set).or_default() += 1;
            }
        }
        let fewest = sets.values().copied().max().unwrap_or(1);
        Self { videos, for_one: videos - in_sets + sets.len(), fewest }
    }
}

/// Raters that it takes until every video has had `raters_per_video`: for each group, judgements wanted over
/// videos a rater, rounded up.
#[must_use]
pub fn raters_needed(groups: &[GroupSize], raters_per_video: u32, videos_per_rater: u32) -> u32 {
    let needed = |group: &GroupSize| {
        let each = u64::from(videos_per_rater).min(group.for_one as u64).max(1);
        let wanted = u64::from(raters_per_video);
        (group.videos as u64 * wanted).div_ceil(each).max(group.fewest as u64 * wanted)
    };
    u32::try_from(groups.iter().map(needed).sum::<u64>()).unwrap_or(u32::MAX)
}

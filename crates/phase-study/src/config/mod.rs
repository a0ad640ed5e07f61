//! `phase-study/1`: what a study asks, whom, about which videos.

mod read;
mod stimuli;

use crate::{forms::Form, question::Question};
use phase_model::json::{FieldError, JsonError};
use std::collections::{BTreeMap, BTreeSet};
use thiserror::Error;

/// The value of the field `format` of configurations.
pub const STUDY_FORMAT: &str = "phase-study/1";
/// Minutes without a sign of a rater after which its places go to others, unless the configuration says
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

/// A video with an answer that everybody who watches gives.
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
    /// Raters that count, after whom the study is full.
    pub raters: u32,
    /// The end of the study, as raters see it.
    pub completion: Completion,
    /// Members of the address that are kept; the first identifies the rater.
    pub parameters: Vec<String>,
    /// Whether nobody takes part without the first of them.
    pub identity_required: bool,
    /// Minutes without a sign of a rater after which its places go to others.
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

/// Raters that it takes until every video has had so many: for each group of so many videos, judgements
/// wanted over videos a rater, rounded up.
#[must_use]
pub fn raters_needed(groups: &[usize], raters_per_video: u32, videos_per_rater: u32) -> u32 {
    let needed = |&videos: &usize| {
        let each = u64::from(videos_per_rater).min(videos as u64).max(1);
        (videos as u64 * u64::from(raters_per_video)).div_ceil(each)
    };
    u32::try_from(groups.iter().map(needed).sum::<u64>()).unwrap_or(u32::MAX)
}

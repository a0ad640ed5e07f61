//! Configurations to start from: the paper's experiments, for given videos.

mod goals;
mod text;

pub use goals::known_goals;

use crate::{
    config::{CatchTrial, GroupSize, Stimulus, raters_needed},
    forms::Form,
};
use std::collections::{BTreeMap, BTreeSet};

/// Videos of each published experiment, or of each of its sources.
const PUBLISHED_VIDEOS: usize = 100;

/// An experiment whose numbers a study takes over.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Experiment {
    /// The paper's Experiment 1: 100 videos, 130 people, each video judged by 10, the 23 types of
    /// interaction.
    Interactions,
    /// The second part of its Experiment 2: 100 videos of each of two sources, 186 people in two groups,
    /// goals, relation and human-likeness. The paper does not say how many videos a person saw; here it is
    /// 20, and 18 or 19 people judge a video.
    HumanLikeness,
    /// Malik and Isik's experiment (2023): 100 videos, 20 for a person and 10 to 19 people for a video, the
    /// relation.
    Relations,
}

impl Experiment {
    /// All experiments.
    pub const ALL: [Self; 3] = [Self::Interactions, Self::HumanLikeness, Self::Relations];

    /// The name on command lines, and of the study.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Interactions => "experiment-1",
            Self::HumanLikeness => "experiment-2",
            Self::Relations => "relations",
        }
    }

    /// The form that the study asks.
    #[must_use]
    pub const fn form(self) -> Form {
        match self {
            Self::Interactions => Form::Interactions,
            Self::HumanLikeness => Form::Goals,
            Self::Relations => Form::Relation,
        }
    }

    /// People over videos in the experiment, in hundredths; `None` where it was as many as needed.
    const fn raters_per_hundred_videos(self) -> Option<usize> {
        match self {
            Self::Interactions => Some(130),
            Self::HumanLikeness => Some(93),
            Self::Relations => None,
        }
    }
}

/// A study to write.
#[derive(Clone, PartialEq, Debug)]
pub struct Design {
    /// Whose numbers it takes over.
    pub experiment: Experiment,
    /// The videos.
    pub stimuli: Vec<Stimulus>,
    /// Those with a known answer.
    pub catch_trials: Vec<CatchTrial>,
    /// Name of the study, part of its address; that of the experiment if `None`.
    pub name: Option<String>,
    /// Videos for each rater; if `None` the experiment's number of as many videos as the experiment had,
    /// and all of fewer.
    pub videos_per_rater: Option<u32>,
    /// Whether a rater sees no two videos of a set.
    pub one_of_each_set: bool,
    /// Seed of assignments.
    pub seed: u64,
}

/// Numbers of people and of videos.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Numbers {
    /// Raters wanted for each video.
    pub raters_per_video: u32,
    /// Most raters of a video.
    pub raters_per_video_at_most: u32,
    /// Videos for each rater.
    pub videos_per_rater: u32,
    /// Raters.
    pub raters: u32,
}

impl Design {
    /// Whether each rater sees one source alone: in [`Experiment::HumanLikeness`], if there are several.
    #[must_use]
    pub fn between_sources(&self) -> bool {
        let sources: BTreeSet<&str> = self.stimuli.iter().map(|stimulus| stimulus.source.as_str()).collect();
        self.experiment == Experiment::HumanLikeness && sources.len() > 1
    }

    /// The numbers of the experiment.
    #[must_use]
    pub fn numbers(&self) -> Numbers {
        let videos = self.stimuli.len().max(1);
        let groups = self.groups();
        let (wanted, published) = match self.experiment {
            Experiment::Interactions => (10, 8),
            Experiment::HumanLikeness => (18, 20),
            Experiment::Relations => (10, 20),
        };
        let least = groups.iter().map(|group| group.for_one).min().unwrap_or(1).max(1);
        let least = u32::try_from(least).unwrap_or(u32::MAX);
        let is_as_published = groups.iter().all(|group| group.videos >= PUBLISHED_VIDEOS);
        let each = match self.videos_per_rater {
            Some(each) => each,
            None if is_as_published => published.min(least),
            None => least,
        };
        let needed = raters_needed(&groups, wanted, each);
        let raters = match self.experiment.raters_per_hundred_videos() {
            Some(share) if each == published => {
                u32::try_from((videos * share).div_ceil(100)).unwrap_or(u32::MAX).max(needed)
            }
            _ => needed,
        };
        let most = match self.experiment {
            Experiment::Relations => 19,
            _ => {
                u32::try_from((u64::from(raters) * u64::from(each)).div_ceil(videos as u64)).unwrap_or(wanted)
            }
        };
        Numbers {
            raters_per_video: wanted,
            raters_per_video_at_most: most.max(wanted),
            videos_per_rater: each,
            raters,
        }
    }

    /// The groups of videos of which a rater sees one.
    fn groups(&self) -> Vec<GroupSize> {
        let mut groups = BTreeMap::<&str, Vec<&Stimulus>>::new();
        for stimulus in &self.stimuli {
            let source = if self.between_sources() { stimulus.source.as_str() } else { "" };
            groups.entry(source).or_default().push(stimulus);
        }
        let size = |stimuli: Vec<&Stimulus>| GroupSize::of(stimuli, self.one_of_each_set);
        groups.into_values().map(size).collect()
    }

    /// The configuration as a file for people to edit, with comments.
    #[must_use]
    pub fn to_text(&self) -> String {
        text::file(self)
    }
}

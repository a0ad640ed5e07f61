//! Configurations to start from: the paper's experiments, for given videos.

mod goals;
mod text;

pub use goals::known_goals;

use crate::{
    config::{CatchTrial, Stimulus, raters_needed},
    forms::Form,
};
use std::collections::BTreeSet;

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

    /// The numbers of the experiment, in proportion to the number of videos.
    #[must_use]
    pub fn numbers(&self) -> Numbers {
        let videos = self.stimuli.len().max(1);
        let groups: Vec<usize> = if self.between_sources() {
            let sources: BTreeSet<&str> =
                self.stimuli.iter().map(|stimulus| stimulus.source.as_str()).collect();
            let count =
                |source: &&str| self.stimuli.iter().filter(|stimulus| stimulus.source == **source).count();
            sources.iter().map(count).collect()
        } else {
            vec![videos]
        };
        let (wanted, each) = match self.experiment {
            Experiment::Interactions => (10, 8),
            Experiment::HumanLikeness => (18, 20),
            Experiment::Relations => (10, 20),
        };
        let each = u32::try_from(groups.iter().copied().min().unwrap_or(1).max(1)).unwrap_or(each).min(each);
        let needed = raters_needed(&groups, wanted, each);
        let raters = match self.experiment.raters_per_hundred_videos() {
            None => needed,
            Some(share) => u32::try_from((videos * share).div_ceil(100)).unwrap_or(u32::MAX).max(needed),
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

    /// The configuration as a file for people to edit, with comments.
    #[must_use]
    pub fn to_text(&self) -> String {
        text::file(self)
    }
}

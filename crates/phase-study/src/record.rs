//! Records of raters, and the rule by which they count.

use crate::{
    config::{CatchTrial, StudyConfig},
    question::{Given, Responses},
};
#[cfg(feature = "store")]
use crate::{forms::Forms, question::Question};
use std::collections::BTreeMap;

/// A moment: milliseconds since 1970-01-01 UTC.
pub type Millis = i64;

/// Longest response time that is believed (ms): a week.
#[cfg(feature = "store")]
pub(crate) const LONGEST_RESPONSE: i64 = 7 * 24 * 3600 * 1000;
/// Most plays that are believed.
#[cfg(feature = "store")]
pub(crate) const MOST_PLAYS: i64 = 10_000;

/// The way in which a rater left.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Departure {
    /// It did not agree to take part.
    Declined,
    /// It withdrew; its answers are deleted.
    Withdrew,
}

/// An answer to a trial.
#[derive(Clone, PartialEq, Debug)]
pub struct GivenAnswer {
    /// Time at which the answer was stored.
    pub at: Millis,
    /// The answer.
    pub answer: Responses,
    /// Time from the first sight of the trial until the answer, as the rater's browser measured it (ms).
    pub response_time: i64,
    /// Number of times that the video was played to its end.
    pub plays: i64,
}

/// A trial of a rater.
#[derive(Clone, PartialEq, Debug)]
pub struct Trial {
    /// The id of its stimulus or catch trial.
    pub shown: String,
    /// Whether it is a catch trial.
    pub catch: bool,
    /// The answer, if there is one.
    pub given: Option<GivenAnswer>,
}

/// All that is stored of a rater.
#[derive(Clone, PartialEq, Debug)]
pub struct Rater {
    /// Its number, from 1, in the order in which raters came.
    pub number: u64,
    /// Time at which the rater came.
    pub joined: Millis,
    /// Members of the address with which it came; empty after it left.
    pub parameters: BTreeMap<String, String>,
    /// The way in which the rater left, if it did.
    pub departure: Option<Departure>,
    /// Time at which the rater agreed to take part.
    pub consented: Option<Millis>,
    /// Time and answers to the questions about the rater.
    pub demographics: Option<(Millis, Responses)>,
    /// Time at which the rater had read the instructions.
    pub instructed: Option<Millis>,
    /// Its trials in order; empty before it agreed.
    pub trials: Vec<Trial>,
}

/// The progress of a rater.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Standing {
    /// It has not answered everything, and has not left.
    Unfinished,
    /// It has answered everything, and failed more catch trials than allowed.
    Failed,
    /// It has answered everything and counts.
    Complete,
    /// It did not agree.
    Declined,
    /// It withdrew.
    Withdrawn,
}

impl Standing {
    /// The name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Unfinished => "unfinished",
            Self::Failed => "failed",
            Self::Complete => "complete",
            Self::Declined => "declined",
            Self::Withdrawn => "withdrawn",
        }
    }
}

impl Rater {
    /// The rater's progress.
    #[must_use]
    pub fn standing(&self, config: &StudyConfig) -> Standing {
        match self.departure {
            Some(Departure::Declined) => return Standing::Declined,
            Some(Departure::Withdrew) => return Standing::Withdrawn,
            None => {}
        }
        if self.trials.is_empty() || self.trials.iter().any(|trial| trial.given.is_none()) {
            return Standing::Unfinished;
        }
        let failures = self.catch_failures(config);
        if failures > config.catch_failures_allowed as usize { Standing::Failed } else { Standing::Complete }
    }

    /// Number of catch trials that the rater answered wrongly.
    #[must_use]
    pub fn catch_failures(&self, config: &StudyConfig) -> usize {
        let wrong = |trial: &&Trial| matches!(trial.passed(config), Some(false));
        self.trials.iter().filter(wrong).count()
    }

    /// Time of the rater's last sign.
    #[cfg(feature = "store")]
    #[must_use]
    pub(crate) fn last_seen(&self) -> Millis {
        let answers = self.trials.iter().filter_map(|trial| trial.given.as_ref()).map(|given| given.at);
        let pages = [self.consented, self.demographics.as_ref().map(|(at, _)| *at), self.instructed];
        answers.chain(pages.into_iter().flatten()).fold(self.joined, Millis::max)
    }

    /// The trial that it has to answer next: index from 0.
    #[must_use]
    pub fn next_trial(&self) -> Option<usize> {
        self.trials.iter().position(|trial| trial.given.is_none())
    }
}

impl Trial {
    /// Its questions.
    #[cfg(feature = "store")]
    pub(crate) fn questions(&self, config: &StudyConfig, forms: &Forms) -> Vec<Question> {
        let objects = if self.catch {
            config.catch_trial(&self.shown).map(|trial| trial.objects)
        } else {
            config.stimulus(&self.shown).map(|stimulus| stimulus.objects)
        };
        forms.questions(config.form, objects.unwrap_or_default())
    }

    /// Of an answered catch trial, whether the answer is right.
    #[must_use]
    pub fn passed(&self, config: &StudyConfig) -> Option<bool> {
        let given = self.given.as_ref()?;
        let trial = self.catch.then(|| config.catch_trial(&self.shown)).flatten()?;
        Some(trial.passed_by(&given.answer))
    }
}

impl CatchTrial {
    /// Whether an answer is right: of a question with one answer it is among those expected, of one with
    /// several all that are expected are among it.
    #[must_use]
    pub(crate) fn passed_by(&self, answer: &Responses) -> bool {
        self.expected.iter().all(|(question, expected)| match answer.get(question) {
            Some(Given::Many(several)) => expected.is_subset(several),
            Some(given) => expected.iter().any(|choice| given.has(choice)),
            None => false,
        })
    }
}

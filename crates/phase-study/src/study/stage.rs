//! Stages: everything that a rater's page shows, one after the other.

use super::Given;
use crate::{
    config::StudyConfig,
    question::Question,
    record::{Departure, Rater},
};
use serde::Serialize;

/// The page that a rater sees. As JSON it has the member `page` (`consent`, `demographics`, `instructions`,
/// `trial`, `done`, `declined`, `withdrawn`, `full`) and those of the page.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(tag = "page", rename_all = "lowercase")]
pub enum Stage {
    /// The question whether they agree to take part.
    Consent {
        /// The title of the study.
        title: String,
        /// Paragraphs about it.
        introduction: Vec<String>,
        /// The paragraphs that the rater agrees to.
        consent: Vec<String>,
    },
    /// Questions about the rater.
    Demographics {
        /// The questions about the rater.
        questions: Vec<Question>,
    },
    /// Instructions before the first video.
    Instructions {
        /// In paragraphs.
        instructions: Vec<String>,
    },
    /// A video and the questions about it.
    Trial(TrialPage),
    /// Everything is answered.
    Done {
        /// A code that shows it.
        #[serde(skip_serializing_if = "Option::is_none")]
        code: Option<String>,
        /// Address to go to.
        #[serde(skip_serializing_if = "Option::is_none")]
        url: Option<String>,
    },
    /// The rater did not agree.
    Declined,
    /// The rater withdrew.
    Withdrawn,
    /// The study has all raters that it wants, at this time.
    Full,
}

/// A trial as a rater sees it. Nothing in it tells which trials are catch trials.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct TrialPage {
    /// Its number, from 1.
    pub trial: usize,
    /// Number of trials.
    pub trials: usize,
    /// The address of the video, relative to that of the study.
    pub video: String,
    /// The questions about the video.
    pub questions: Vec<Question>,
    /// Whether it may be answered before the video has been played to its end.
    pub answer_before_end: bool,
}

/// The first stage.
pub(super) fn consent(config: &StudyConfig) -> Stage {
    Stage::Consent {
        title: config.title.clone(),
        introduction: config.introduction.clone(),
        consent: config.consent.clone(),
    }
}

/// The stage at which a rater is.
pub(super) fn of(given: Given<'_>, rater: &Rater) -> Stage {
    let Given { config, forms, names } = given;
    match rater.departure {
        Some(Departure::Declined) => return Stage::Declined,
        Some(Departure::Withdrew) => return Stage::Withdrawn,
        None => {}
    }
    if rater.consented.is_none() {
        return consent(config);
    }
    if rater.demographics.is_none() && !config.demographics.is_empty() {
        return Stage::Demographics { questions: config.demographics.clone() };
    }
    if rater.instructed.is_none() {
        return Stage::Instructions { instructions: config.instructions.clone() };
    }
    let Some(k) = rater.next_trial() else {
        return Stage::Done { code: config.completion.code.clone(), url: config.completion.url.clone() };
    };
    let trial = &rater.trials[k];
    Stage::Trial(TrialPage {
        trial: k + 1,
        trials: rater.trials.len(),
        video: format!("videos/{}.mp4", names.of(&trial.shown)),
        questions: trial.questions(config, forms),
        answer_before_end: config.answer_before_end,
    })
}

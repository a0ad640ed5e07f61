//! The answers of raters who count, by video.

use super::Coverage;
use crate::{
    config::{Stimulus, StudyConfig},
    question::{Given, Responses},
    record::{Rater, Standing},
};
use std::collections::BTreeMap;

/// A video and what raters said of it.
pub(super) struct Judged<'a> {
    pub(super) stimulus: &'a Stimulus,
    pub(super) answers: Vec<&'a Responses>,
}

/// All videos with at least one judgement, in the order of the configuration.
pub(super) struct Judgements<'a>(pub(super) Vec<Judged<'a>>);

impl<'a> Judgements<'a> {
    pub(super) fn of(config: &'a StudyConfig, raters: &'a [Rater]) -> Self {
        let mut answers = BTreeMap::<&str, Vec<&Responses>>::new();
        for rater in raters.iter().filter(|rater| rater.standing(config) == Standing::Complete) {
            for trial in rater.trials.iter().filter(|trial| !trial.catch) {
                if let Some(given) = &trial.given {
                    answers.entry(&trial.shown).or_default().push(&given.answer);
                }
            }
        }
        let judged = config
            .stimuli
            .iter()
            .filter_map(|stimulus| Some(Judged { stimulus, answers: answers.remove(stimulus.id.as_str())? }));
        Self(judged.collect())
    }

    /// Those of one source, or all.
    pub(super) fn from<'b>(&'b self, source: Option<&'b str>) -> impl Iterator<Item = &'b Judged<'a>> {
        self.0.iter().filter(move |judged| source.is_none_or(|source| judged.stimulus.source == source))
    }

    pub(super) fn coverage(&self, videos: usize) -> Coverage {
        let counts = || self.0.iter().map(|judged| judged.answers.len());
        let least = if self.0.len() < videos { 0 } else { counts().min().unwrap_or_default() };
        Coverage {
            videos,
            judged: self.0.len(),
            judgements: counts().sum(),
            least,
            most: counts().max().unwrap_or_default(),
        }
    }
}

impl Judged<'_> {
    /// Numbers of raters who gave each choice of a question.
    pub(super) fn counts(&self, question: &str, choices: &[&str]) -> Vec<usize> {
        let count = |choice: &&str| self.given(question).filter(|given| given.has(choice)).count();
        choices.iter().map(count).collect()
    }

    /// The answers to a question.
    pub(super) fn given(&self, question: &str) -> impl Iterator<Item = &Given> {
        self.answers.iter().filter_map(move |answer| answer.get(question))
    }
}

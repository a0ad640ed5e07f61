//! Task 1: accuracy of goals and relations.

use super::{
    Answers,
    answers::{AnswerSource, PredictionsFile},
    input::{Event, Input},
    methods,
    ratings::Ratings,
    task::Task,
};
use crate::{error::RunError, listener::Listener};
use phase_eval::{
    goals::{Answer, Label, PartialAnswer, RecognisedEvent, SocialRole},
    predictions,
    ratings::RatingCounts,
};
use phase_event::{MethodError, ObservedEvent, ProgressCallback, Recogniser, Recording};
use phase_model::arena::STEP_VIDEO_SECONDS;
use serde_json::{Value, json};
use std::path::Path;

/// The task.
pub(crate) struct Goals {
    answers: AnswerSource<dyn Recogniser, Answer>,
    /// Prefixes of each event to evaluate too, by their lengths (s).
    watched: Vec<f64>,
    /// Ratings of the events by people, if they were asked.
    ratings: Option<Ratings>,
}

impl Goals {
    /// The task for answers to some events.
    pub(crate) fn of(answers: &Answers, input: &Input, listener: &dyn Listener) -> Result<Self, RunError> {
        let file = |file: &Path| {
            PredictionsFile::read(file, input, listener, predictions::goals, |_, answer| Ok(answer))
        };
        AnswerSource::of(answers, methods::recogniser, file).map(Self::from)
    }

    /// Asks a method also after these numbers of seconds; those of a file are of whole events.
    pub(crate) fn with_watched(self, watched: Vec<f64>) -> Self {
        if self.answers.is_external() { self } else { Self { watched, ..self } }
    }

    /// Adds people's ratings of the events.
    pub(crate) fn with_ratings(self, ratings: Option<Ratings>) -> Self {
        Self { ratings, ..self }
    }
}

impl From<AnswerSource<dyn Recogniser, Answer>> for Goals {
    fn from(answers: AnswerSource<dyn Recogniser, Answer>) -> Self {
        Self { answers, watched: Vec::new(), ratings: None }
    }
}

impl Task for Goals {
    type Method = dyn Recogniser;
    type Answer = Answer;
    type ScoredEvent = RecognisedEvent;

    const NAME: &'static str = "goals";

    fn answers(&self) -> &AnswerSource<dyn Recogniser, Answer> {
        &self.answers
    }

    fn settings(&self) -> Value {
        let mut settings =
            self.answers.settings(|method| json!({ "method": method.settings(), "watched": self.watched }));
        if let Some(ratings) = &self.ratings {
            settings["ratings_sha256"] = ratings.sha256.as_str().into();
        }
        settings
    }

    fn ticks(&self) -> usize {
        self.answers.method().map_or(1, |method| method.ticks() * (1 + self.watched.len()))
    }

    fn check(&self, event: &Event, file: &Path) -> Result<(), RunError> {
        if event.steps > 0 {
            return Ok(());
        }
        let needed = "goals and relations are recognised from motion";
        Err(RunError::StartAlone { file: file.to_owned(), id: event.id.clone(), needed })
    }

    fn ask(
        &self,
        event: &Event,
        recording: &Recording,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> Result<Option<RecognisedEvent>, MethodError> {
        let observed = recording.observed().map_err(MethodError::new)?;
        let asked = self.answers.answer(event, |method| judge(method, &observed, seed, tick))?;
        let Some((answer, details, cpu_seconds)) = asked else { return Ok(None) };
        let mut watched = Vec::with_capacity(self.watched.len());
        if let Some(method) = self.answers.method() {
            for &seconds in &self.watched {
                let part = observed.prefix(steps_of(seconds));
                let Some((answer, _)) = judge(method, &part, seed, tick)? else { return Ok(None) };
                watched.push(PartialAnswer { seconds, answer });
            }
        }
        let ratings = self.ratings.as_ref().and_then(|ratings| ratings.of(&event.id));
        let label = label(event, recording, ratings);
        Ok(Some(RecognisedEvent { id: event.id.clone(), answer, label, watched, cpu_seconds, details }))
    }
}

/// Seconds of video in steps; both are exact, for there are four steps in a second.
fn steps_of(seconds: f64) -> usize {
    (seconds / STEP_VIDEO_SECONDS) as usize
}

pub(super) fn judge(
    method: &dyn Recogniser,
    observed: &ObservedEvent,
    seed: u64,
    tick: ProgressCallback<'_>,
) -> Result<Option<(Answer, Value)>, MethodError> {
    let Some((judgement, details)) = method.judge(observed, seed, tick)? else { return Ok(None) };
    let answer = Answer::of(&judgement)?;
    Ok(Some((answer, details)))
}

fn label(event: &Event, recording: &Recording, ratings: Option<RatingCounts>) -> Label {
    Label {
        kind: recording.scene.kind,
        goals: recording.scene.goals(),
        relation: recording.relation,
        relation_human: recording.relation_human,
        layout_seen: event.layout_seen,
        role: SocialRole::of(recording.scene.attitudes()),
        ratings,
        set: event.set.clone(),
    }
}

//! Task 1: accuracy of goals and relations.

use super::{
    Answers,
    answers::{AnswerSource, PredictionsFile},
    input::{Event, Input},
    methods,
    ratings::Ratings,
    task::Task,
};
use crate::{effort::MindChoice, error::RunError, listener::Listener};
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
    name: String,
    answers: AnswerSource<dyn Recogniser, Answer>,
    /// Prefixes of each event to evaluate too, by their lengths (s).
    watched: Vec<f64>,
    /// Ratings of the events by people, if they were asked.
    ratings: Option<Ratings>,
}

impl Goals {
    /// The task for answers to some events.
    ///
    /// # Errors
    /// If there is no such method or file, or the file cannot be used.
    pub(crate) fn of(answers: &Answers, input: &Input, listener: &dyn Listener) -> Result<Self, RunError> {
        match answers {
            Answers::Predictions(file) => {
                let given =
                    PredictionsFile::read(file, input, listener, predictions::goals, |_, answer| Ok(answer))?;
                let name = given.name.clone();
                let answers = AnswerSource::PredictionsFile(given);
                Ok(Self { name, answers, watched: Vec::new(), ratings: None })
            }
            Answers::Method { name, weights, minds } => {
                Self::by_method(&minds.name(name), name, weights.as_deref(), minds)
            }
        }
    }

    /// The task for one of PHASE's methods, under any name; see [`methods::recogniser`].
    ///
    /// # Errors
    /// If there is none of this name in this build, or its file of weights cannot be used.
    pub(crate) fn by_method(
        name: &str,
        method: &str,
        weights: Option<&Path>,
        minds: &MindChoice,
    ) -> Result<Self, RunError> {
        Ok(Self::by(name, methods::recogniser(method, weights, minds)?))
    }

    /// The task for any method, under any name.
    pub(crate) fn by(name: &str, method: Box<dyn Recogniser>) -> Self {
        let answers = AnswerSource::Method(method);
        Self { name: name.into(), answers, watched: Vec::new(), ratings: None }
    }

    /// Asks a method also after these numbers of seconds; those of a file are of whole events.
    pub(crate) fn with_watched(self, watched: Vec<f64>) -> Self {
        if self.is_external() { self } else { Self { watched, ..self } }
    }

    /// Adds people's ratings of the events.
    pub(crate) fn with_ratings(self, ratings: Option<Ratings>) -> Self {
        Self { ratings, ..self }
    }
}

impl Task for Goals {
    type ScoredEvent = RecognisedEvent;

    const NAME: &'static str = "goals";

    fn method(&self) -> &str {
        &self.name
    }

    fn is_external(&self) -> bool {
        self.answers.is_external()
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

fn judge(
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

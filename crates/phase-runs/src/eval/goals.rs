//! Task 1: accuracy of goals and relations.

use super::{
    answers::{AnswerSource, PredictionsFile},
    input::{Event, Input},
    methods,
    options::{EvalGoals, steps_of},
    ratings::Ratings,
    task::{self, Task},
};
use crate::{context::Context, effort::MindOptions, error::CliError};
use phase_eval::{
    goals::{Answer, Label, PartialAnswer, RecognisedEvent, SocialRole},
    predictions,
    ratings::RatingCounts,
};
use phase_event::{MethodError, ObservedEvent, ProgressCallback, Recogniser, Recording};
use serde_json::{Value, json};
use std::path::Path;

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub(super) fn run(arguments: &EvalGoals, context: &Context) -> Result<(), CliError> {
    let input = Input::open(&arguments.common, context)?;
    let ratings = arguments.ratings.as_deref();
    let ratings = ratings.map(|file| Ratings::read(file, &[&input], context)).transpose()?;
    let goals = match (&arguments.common.predictions, &arguments.method) {
        (Some(file), _) => {
            let given =
                PredictionsFile::read(file, &input, context, predictions::goals, |_, answer| Ok(answer))?;
            Goals {
                name: given.name.clone(),
                answers: AnswerSource::PredictionsFile(given),
                watched: Vec::new(),
                ratings,
            }
        }
        (None, method) => {
            let method = method.as_deref().unwrap_or_default();
            let mut watched = arguments.watched.clone();
            watched.sort_by(f64::total_cmp);
            watched.dedup();
            let minds = MindOptions::from(arguments.minds);
            Goals {
                watched,
                ratings,
                ..Goals::by_method(&minds.name(method), method, arguments.weights.as_deref(), &minds)?
            }
        }
    };
    task::run(&goals, &input, &arguments.common, context)
}

/// The task.
pub(crate) struct Goals {
    name: String,
    answers: AnswerSource<dyn Recogniser, Answer>,
    /// Prefixes of each event to evaluate too, by their lengths (s).
    watched: Vec<f64>,
    /// How people rated the events, if they were asked.
    ratings: Option<Ratings>,
}

impl Goals {
    /// The task for one of PHASE's methods, under any name; see [`methods::recogniser`].
    ///
    /// # Errors
    /// As there.
    pub(crate) fn by_method(
        name: &str,
        method: &str,
        weights: Option<&Path>,
        minds: &MindOptions,
    ) -> Result<Self, CliError> {
        let answers = AnswerSource::Method(methods::recogniser(method, weights, minds)?);
        Ok(Self { name: name.into(), answers, watched: Vec::new(), ratings: None })
    }

    /// The same with people's ratings of the events.
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

    fn check(&self, event: &Event, file: &Path) -> Result<(), CliError> {
        if event.steps > 0 {
            return Ok(());
        }
        let needed = "goals and relations are recognised from motion";
        Err(CliError::StartAlone { file: file.to_owned(), id: event.id.clone(), needed })
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

//! Task 2: how far predicted trajectories are off.

use super::{
    answers::{Answers, Given},
    input::{Event, Input},
    methods,
    options::EvalTrajectories,
    task::{self, Task},
};
use crate::{context::Context, error::CliError};
use cpu_time::ThreadTime;
use phase_eval::{
    Forecaster, MethodError, Tick, predictions, results,
    trajectories::{Errors, ForecastEvent, PREDICTED_STEPS, Summary, WATCHED_STEPS},
};
use phase_event::Recording;
use phase_model::Forecast;
use phase_report::{
    document::Document,
    evaluation::{self, Subject},
};
use serde_json::{Value, json};
use std::path::Path;

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub(super) fn run(arguments: &EvalTrajectories, context: &Context) -> Result<(), CliError> {
    let input = Input::open(&arguments.common, context)?;
    let task = match (&arguments.common.predictions, &arguments.method) {
        (Some(file), _) => {
            let fit = |event: &Event, forecast| {
                predictions::fit(&forecast, event.entities, steps_to_predict(event.steps))
            };
            let given = Given::read(file, &input, context, predictions::forecasts, fit)?;
            Trajectories { name: given.name.clone(), answers: Answers::Given(given) }
        }
        (None, method) => {
            let method = method.as_deref().unwrap_or_default();
            Trajectories::by_method(method, method, arguments.weights.as_deref())?
        }
    };
    task::run(&task, &input, &arguments.common, context)
}

/// The task.
pub(crate) struct Trajectories {
    name: String,
    answers: Answers<dyn Forecaster, Forecast>,
}

impl Trajectories {
    /// The task for one of our methods, under any name; see [`methods::forecaster`].
    ///
    /// # Errors
    /// As there.
    pub(crate) fn by_method(name: &str, method: &str, weights: Option<&Path>) -> Result<Self, CliError> {
        let answers = Answers::Method(methods::forecaster(method, weights)?);
        Ok(Self { name: name.into(), answers })
    }
}

impl Task for Trajectories {
    type Answered = ForecastEvent;

    const NAME: &'static str = "trajectories";

    fn method(&self) -> &str {
        &self.name
    }

    fn is_given(&self) -> bool {
        matches!(self.answers, Answers::Given(_))
    }

    fn settings(&self) -> Value {
        match &self.answers {
            Answers::Method(method) => json!({ "method": method.settings() }),
            Answers::Given(given) => given.settings(),
        }
    }

    fn ticks(&self) -> usize {
        match &self.answers {
            Answers::Method(method) => method.ticks(),
            Answers::Given(_) => 1,
        }
    }

    fn check(&self, event: &Event, file: &Path) -> Result<(), CliError> {
        if event.steps > WATCHED_STEPS {
            return Ok(());
        }
        let (file, id, steps) = (file.display(), &event.id, event.steps);
        Err(CliError::Usage(format!(
            "{file}: event {id} has {steps} steps; {WATCHED_STEPS} are watched and at least one more is to be predicted"
        )))
    }

    fn ask(
        &self,
        event: &Event,
        recording: &Recording,
        seed: u64,
        tick: Tick<'_>,
    ) -> Result<Option<ForecastEvent>, MethodError> {
        let observed = recording.observed().map_err(MethodError::new)?;
        let truth: Forecast = observed.entities().map(|entity| path(&observed, entity.index())).collect();
        let steps = truth.first().map_or(0, Vec::len);
        let (forecast, details, cpu_seconds) = match &self.answers {
            Answers::Given(given) => (given.answer(event)?, Value::Null, None),
            Answers::Method(method) => {
                let begun = ThreadTime::now();
                let forecast = method.forecast(&observed.watched_for(WATCHED_STEPS), steps, seed, tick)?;
                let cpu_seconds = begun.elapsed().as_secs_f64();
                let Some((forecast, details)) = forecast else { return Ok(None) };
                (forecast, details, Some(cpu_seconds))
            }
        };
        let [agents, entities] = Errors::of(&forecast, &truth)?;
        Ok(Some(ForecastEvent {
            id: event.id.clone(),
            kind: recording.scene.kind,
            relation: recording.relation,
            steps,
            agents,
            entities,
            forecast: forecast
                .iter()
                .map(|path| path.iter().map(|point| point.to_array()).collect())
                .collect(),
            cpu_seconds,
            details,
        }))
    }

    fn sum_up(
        &self,
        run: &Value,
        subject: Subject<'_>,
        events: &[ForecastEvent],
    ) -> Option<serde_json::Result<(Value, Document)>> {
        let summary = Summary::of(events, subject.seed)?;
        Some(
            results::trajectories(run, &summary, events)
                .map(|results| (results, evaluation::trajectories(subject, &summary))),
        )
    }
}

/// How many steps there are to predict in an event of so many.
fn steps_to_predict(steps: usize) -> usize {
    steps.saturating_sub(WATCHED_STEPS).min(PREDICTED_STEPS)
}

/// Where an entity went in the steps to be predicted.
fn path(observed: &phase_event::ObservedEvent, entity: usize) -> Vec<phase_model::Vec2> {
    let rows = observed.rows().iter().skip(1 + WATCHED_STEPS).take(PREDICTED_STEPS);
    rows.map(|row| row[entity].position).collect()
}

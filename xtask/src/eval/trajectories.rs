//! Task 2: how far predicted trajectories are off.

use super::{
    input::{Event, Input},
    methods,
    options::EvalTrajectories,
    task::{self, Task},
};
use crate::error::CliError;
use cpu_time::ThreadTime;
use phase_dataset::phase_events::Recording;
use phase_eval::{
    Forecaster, MethodError, Tick,
    report::{self, Document, Subject},
    results,
    trajectories::{Errors, ForecastEvent, PREDICTED_STEPS, Summary, WATCHED_STEPS},
};
use phase_model::Forecast;
use serde_json::{Value, json};

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub(super) fn run(arguments: &EvalTrajectories) -> Result<(), CliError> {
    let input = Input::open(&arguments.common)?;
    let name = arguments.method.clone();
    let method = methods::forecaster(&name, arguments.weights.as_deref())?;
    let file = arguments.common.events.display().to_string();
    task::run(&Trajectories { name, method, file }, &input, &arguments.common)
}

/// The task.
struct Trajectories {
    name: String,
    method: Box<dyn Forecaster>,
    file: String,
}

impl Task for Trajectories {
    type Answered = ForecastEvent;

    const NAME: &'static str = "trajectories";

    fn method(&self) -> &str {
        &self.name
    }

    fn settings(&self) -> Value {
        json!({ "method": self.method.settings() })
    }

    fn ticks(&self) -> usize {
        self.method.ticks()
    }

    fn check(&self, event: &Event) -> Result<(), CliError> {
        if event.steps > WATCHED_STEPS {
            return Ok(());
        }
        let (file, id, steps) = (&self.file, &event.id, event.steps);
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
        let observed = recording.observed().map_err(|error| MethodError(error.to_string()))?;
        let truth: Forecast = observed.entities().map(|entity| path(&observed, entity.index())).collect();
        let steps = truth.first().map_or(0, Vec::len);
        let begun = ThreadTime::now();
        let forecast = self.method.forecast(&observed.watched_for(WATCHED_STEPS), steps, seed, tick)?;
        let cpu_seconds = begun.elapsed().as_secs_f64();
        let Some((forecast, details)) = forecast else { return Ok(None) };
        let [agents, entities] =
            Errors::of(&forecast, &truth).map_err(|error| MethodError(error.to_string()))?;
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
            cpu_seconds: Some(cpu_seconds),
            details,
        }))
    }

    fn sum_up(
        &self,
        run: &Value,
        subject: Subject<'_>,
        events: &[ForecastEvent],
    ) -> Option<(Value, Document)> {
        let summary = Summary::of(events, subject.seed)?;
        Some((results::trajectories(run, &summary, events), report::trajectories(subject, &summary)))
    }
}

/// Where an entity went in the steps to be predicted.
fn path(observed: &phase_model::ObservedEvent, entity: usize) -> Vec<phase_model::Vec2> {
    let rows = observed.rows().iter().skip(1 + WATCHED_STEPS).take(PREDICTED_STEPS);
    rows.map(|row| row[entity].position).collect()
}

//! Task 2: errors of predicted trajectories.

use super::{
    Answers,
    answers::{AnswerSource, PredictionsFile},
    input::{Event, Input},
    methods,
    task::Task,
};
use crate::{error::RunError, listener::Listener};
use phase_eval::{
    predictions,
    trajectories::{Errors, ForecastEvent, PREDICTED_STEPS, SampleErrors, WATCHED_STEPS},
};
use phase_event::{Forecaster, MethodError, Prediction, ProgressCallback, Recording};
use phase_model::Forecast;
use serde_json::{Value, json};
use std::path::Path;

/// The task.
pub(crate) struct Trajectories {
    pub(crate) answers: AnswerSource<dyn Forecaster, Prediction>,
}

impl Trajectories {
    /// The task for answers to some events.
    pub(crate) fn of(answers: &Answers, input: &Input, listener: &dyn Listener) -> Result<Self, RunError> {
        let fit = |event: &Event, forecast| {
            predictions::fit_prediction(&forecast, event.entities, steps_to_predict(event.steps))
        };
        let file = |file: &Path| PredictionsFile::read(file, input, listener, predictions::forecasts, fit);
        Ok(Self { answers: AnswerSource::of(answers, methods::forecaster, file)? })
    }
}

impl Task for Trajectories {
    type Method = dyn Forecaster;
    type Answer = Prediction;
    type ScoredEvent = ForecastEvent;

    const NAME: &'static str = "trajectories";

    fn answers(&self) -> &AnswerSource<dyn Forecaster, Prediction> {
        &self.answers
    }

    fn settings(&self) -> Value {
        self.answers.settings(|method| json!({ "method": method.settings() }))
    }

    fn ticks(&self) -> usize {
        self.answers.method().map_or(1, Forecaster::ticks)
    }

    fn check(&self, event: &Event, file: &Path) -> Result<(), RunError> {
        if event.steps > WATCHED_STEPS {
            return Ok(());
        }
        let file = file.display();
        let id = &event.id;
        let steps = event.steps;
        Err(RunError::Usage(format!(
            "{file}: event {id} has {steps} steps; {WATCHED_STEPS} are watched and at least one more is to be predicted"
        )))
    }

    fn ask(
        &self,
        event: &Event,
        recording: &Recording,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> Result<Option<ForecastEvent>, MethodError> {
        let observed = recording.observed().map_err(MethodError::new)?;
        let truth: Forecast = observed.entities().map(|entity| path(&observed, entity.index())).collect();
        let steps = truth.first().map_or(0, Vec::len);
        let watched = observed.prefix(WATCHED_STEPS);
        let asked = self.answers.answer(event, |method| method.forecast(&watched, steps, seed, tick))?;
        let Some((prediction, details, cpu_seconds)) = asked else { return Ok(None) };
        let [agents, entities] = Errors::of(&prediction.forecast, &truth)?;
        let samples = SampleErrors::of(&prediction.samples, &truth)?;
        Ok(Some(ForecastEvent {
            id: event.id.clone(),
            kind: recording.scene.kind,
            relation: recording.relation,
            steps,
            agents,
            entities,
            samples,
            forecast: prediction
                .forecast
                .iter()
                .map(|path| path.iter().map(|point| point.to_array()).collect())
                .collect(),
            cpu_seconds,
            details,
        }))
    }
}

/// Number of steps to predict in an event with the given number of steps.
fn steps_to_predict(steps: usize) -> usize {
    steps.saturating_sub(WATCHED_STEPS).min(PREDICTED_STEPS)
}

/// The path of an entity in the steps to be predicted.
fn path(observed: &phase_event::ObservedEvent, entity: usize) -> Vec<phase_model::Vec2> {
    let rows = observed.rows().iter().skip(1 + WATCHED_STEPS).take(PREDICTED_STEPS);
    rows.map(|row| row[entity].position).collect()
}

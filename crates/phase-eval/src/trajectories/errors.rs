//! Errors of a prediction.

use super::SampleErrors;
use phase_event::MethodError;
use phase_model::{AGENT_COUNT, EventKind, Forecast, Relation, Vec2};
use phase_statistics::mean;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use thiserror::Error;

/// Why a prediction cannot be scored.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum ForecastError {
    /// There is no step to predict.
    #[error("there is no step to predict")]
    NoSteps,
    /// Not every entity has a position for every step.
    #[error("a prediction needs {entities} entities with {steps} positions each")]
    Shape {
        /// Entities of the event.
        entities: usize,
        /// Steps to predict.
        steps: usize,
    },
    /// A coordinate of a position is not a number.
    #[error("a predicted position of entity {entity} is not finite")]
    NotFinite {
        /// Its index.
        entity: usize,
    },
}

impl From<ForecastError> for MethodError {
    fn from(error: ForecastError) -> Self {
        Self::new(error)
    }
}

/// Distances between predicted and true positions (u), means over some entities.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Errors {
    /// Average displacement error: the mean over all steps.
    pub ade: f64,
    /// Final displacement error: that of the last step.
    pub fde: f64,
    /// The error of each step.
    pub by_step: Vec<f64>,
}

/// One event with a method's prediction and its errors.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct ForecastEvent {
    /// The event's name.
    pub id: String,
    /// The kind of event.
    pub kind: EventKind,
    /// Its relation.
    pub relation: Relation,
    /// Steps predicted.
    pub steps: usize,
    /// Errors over the two agents.
    pub agents: Errors,
    /// Errors over agents and objects.
    pub entities: Errors,
    /// Scores of the distribution of futures, if the method gave one.
    pub samples: Option<SampleErrors>,
    /// The predicted positions, `[x, y]` (u) by entity and step.
    pub forecast: Vec<Vec<[f32; 2]>>,
    /// CPU time for the prediction (s).
    pub cpu_seconds: Option<f64>,
    /// Details that the method attached.
    pub details: Value,
}

impl Errors {
    /// Errors over the two agents, and over all entities. Both are by entity, agents first, and by step.
    ///
    /// # Errors
    /// If there is no step, a shape differs or a number is not finite.
    pub fn of(forecast: &Forecast, truth: &Forecast) -> Result<[Self; 2], ForecastError> {
        let steps = truth.first().map_or(0, Vec::len);
        if steps == 0 || truth.len() < AGENT_COUNT {
            return Err(ForecastError::NoSteps);
        }
        let whole = |paths: &Forecast| paths.iter().all(|path| path.len() == steps);
        if forecast.len() != truth.len() || !whole(forecast) || !whole(truth) {
            return Err(ForecastError::Shape { entities: truth.len(), steps });
        }
        if let Some(entity) = forecast.iter().position(|path| !path.iter().all(|point| point.is_finite())) {
            return Err(ForecastError::NotFinite { entity });
        }
        Ok([AGENT_COUNT, truth.len()].map(|count| Self::over(&forecast[..count], &truth[..count], steps)))
    }

    fn over(forecast: &[Vec<Vec2>], truth: &[Vec<Vec2>], steps: usize) -> Self {
        let mut by_step = vec![0.0; steps];
        for (ours, theirs) in forecast.iter().zip(truth) {
            for ((sum, a), b) in by_step.iter_mut().zip(ours).zip(theirs) {
                // In double precision no distance between finite positions is infinite.
                *sum += a.as_dvec2().distance(b.as_dvec2()) / truth.len() as f64;
            }
        }
        let ade = mean(&by_step).unwrap_or_default();
        Self { ade, fde: by_step.last().copied().unwrap_or_default(), by_step }
    }
}

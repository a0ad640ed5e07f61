//! The interfaces of methods that perceive social events.

use crate::ObservedEvent;
use core::ops::ControlFlow;
use phase_model::{Forecast, Judgement};
use serde_json::Value;
use thiserror::Error;

/// Number of futures that a [`Forecaster`] is asked for, as usual in trajectory forecasting.
pub const SAMPLES: usize = 20;

/// The reason why a method has no answer to an event, in a sentence.
///
/// A caller can only report it, so methods wrap errors of their own:
///
/// ```
/// use phase_event::MethodError;
///
/// let error = MethodError::new("the event has no agents");
/// assert_eq!(error.to_string(), "the event has no agents");
/// ```
#[derive(Debug, Error)]
#[error("{0}")]
pub struct MethodError(#[source] Box<dyn core::error::Error + Send + Sync>);

impl MethodError {
    /// Wraps a method's own error, or a sentence that says why there is no answer.
    pub fn new(error: impl Into<Box<dyn core::error::Error + Send + Sync>>) -> Self {
        Self(error.into())
    }
}

/// A callback that a method calls from time to time while it works. The method stops with `Ok(None)` on
/// `Break`.
pub type ProgressCallback<'a> = &'a mut dyn FnMut() -> ControlFlow<()>;

/// An answer with details that the method attaches as JSON, or null; `None` if the method was cancelled.
pub type MethodResult<T> = Result<Option<(T, Value)>, MethodError>;

/// Predicted positions of all entities.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Prediction {
    /// One future: positions (u) by entity, agents first, and by step. Its displacement errors are reported.
    pub forecast: Forecast,
    /// [`SAMPLES`] equally likely futures of the same shape; empty if the method knows only one.
    pub samples: Vec<Forecast>,
}

impl From<Forecast> for Prediction {
    fn from(forecast: Forecast) -> Self {
        Self { forecast, samples: Vec::new() }
    }
}

/// A method for Task 1 of the paper, the joint inference of both agents' goals and of their relation.
///
/// All randomness of a method comes from the seed: the same event and the same seed give the same answer. A
/// method runs on the calling thread alone, because the other cores process other events and its CPU time is
/// that of the thread. It sees an [`ObservedEvent`], which has no labels.
///
/// ```
/// use core::ops::ControlFlow;
/// use phase_event::{MethodResult, ObservedEvent, ProgressCallback, Recogniser};
/// use phase_model::{Body, Judgement, Layout, RelationProbabilities, Size};
///
/// /// Takes every pair of agents for friends.
/// struct Optimist;
///
/// impl Recogniser for Optimist {
///     fn judge(&self, _: &ObservedEvent, _: u64, _: ProgressCallback<'_>) -> MethodResult<Judgement> {
///         let relation = RelationProbabilities { friendly: 1.0, adversarial: 0.0, neutral: 0.0 };
///         Ok(Some((Judgement { relation, ..Judgement::default() }, serde_json::Value::Null)))
///     }
/// }
///
/// let rows = vec![[Body::default(); 4]];
/// let observed = ObservedEvent::new(Layout::new(0, None)?, [Size::Small; 2], Vec::new(), rows)?;
/// let judged = Optimist.judge(&observed, 1, &mut || ControlFlow::Continue(()))?;
/// assert_eq!(judged.map(|(judgement, _)| judgement.relation.friendly), Some(1.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Recogniser: Sync {
    /// The settings that determine the answers beside event and seed, to be stored with the answers; null for
    /// a method without settings.
    fn settings(&self) -> Value {
        Value::Null
    }

    /// Approximate number of calls of the [`ProgressCallback`] for one event, at least 1, to estimate the
    /// remaining time.
    fn ticks(&self) -> usize {
        1
    }

    /// The probabilities of each agent's goals and of the relation, given the rows observed so far.
    ///
    /// Probabilities are 0 to 1. Goals may be listed in any order, and those that a list lacks have
    /// probability 0.
    ///
    /// # Errors
    /// [`MethodError`] if the method has no answer for such an event.
    fn judge(
        &self,
        observed: &ObservedEvent,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> MethodResult<Judgement>;
}

/// A method for Task 2 of the paper, the prediction of the trajectories of all entities.
///
/// A [`Recogniser`]'s rules for seeds and threads hold for it too.
pub trait Forecaster: Sync {
    /// The settings that determine the answers beside event and seed, to be stored with the answers; null for
    /// a method without settings.
    fn settings(&self) -> Value {
        Value::Null
    }

    /// Approximate number of calls of the [`ProgressCallback`] for one event, at least 1, to estimate the
    /// remaining time.
    fn ticks(&self) -> usize {
        1
    }

    /// The positions (u) of all entities in the next `steps` steps of 1/12 s, and [`SAMPLES`] equally likely
    /// futures beside them, if the method knows several.
    ///
    /// # Errors
    /// [`MethodError`] if the method has no answer for such an event.
    fn forecast(
        &self,
        observed: &ObservedEvent,
        steps: usize,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> MethodResult<Prediction>;
}

//! The interface of a method of social perception.

use crate::{
    goals::InvalidAnswer,
    trajectories::{ForecastError, Prediction},
};
use core::ops::ControlFlow;
use phase_event::ObservedEvent;
use phase_model::Judgement;
use serde_json::Value;
use thiserror::Error;

/// Why there is no answer to an event, in a sentence.
#[derive(Debug, Error)]
pub enum MethodError {
    /// The method gave none, for the reason stated.
    #[error("{0}")]
    NoAnswer(#[source] Box<dyn core::error::Error + Send + Sync>),
    /// The probabilities of goals or relations are invalid.
    #[error("the method's {0}")]
    Answer(#[from] InvalidAnswer),
    /// The predicted positions cannot be compared with the true ones.
    #[error(transparent)]
    Forecast(#[from] ForecastError),
}

impl MethodError {
    /// The error of a method that gives no answer, or a sentence that says why.
    pub fn new(error: impl Into<Box<dyn core::error::Error + Send + Sync>>) -> Self {
        Self::NoAnswer(error.into())
    }
}

/// Called periodically while a method works; the method stops with `Ok(None)` on `Break`.
pub type ProgressCallback<'a> = &'a mut dyn FnMut() -> ControlFlow<()>;

/// An answer with optional details; `None` if the method was cancelled.
pub type MethodResult<T> = Result<Option<(T, Value)>, MethodError>;

/// A method for Task 1, joint inference of goals and relations.
///
/// All randomness of a method comes from the seed, and it runs on the calling thread only: the other cores
/// process other events, and its CPU time is that thread's.
pub trait Recogniser: Sync {
    /// The settings that determine the answers beside event and seed, to be stored with them; null for a
    /// method without settings.
    fn settings(&self) -> Value {
        Value::Null
    }

    /// About how often [`ProgressCallback`] is called for an event, to estimate the remaining time.
    fn ticks(&self) -> usize {
        1
    }

    /// The agents' goals and relation, given what has been seen so far.
    ///
    /// # Errors
    /// If the method has no answer for such an event.
    fn judge(
        &self,
        observed: &ObservedEvent,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> MethodResult<Judgement>;
}

/// A method for Task 2, multi-entity trajectory prediction. See [`Recogniser`] for seeds and threads.
pub trait Forecaster: Sync {
    /// The settings that determine the answers beside event and seed, to be stored with them; null for a
    /// method without settings.
    fn settings(&self) -> Value {
        Value::Null
    }

    /// About how often [`ProgressCallback`] is called for an event, to estimate the remaining time.
    fn ticks(&self) -> usize {
        1
    }

    /// The positions of all entities in the next `steps` steps, and equally likely ones beside them, if the method knows several.
    ///
    /// # Errors
    /// If the method has no answer for such an event.
    fn forecast(
        &self,
        observed: &ObservedEvent,
        steps: usize,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> MethodResult<Prediction>;
}

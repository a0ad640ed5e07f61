//! What a method of perception has to be.

use crate::{goals::AnswerError, trajectories::ForecastError};
use core::ops::ControlFlow;
use phase_event::ObservedEvent;
use phase_model::{Forecast, Judgement};
use serde_json::Value;
use thiserror::Error;

/// Why there is no answer to an event, in a sentence.
#[derive(Debug, Error)]
pub enum MethodError {
    /// The method gave none, for a reason of its own.
    #[error("{0}")]
    NoAnswer(#[source] Box<dyn core::error::Error + Send + Sync>),
    /// The probabilities of goals or relations that it gave are none.
    #[error("the method's {0}")]
    Answer(#[from] AnswerError),
    /// The positions that it predicted cannot be compared with those that came.
    #[error(transparent)]
    Forecast(#[from] ForecastError),
}

impl MethodError {
    /// The error of a method that gives no answer, or a sentence that says why.
    pub fn new(error: impl Into<Box<dyn core::error::Error + Send + Sync>>) -> Self {
        Self::NoAnswer(error.into())
    }
}

/// To be called now and then while a method thinks; the method gives up, with `Ok(None)`, when told to break.
pub type Tick<'a> = &'a mut dyn FnMut() -> ControlFlow<()>;

/// An answer, and whatever the method wants to have kept beside it; `None` if it was told to break.
pub type Answered<T> = Result<Option<(T, Value)>, MethodError>;

/// A method for Task 1, joint inference of goals and relations.
///
/// Everything a method draws comes from the seed, and it thinks on the calling thread alone: other events are at
/// work on the other cores, and its CPU time is that thread's.
pub trait Recogniser: Sync {
    /// What decides the answers beside event and seed, to be kept with them; null for a method without settings.
    fn settings(&self) -> Value {
        Value::Null
    }

    /// About how often [`Tick`] is called for an event, for the time left.
    fn ticks(&self) -> usize {
        1
    }

    /// What the agents want and how they relate, given what has been seen so far.
    ///
    /// # Errors
    /// If the method has no answer for such an event.
    fn judge(&self, observed: &ObservedEvent, seed: u64, tick: Tick<'_>) -> Answered<Judgement>;
}

/// A method for Task 2, multi-entity trajectory prediction. See [`Recogniser`] for seeds and threads.
pub trait Forecaster: Sync {
    /// What decides the answers beside event and seed, to be kept with them; null for a method without settings.
    fn settings(&self) -> Value {
        Value::Null
    }

    /// About how often [`Tick`] is called for an event, for the time left.
    fn ticks(&self) -> usize {
        1
    }

    /// Where every entity will be in the next `steps` steps.
    ///
    /// # Errors
    /// If the method has no answer for such an event.
    fn forecast(
        &self,
        observed: &ObservedEvent,
        steps: usize,
        seed: u64,
        tick: Tick<'_>,
    ) -> Answered<Forecast>;
}

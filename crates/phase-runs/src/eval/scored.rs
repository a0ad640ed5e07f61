//! Common parts of the answers to both tasks once they are compared with the labels.

use phase_document::document::Document;
use phase_eval::{
    beliefs::{BeliefEvent, BeliefSummary},
    goals::{ErrorBreakdown, RecognisedEvent, RecognitionSummary},
    intents::{IntentEvent, IntentSummary},
    results::{self, BELIEFS_FORMAT, GOALS_FORMAT, INTENTS_FORMAT, TRAJECTORIES_FORMAT},
    trajectories::{ForecastEvent, ForecastSummary},
};
use phase_report::evaluation::{self, Subject};
use serde::{Serialize, de::DeserializeOwned};
use serde_json::Value;

/// An event with a method's answer.
pub(crate) trait ScoredEvent: Serialize + DeserializeOwned + Clone + Send {
    /// The scores over many.
    type Summary;

    /// The value of the field `format` of results.
    const FORMAT: &'static str;

    /// The event's name.
    fn id(&self) -> &str;

    /// The CPU time for the answer (s), if it was measured.
    fn cpu_seconds(&mut self) -> &mut Option<f64>;

    /// The scores over some events; `None` without any. The seed is that of intervals.
    fn sum_up(events: &[Self], seed: u64) -> Option<Self::Summary>;

    /// Error breakdown of goals, for Task 1.
    fn mistakes(_events: &[Self]) -> Option<ErrorBreakdown> {
        None
    }

    /// Results for programs.
    ///
    /// # Errors
    /// If a part of them cannot be written as JSON.
    fn results(run: &Value, summary: &Self::Summary, events: &[Self]) -> serde_json::Result<Value>;

    /// The report for people.
    fn report(subject: Subject<'_>, summary: &Self::Summary) -> Document;
}

impl ScoredEvent for RecognisedEvent {
    type Summary = RecognitionSummary;

    const FORMAT: &'static str = GOALS_FORMAT;

    fn id(&self) -> &str {
        &self.id
    }

    fn cpu_seconds(&mut self) -> &mut Option<f64> {
        &mut self.cpu_seconds
    }

    fn sum_up(events: &[Self], seed: u64) -> Option<Self::Summary> {
        RecognitionSummary::of(events, seed)
    }

    fn mistakes(events: &[Self]) -> Option<ErrorBreakdown> {
        Some(ErrorBreakdown::of(events))
    }

    fn results(run: &Value, summary: &Self::Summary, events: &[Self]) -> serde_json::Result<Value> {
        results::goals(run, summary, events)
    }

    fn report(subject: Subject<'_>, summary: &Self::Summary) -> Document {
        evaluation::goals(subject, summary)
    }
}

impl ScoredEvent for ForecastEvent {
    type Summary = ForecastSummary;

    const FORMAT: &'static str = TRAJECTORIES_FORMAT;

    fn id(&self) -> &str {
        &self.id
    }

    fn cpu_seconds(&mut self) -> &mut Option<f64> {
        &mut self.cpu_seconds
    }

    fn sum_up(events: &[Self], seed: u64) -> Option<Self::Summary> {
        ForecastSummary::of(events, seed)
    }

    fn results(run: &Value, summary: &Self::Summary, events: &[Self]) -> serde_json::Result<Value> {
        results::trajectories(run, summary, events)
    }

    fn report(subject: Subject<'_>, summary: &Self::Summary) -> Document {
        evaluation::trajectories(subject, summary)
    }
}

impl ScoredEvent for BeliefEvent {
    type Summary = BeliefSummary;

    const FORMAT: &'static str = BELIEFS_FORMAT;

    fn id(&self) -> &str {
        &self.id
    }

    fn cpu_seconds(&mut self) -> &mut Option<f64> {
        &mut self.cpu_seconds
    }

    fn sum_up(events: &[Self], seed: u64) -> Option<Self::Summary> {
        BeliefSummary::of(events, seed)
    }

    fn results(run: &Value, summary: &Self::Summary, events: &[Self]) -> serde_json::Result<Value> {
        results::beliefs(run, summary, events)
    }

    fn report(subject: Subject<'_>, summary: &Self::Summary) -> Document {
        evaluation::beliefs(subject, summary)
    }
}

impl ScoredEvent for IntentEvent {
    type Summary = IntentSummary;

    const FORMAT: &'static str = INTENTS_FORMAT;

    fn id(&self) -> &str {
        &self.id
    }

    fn cpu_seconds(&mut self) -> &mut Option<f64> {
        &mut self.cpu_seconds
    }

    fn sum_up(events: &[Self], seed: u64) -> Option<Self::Summary> {
        IntentSummary::of(events, seed)
    }

    fn results(run: &Value, summary: &Self::Summary, events: &[Self]) -> serde_json::Result<Value> {
        results::intents(run, summary, events)
    }

    fn report(subject: Subject<'_>, summary: &Self::Summary) -> Document {
        evaluation::intents(subject, summary)
    }
}

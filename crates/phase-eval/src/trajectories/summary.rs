//! Displacement errors of a method over many events.

use super::{Errors, ForecastEvent, PREDICTED_STEPS, SampleErrors};
use crate::{Estimate, GroupScores};
use phase_model::{EventKind, Relation};
use phase_statistics::mean;
use serde::{Deserialize, Serialize};

/// Displacement errors over some events of equal weight (u).
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct ForecastScores {
    /// Number of events.
    pub n: usize,
    /// Average displacement error of the agents.
    pub ade: Estimate,
    /// Final displacement error of the agents.
    pub fde: Estimate,
    /// Average displacement error of agents and objects.
    pub ade_entities: Estimate,
    /// Final displacement error of agents and objects.
    pub fde_entities: Estimate,
    /// Scores of the distribution of futures, over the events for which the method gave one; `None` without
    /// any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples: Option<SampleScores>,
}

/// Scores of distributions of futures over some events of equal weight (u); see
/// [`SampleErrors`](super::SampleErrors).
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct SampleScores {
    /// Number of events.
    pub n: usize,
    /// minADE.
    pub min_ade: Estimate,
    /// minFDE.
    pub min_fde: Estimate,
    /// Energy score.
    pub energy: Estimate,
}

impl SampleScores {
    fn of(events: &[&ForecastEvent], seed: u64) -> Option<Self> {
        let sampled: Vec<&SampleErrors> = events.iter().filter_map(|event| event.samples.as_ref()).collect();
        let estimate = |of: fn(&SampleErrors) -> f64| {
            Estimate::of(&sampled.iter().map(|errors| of(errors)).collect::<Vec<f64>>(), seed)
        };
        Some(Self {
            n: sampled.len(),
            min_ade: estimate(|errors| errors.min_ade)?,
            min_fde: estimate(|errors| errors.min_fde)?,
            energy: estimate(|errors| errors.energy)?,
        })
    }
}

impl ForecastScores {
    fn of(events: &[&ForecastEvent], seed: u64) -> Option<Self> {
        let estimate = |of: fn(&ForecastEvent) -> f64| {
            Estimate::of(&events.iter().map(|event| of(event)).collect::<Vec<f64>>(), seed)
        };
        Some(Self {
            n: events.len(),
            ade: estimate(|event| event.agents.ade)?,
            fde: estimate(|event| event.agents.fde)?,
            ade_entities: estimate(|event| event.entities.ade)?,
            fde_entities: estimate(|event| event.entities.fde)?,
            samples: SampleScores::of(events, seed),
        })
    }
}

/// Displacement errors of a method.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct ForecastSummary {
    /// Events with a neutral relation; `None` if there are none.
    pub independent: Option<ForecastScores>,
    /// Events with a friendly or adversarial relation; `None` if there are none.
    pub social: Option<ForecastScores>,
    /// All events.
    pub all: ForecastScores,
    /// By kind of event.
    pub kinds: Vec<GroupScores<ForecastScores>>,
    /// The agents' error after 1, 2, 3 … steps, the mean over the events that have that many (u).
    pub by_step: Vec<f64>,
    /// Events that end before the last step to predict; their last existing step is used for the final error.
    pub shorter: usize,
    /// CPU time for an event (s), the mean over those for which it was measured.
    pub cpu_seconds_per_event: Option<f64>,
}

impl ForecastSummary {
    /// Aggregates the predictions; `None` without events. The seed is that of the intervals.
    #[must_use]
    pub fn of(events: &[ForecastEvent], seed: u64) -> Option<Self> {
        let scores = |chosen: &dyn Fn(&ForecastEvent) -> bool| {
            ForecastScores::of(&events.iter().filter(|event| chosen(event)).collect::<Vec<_>>(), seed)
        };
        let kind = |kind: EventKind| {
            Some(GroupScores { name: kind.name().into(), scores: scores(&|event| event.kind == kind)? })
        };
        let longest = events.iter().map(|event| event.steps).max().unwrap_or_default();
        let after = |step: usize| {
            let errors = events.iter().filter_map(|event| step_error(&event.agents, step));
            mean(&errors.collect::<Vec<f64>>()).unwrap_or_default()
        };
        let cpu: Vec<f64> = events.iter().filter_map(|event| event.cpu_seconds).collect();
        Some(Self {
            independent: scores(&|event| event.relation == Relation::Neutral),
            social: scores(&|event| event.relation != Relation::Neutral),
            all: scores(&|_| true)?,
            kinds: EventKind::ALL.into_iter().filter_map(kind).collect(),
            by_step: (0..longest).map(after).collect(),
            shorter: events.iter().filter(|event| event.steps < PREDICTED_STEPS).count(),
            cpu_seconds_per_event: mean(&cpu),
        })
    }
}

fn step_error(errors: &Errors, step: usize) -> Option<f64> {
    errors.by_step.get(step).copied()
}

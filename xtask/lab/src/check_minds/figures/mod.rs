//! The figures of a group of events.

mod explained;
mod open_loop;

use super::measure::MeasuredEvent;
use explained::ExplainedFigures;
use open_loop::OpenLoopFigures;
use phase_simple::choice::{Chance, log_likelihood};
use phase_statistics::mean;
use serde::Serialize;

/// The lapse rate at which minds are compared that were measured on different files.
const FIXED_LAPSE: f64 = 0.05;

/// The figures of some events, as in the file. A figure that was not measured is null.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub(super) struct MindFigures {
    /// Events.
    pub(super) events: usize,
    /// Decisions: steps of each agent.
    pub(super) decisions: usize,
    /// Mean chance of what was done.
    pub(super) choice_probability: Option<f64>,
    /// Mean log likelihood of what was done, with the lapse rate fitted to all events (nat a step).
    pub(super) log_likelihood_per_step: Option<f64>,
    /// Mean log likelihood of what was done, with a lapse rate of 0.05 (nat a step).
    pub(super) log_likelihood_lapse_05: Option<f64>,
    /// Decisions of which it is known what was done.
    #[serde(flatten)]
    pub(super) explained: ExplainedFigures,
    /// Mean over events of the mean deviation of a step from simulations in which one agent decides under the
    /// truth and the other does what was inferred (u).
    pub(super) stray_per_step: Option<f64>,
    /// That deviation where both agents decide, always over whole events (u).
    pub(super) stray_of_both_per_step: Option<f64>,
    /// The open loop beside the recordings.
    #[serde(flatten)]
    pub(super) open_loop: OpenLoopFigures,
}

impl MindFigures {
    /// The figures of some events with this fitted lapse rate.
    pub(super) fn of(events: &[&MeasuredEvent], lapse: f64) -> Self {
        let chances: Vec<Chance> = events.iter().flat_map(|event| event.chances.concat()).collect();
        let strays = events.iter().filter_map(|event| mean(&event.deviations.concat()));
        let strays_of_both = events.iter().filter_map(|event| mean(&event.joint_deviations));
        Self {
            events: events.len(),
            decisions: chances.len(),
            choice_probability: mean(&chances.iter().map(|chance| chance.mind).collect::<Vec<_>>()),
            log_likelihood_per_step: log_likelihood(&chances, lapse),
            log_likelihood_lapse_05: log_likelihood(&chances, FIXED_LAPSE),
            explained: ExplainedFigures::of(events, lapse),
            stray_per_step: mean(&strays.collect::<Vec<_>>()),
            stray_of_both_per_step: mean(&strays_of_both.collect::<Vec<_>>()),
            open_loop: OpenLoopFigures::of(events),
        }
    }
}

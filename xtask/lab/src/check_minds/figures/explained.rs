//! The decisions of which it is known what was done, because inverse dynamics explains the step.

use super::FIXED_LAPSE;
use crate::check_minds::measure::MeasuredEvent;
use phase_simple::choice::{Chance, log_likelihood};
use phase_statistics::mean;
use serde::Serialize;

/// Share of decisions that are explained to within [`phase_simple::inverse_dynamics::EXPLAINED_RESIDUAL`],
/// and how likely what was done is in these alone.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub(in crate::check_minds) struct ExplainedFigures {
    /// Share of all decisions.
    pub(in crate::check_minds) explained_share: Option<f64>,
    /// Mean chance of what was done.
    pub(in crate::check_minds) choice_probability_explained: Option<f64>,
    /// Mean log likelihood of what was done, with the lapse rate fitted to all decisions of all events (nat a
    /// step).
    pub(in crate::check_minds) log_likelihood_per_step_explained: Option<f64>,
    /// Mean log likelihood of what was done, with a lapse rate of 0.05 (nat a step).
    pub(in crate::check_minds) log_likelihood_lapse_05_explained: Option<f64>,
}

impl ExplainedFigures {
    pub(super) fn of(events: &[&MeasuredEvent], lapse: f64) -> Self {
        let decisions = events
            .iter()
            .flat_map(|event| event.chances.iter().flat_map(|chances| chances.iter().zip(&event.explained)));
        let decisions: Vec<(&Chance, &bool)> = decisions.collect();
        let explained = decisions.iter().filter(|(_, explained)| **explained).map(|(chance, _)| **chance);
        let chances: Vec<Chance> = explained.collect();
        let share = |explained: bool| f64::from(u8::from(explained));
        let shares: Vec<f64> = decisions.iter().map(|(_, explained)| share(**explained)).collect();
        Self {
            explained_share: mean(&shares),
            choice_probability_explained: mean(&chances.iter().map(|chance| chance.mind).collect::<Vec<_>>()),
            log_likelihood_per_step_explained: log_likelihood(&chances, lapse),
            log_likelihood_lapse_05_explained: log_likelihood(&chances, FIXED_LAPSE),
        }
    }
}

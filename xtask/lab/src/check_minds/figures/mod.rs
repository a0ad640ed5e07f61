//! The figures of a group of events, or of the agents with one role in them.

mod explained;
mod open_loop;
mod recognition;

use super::measure::MeasuredEvent;
use explained::ExplainedFigures;
use open_loop::OpenLoopFigures;
use phase_model::AgentId;
use phase_simple::choice::{Chance, log_likelihood};
use phase_statistics::mean;
use recognition::RecognitionFigures;
use serde::Serialize;

/// The lapse rate at which minds are compared that were measured on different files.
const FIXED_LAPSE: f64 = 0.05;
/// An event with those of its agents that are to be considered.
#[derive(Clone, Debug)]
pub(super) struct Member<'a> {
    /// The event.
    pub(super) event: &'a MeasuredEvent,
    /// The agents, at least one.
    pub(super) agents: Vec<AgentId>,
}

impl<'a> Member<'a> {
    /// An event with both agents.
    pub(super) fn whole(event: &'a MeasuredEvent) -> Self {
        Self { event, agents: AgentId::ALL.to_vec() }
    }
}

/// The figures of some members, as in the file. What was not measured is null.
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
    /// SIMPLE's posterior.
    #[serde(flatten)]
    pub(super) recognition: RecognitionFigures,
    /// The open loop beside the recordings.
    #[serde(flatten)]
    pub(super) open_loop: OpenLoopFigures,
}

impl MindFigures {
    /// The figures of some members with this fitted lapse rate.
    pub(super) fn of(members: &[Member<'_>], lapse: f64) -> Self {
        let chances: Vec<Chance> = members
            .iter()
            .flat_map(|member| member.agents.iter().flat_map(|&agent| &member.event.chances[agent]))
            .copied()
            .collect();
        let strays = members.iter().filter_map(|member| {
            let deviations: Vec<f64> =
                member.agents.iter().flat_map(|&agent| &member.event.deviations[agent]).copied().collect();
            mean(&deviations)
        });
        let strays_of_both = members.iter().filter_map(|member| mean(&member.event.joint_deviations));
        Self {
            events: members.len(),
            decisions: chances.len(),
            choice_probability: mean(&chances.iter().map(|chance| chance.mind).collect::<Vec<_>>()),
            log_likelihood_per_step: log_likelihood(&chances, lapse),
            log_likelihood_lapse_05: log_likelihood(&chances, FIXED_LAPSE),
            explained: ExplainedFigures::of(members, lapse),
            stray_per_step: mean(&strays.collect::<Vec<_>>()),
            stray_of_both_per_step: mean(&strays_of_both.collect::<Vec<_>>()),
            recognition: RecognitionFigures::of(members),
            open_loop: OpenLoopFigures::of(members),
        }
    }
}

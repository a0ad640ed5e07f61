//! Events pooled by kind.

use super::{AgentComparison, MeasuredPair, Quartiles};
use phase_evidence::MotionStatistics;
use phase_model::EventKind;
use phase_statistics::median;
use serde::{Deserialize, Serialize};

/// All events of one kind; `None` is for all kinds together. Where a scene was simulated with several seeds,
/// each counts as an event, compared with its recording.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KindRow {
    /// The kind.
    pub kind: Option<EventKind>,
    /// Events that have a recording.
    pub events: usize,
    /// Agents in them: twice that number.
    pub agents: usize,
    /// Agents whose goal was reached in both or in neither.
    pub matched: usize,
    /// Agents whose goal is their own and positive.
    pub own_agents: usize,
    /// Those of them whose goal was reached in both or in neither.
    pub own_matched: usize,
    /// Agents whose goal was reached in the recording.
    pub recorded_reached: usize,
    /// Agents whose goal was reached in the simulation.
    pub simulated_reached: usize,
    /// Agents whose positive goal was reached in both, and not from the start of the recording; the three
    /// fields below are over them.
    pub timed: usize,
    /// Median steps to the goal in the recording.
    pub recorded_steps: Option<f64>,
    /// Median steps to the goal in the simulation.
    pub simulated_steps: Option<f64>,
    /// Quartiles of each agent's steps to the goal in the simulation over those in the recording.
    pub time_ratio: Option<Quartiles>,
    /// Motion of the agents in the recordings.
    pub recorded_motion: MotionQuartiles,
    /// Motion of the agents in the simulations.
    pub simulated_motion: MotionQuartiles,
}

/// Quartiles of motion, over the steps that recording and simulation both have; null without steps.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionQuartiles {
    /// Speed (u per second of physics) over events, agents and steps.
    pub speed: Option<Quartiles>,
    /// Length of path (u) over events and agents.
    pub path: Option<Quartiles>,
    /// Share of steps in contact with another entity (0 to 1) over events and agents.
    pub contact: Option<Quartiles>,
}

impl MotionQuartiles {
    fn of<'a>(motions: impl Iterator<Item = &'a MotionStatistics>) -> Self {
        let motions: Vec<&MotionStatistics> = motions.filter(|motion| !motion.speeds.is_empty()).collect();
        let over = |number: fn(&MotionStatistics) -> Option<f32>| {
            let numbers: Vec<f32> = motions.iter().filter_map(|motion| number(motion)).collect();
            Quartiles::of(&numbers)
        };
        let speeds: Vec<f32> = motions.iter().flat_map(|motion| motion.speeds.iter().copied()).collect();
        Self {
            speed: Quartiles::of(&speeds),
            path: over(|motion| Some(motion.path)),
            contact: over(MotionStatistics::contact_share),
        }
    }
}

/// One row for each kind that occurs, in the kinds' order, and one for all. Events without a recording do not
/// count.
#[must_use]
pub fn tabulate(pairs: &[MeasuredPair]) -> Vec<KindRow> {
    let recorded: Vec<&MeasuredPair> =
        pairs.iter().filter(|pair| pair.comparison.recorded_steps > 0).collect();
    let of_kind =
        |kind| recorded.iter().copied().filter(|pair| pair.comparison.kind == kind).collect::<Vec<_>>();
    let rows = EventKind::ALL.map(|kind| row(Some(kind), &of_kind(kind)));
    rows.into_iter().filter(|row| row.events > 0).chain([row(None, &recorded)]).collect()
}

fn row(kind: Option<EventKind>, pairs: &[&MeasuredPair]) -> KindRow {
    let agents: Vec<&AgentComparison> = pairs.iter().flat_map(|pair| &pair.comparison.agents).collect();
    let count = |condition: fn(&AgentComparison) -> bool| agents.iter().filter(|it| condition(it)).count();
    let timed = agents.iter().filter_map(|it| Some((it.recorded.steps?, it.simulated.steps?)));
    let (recorded, simulated): (Vec<usize>, Vec<usize>) = timed.filter(|&(recorded, _)| recorded > 0).unzip();
    let ratios: Vec<f32> =
        recorded.iter().zip(&simulated).map(|(&theirs, &ours)| ours as f32 / theirs as f32).collect();
    KindRow {
        kind,
        events: pairs.len(),
        agents: agents.len(),
        matched: count(AgentComparison::matched),
        own_agents: count(AgentComparison::own_positive),
        own_matched: count(|it| it.own_positive() && it.matched()),
        recorded_reached: count(|it| it.recorded.reached),
        simulated_reached: count(|it| it.simulated.reached),
        timed: recorded.len(),
        recorded_steps: median(&recorded),
        simulated_steps: median(&simulated),
        time_ratio: Quartiles::of(&ratios),
        recorded_motion: MotionQuartiles::of(pairs.iter().flat_map(|pair| &pair.recorded)),
        simulated_motion: MotionQuartiles::of(pairs.iter().flat_map(|pair| &pair.simulated)),
    }
}

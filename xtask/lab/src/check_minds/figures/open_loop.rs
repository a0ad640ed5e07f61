//! Simulations in the open loop beside the recordings, over a group of events.

use crate::check_minds::{measure::MeasuredEvent, motion::Motion};
use phase_model::arena;
use phase_statistics::{mean, percentile};
use serde::Serialize;

/// Simulated events beside the recorded ones. Each event and seed counts once.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub(in crate::check_minds) struct OpenLoopFigures {
    /// Own positive goals compared.
    pub(in crate::check_minds) goals: usize,
    /// Share of them whose outcome is as recorded.
    pub(in crate::check_minds) outcomes_as_recorded: Option<f64>,
    /// Share of the pairs of seeds in which the outcome of a goal is the same: as much as can be expected of
    /// a recording that the same minds made with other random numbers. `None` with one seed.
    pub(in crate::check_minds) outcomes_as_each_other: Option<f64>,
    /// Share of them that hold at any time as recorded.
    pub(in crate::check_minds) outcomes_at_any_time: Option<f64>,
    /// Median ratio of the length of all paths to the recorded one.
    pub(in crate::check_minds) path_ratio: Option<f64>,
    /// Length of all paths, ours (median, u).
    pub(in crate::check_minds) path: Option<f64>,
    /// Length of all paths, recorded (median, u).
    pub(in crate::check_minds) path_recorded: Option<f64>,
    /// Speed in a step, ours (median, u/s of physics).
    pub(in crate::check_minds) speed: Option<f64>,
    /// Speed in a step, recorded (median, u/s of physics).
    pub(in crate::check_minds) speed_recorded: Option<f64>,
    /// Mean share of steps in which nobody moves, ours.
    pub(in crate::check_minds) still_share: Option<f64>,
    /// Mean share of steps in which nobody moves, recorded.
    pub(in crate::check_minds) still_share_recorded: Option<f64>,
    /// Mean share of steps in contact with the other or an object, ours.
    pub(in crate::check_minds) contact_share: Option<f64>,
    /// Mean share of steps in contact with the other or an object, recorded.
    pub(in crate::check_minds) contact_share_recorded: Option<f64>,
    /// Longest time in which nobody moves while a positive goal is open, ours (s of video): the maximum.
    pub(in crate::check_minds) longest_still_with_open_goal: Option<f64>,
    /// Its mean over events.
    pub(in crate::check_minds) longest_still_with_open_goal_mean: Option<f64>,
    /// The maximum, recorded.
    pub(in crate::check_minds) longest_still_with_open_goal_recorded: Option<f64>,
    /// The mean, recorded.
    pub(in crate::check_minds) longest_still_with_open_goal_mean_recorded: Option<f64>,
    /// Steps before the first in which a body is more than 1 u from where it was recorded (median).
    pub(in crate::check_minds) steps_together: Option<f64>,
    /// Distance of a body from where it was recorded, mean over bodies, steps and events (u).
    pub(in crate::check_minds) distance: Option<f64>,
    /// CPU time of 100 steps (mean, s).
    pub(in crate::check_minds) cpu_seconds_per_100_steps: Option<f64>,
    /// The maximum over events.
    pub(in crate::check_minds) cpu_seconds_per_100_steps_max: Option<f64>,
}

impl OpenLoopFigures {
    pub(super) fn of(events: &[&MeasuredEvent]) -> Self {
        let agreements: Vec<[bool; 2]> = events.iter().flat_map(|event| agreements(event)).collect();
        let share = |k: usize| {
            mean(&agreements.iter().map(|agreement| f64::from(u8::from(agreement[k]))).collect::<Vec<_>>())
        };
        let recorded = || events.iter().map(|event| &event.recorded);
        let runs = || events.iter().flat_map(|event| event.simulated.iter().map(move |run| (event, run)));
        let simulated = || runs().map(|(_, run)| &run.motion);
        let ratios = runs().filter_map(|(event, run)| {
            let recorded = event.recorded.path();
            (recorded > 0.0).then(|| run.motion.path() / recorded)
        });
        let cpu_seconds: Vec<f64> = runs().map(|(_, run)| run.cpu_seconds).collect();
        Self {
            goals: agreements.len(),
            outcomes_as_recorded: share(0),
            outcomes_as_each_other: mean(&events.iter().flat_map(|it| as_each_other(it)).collect::<Vec<_>>()),
            outcomes_at_any_time: share(1),
            path_ratio: median(ratios),
            path: median(simulated().map(Motion::path)),
            path_recorded: median(recorded().map(Motion::path)),
            speed: median(simulated().flat_map(speeds)),
            speed_recorded: median(recorded().flat_map(speeds)),
            still_share: mean_share(simulated(), Motion::still_share),
            still_share_recorded: mean_share(recorded(), Motion::still_share),
            contact_share: mean_share(simulated(), Motion::contact_share),
            contact_share_recorded: mean_share(recorded(), Motion::contact_share),
            longest_still_with_open_goal: max(&still_seconds(simulated())),
            longest_still_with_open_goal_mean: mean(&still_seconds(simulated())),
            longest_still_with_open_goal_recorded: max(&still_seconds(recorded())),
            longest_still_with_open_goal_mean_recorded: mean(&still_seconds(recorded())),
            steps_together: median(runs().map(|(_, run)| run.together as f32)),
            distance: mean(&runs().map(|(_, run)| run.distance).collect::<Vec<_>>()),
            cpu_seconds_per_100_steps: mean(&cpu_seconds),
            cpu_seconds_per_100_steps_max: max(&cpu_seconds),
        }
    }
}

/// For each own positive goal and seed whether its outcome is as recorded, and whether it holds at any time
/// as recorded.
fn agreements(event: &MeasuredEvent) -> impl Iterator<Item = [bool; 2]> {
    event.simulated.iter().flat_map(|run| {
        let reached = run.motion.reached.iter().zip(&event.recorded.reached);
        reached.filter_map(|(ours, theirs)| {
            let (ours, theirs) = ours.zip(*theirs)?;
            Some([ours.outcome == theirs.outcome, ours.at_any_time == theirs.at_any_time])
        })
    })
}

/// For each own positive goal and pair of seeds 1 if its outcome is the same, else 0.
fn as_each_other(event: &MeasuredEvent) -> impl Iterator<Item = f64> {
    let runs = event.simulated.iter().enumerate();
    let pairs = runs.flat_map(|(k, one)| event.simulated[..k].iter().map(move |other| (one, other)));
    pairs.flat_map(|(one, other)| {
        let both = one.motion.reached.iter().zip(&other.motion.reached);
        both.filter_map(|(one, other)| {
            let (one, other) = one.zip(*other)?;
            Some(f64::from(u8::from(one.outcome == other.outcome)))
        })
    })
}

fn speeds(motion: &Motion) -> impl Iterator<Item = f32> {
    motion.agents.iter().flat_map(|agent| &agent.speeds).copied()
}

fn mean_share<'a>(
    motions: impl Iterator<Item = &'a Motion>,
    share: fn(&Motion) -> Option<f64>,
) -> Option<f64> {
    mean(&motions.filter_map(share).collect::<Vec<_>>())
}

fn still_seconds<'a>(motions: impl Iterator<Item = &'a Motion>) -> Vec<f64> {
    motions.map(|motion| motion.longest_still as f64 * arena::STEP_VIDEO_SECONDS).collect()
}

fn median(values: impl Iterator<Item = f32>) -> Option<f64> {
    percentile(&values.collect::<Vec<_>>(), 50).map(f64::from)
}

fn max(values: &[f64]) -> Option<f64> {
    values.iter().copied().reduce(f64::max)
}

//! The figures of a group of events, or of the agents with one role in them.

use super::{
    measure::MeasuredEvent,
    motion::{Motion, STEP_SECONDS},
    recognition::{Recognition, SocialAgent},
};
use phase_model::{AGENT_COUNT, AgentId};
use phase_simple::choice::{Chance, log_likelihood};
use phase_statistics::{mean, percentile};
use serde::Serialize;

/// The lapse rate at which minds are compared that were measured on different files.
const FIXED_LAPSE: f64 = 0.05;
/// A posterior probability above which SIMPLE is as good as certain.
const CERTAIN: f64 = 0.9;

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
pub(super) struct Figures {
    /// Events.
    pub(super) events: usize,
    /// Decisions: steps of each agent.
    pub(super) decisions: usize,
    /// Mean chance of what was done.
    pub(super) choice_probability: Option<f64>,
    /// Mean log likelihood of what was done, with the lapse rate fitted to all events (nat a step).
    pub(super) log_likelihood_per_step: Option<f64>,
    /// The same with a lapse rate of 0.05.
    pub(super) log_likelihood_lapse_05: Option<f64>,
    /// Mean deviation of a step from simulations under the truth (u).
    pub(super) stray_per_step: Option<f64>,
    /// SIMPLE's posterior.
    #[serde(flatten)]
    pub(super) recognition: RecognitionFigures,
    /// The open loop beside the recordings.
    #[serde(flatten)]
    pub(super) open_loop: OpenLoopFigures,
}

/// How well SIMPLE recognises the truth.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub(super) struct RecognitionFigures {
    /// Mean log posterior probability of the true goals and attitudes (nat).
    pub(super) log_posterior: Option<f64>,
    /// Mean posterior probability of the true relation.
    pub(super) relation_probability: Option<f64>,
    /// Share of events whose true relation is the likeliest.
    pub(super) relation_top1: Option<f64>,
    /// Share of agents whose true goal is the likeliest; always of both agents.
    pub(super) goal_top1: Option<f64>,
    /// Events in which an agent helps or hinders, and whether the right one is named.
    pub(super) social_agent: Option<SocialFigures>,
}

/// Whether the agent that helps (or hinders) is told from the other: numbers of events.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub(super) struct SocialFigures {
    /// In which one agent helps or hinders.
    pub(super) events: usize,
    /// In which the true pair of attitudes is the likeliest.
    pub(super) named: usize,
    /// In which the right agent is likelier than the other to have that attitude.
    pub(super) likelier: usize,
    /// In which the wrong agent has it with a probability above 0.9.
    pub(super) wrong_above_90: usize,
    /// Mean posterior probability of the right agent having it.
    pub(super) probability: f64,
}

/// Simulated events beside the recorded ones. Each event and seed counts once.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub(super) struct OpenLoopFigures {
    /// Own positive goals compared.
    pub(super) goals: usize,
    /// Share of them whose outcome is as recorded.
    pub(super) outcomes_as_recorded: Option<f64>,
    /// Share of them that hold at any time as recorded.
    pub(super) outcomes_at_any_time: Option<f64>,
    /// Median ratio of the length of all paths to the recorded one.
    pub(super) path_ratio: Option<f64>,
    /// Length of all paths, ours (median, u).
    pub(super) path: Option<f64>,
    /// The same, recorded.
    pub(super) path_recorded: Option<f64>,
    /// Speed in a step, ours (median, u/s of physics).
    pub(super) speed: Option<f64>,
    /// The same, recorded.
    pub(super) speed_recorded: Option<f64>,
    /// Mean share of steps in which nobody moves, ours.
    pub(super) still_share: Option<f64>,
    /// The same, recorded.
    pub(super) still_share_recorded: Option<f64>,
    /// Mean share of steps in contact with the other or an object, ours.
    pub(super) contact_share: Option<f64>,
    /// The same, recorded.
    pub(super) contact_share_recorded: Option<f64>,
    /// Longest time in which nobody moves while a positive goal is open, ours (s of video): the maximum.
    pub(super) longest_still_with_open_goal: Option<f64>,
    /// Its mean over events.
    pub(super) longest_still_with_open_goal_mean: Option<f64>,
    /// The maximum, recorded.
    pub(super) longest_still_with_open_goal_recorded: Option<f64>,
    /// The mean, recorded.
    pub(super) longest_still_with_open_goal_mean_recorded: Option<f64>,
    /// CPU time of 100 steps (mean, s).
    pub(super) cpu_seconds_per_100_steps: Option<f64>,
    /// The maximum over events.
    pub(super) cpu_seconds_per_100_steps_max: Option<f64>,
}

impl Figures {
    /// The figures of some members with this fitted lapse rate.
    pub(super) fn of(members: &[Member<'_>], lapse: f64) -> Self {
        let chances: Vec<Chance> = members
            .iter()
            .flat_map(|member| member.agents.iter().flat_map(|&agent| &member.event.chances[agent]))
            .copied()
            .collect();
        let deviations: Vec<f64> =
            members.iter().flat_map(|member| &member.event.deviations).copied().collect();
        Self {
            events: members.len(),
            decisions: chances.len(),
            choice_probability: mean(&chances.iter().map(|chance| chance.mind).collect::<Vec<_>>()),
            log_likelihood_per_step: log_likelihood(&chances, lapse),
            log_likelihood_lapse_05: log_likelihood(&chances, FIXED_LAPSE),
            stray_per_step: mean(&deviations),
            recognition: RecognitionFigures::of(members),
            open_loop: OpenLoopFigures::of(members),
        }
    }
}

impl RecognitionFigures {
    fn of(members: &[Member<'_>]) -> Self {
        let all: Option<Vec<Recognition>> = members.iter().map(|member| member.event.recognition).collect();
        let Some(all) = all else { return Self::default() };
        let mean_of = |of: fn(&Recognition) -> f64| mean(&all.iter().map(of).collect::<Vec<_>>());
        Self {
            log_posterior: mean_of(|it| it.log_posterior),
            relation_probability: mean_of(|it| it.relation),
            relation_top1: mean_of(|it| f64::from(u8::from(it.relation_right))),
            goal_top1: mean_of(|it| it.goals_right as f64 / AGENT_COUNT as f64),
            social_agent: SocialFigures::of(&all.iter().filter_map(|it| it.social).collect::<Vec<_>>()),
        }
    }
}

impl SocialFigures {
    fn of(all: &[SocialAgent]) -> Option<Self> {
        let count = |counts: fn(&SocialAgent) -> bool| all.iter().filter(|it| counts(it)).count();
        Some(Self {
            events: all.len(),
            named: count(|it| it.named),
            likelier: count(|it| it.right > it.wrong),
            wrong_above_90: count(|it| it.wrong > CERTAIN),
            probability: mean(&all.iter().map(|it| it.right).collect::<Vec<_>>())?,
        })
    }
}

impl OpenLoopFigures {
    fn of(members: &[Member<'_>]) -> Self {
        let agreements: Vec<[bool; 2]> = members.iter().flat_map(agreements).collect();
        let share = |k: usize| {
            mean(&agreements.iter().map(|agreement| f64::from(u8::from(agreement[k]))).collect::<Vec<_>>())
        };
        let recorded = || members.iter().map(|member| (&member.event.recorded, &member.agents[..]));
        let runs =
            || members.iter().flat_map(|member| member.event.simulated.iter().map(move |run| (member, run)));
        let simulated = || runs().map(|(member, run)| (&run.motion, &member.agents[..]));
        let ratios = runs().filter_map(|(member, run)| {
            let recorded = member.event.recorded.path(&member.agents);
            (recorded > 0.0).then(|| run.motion.path(&member.agents) / recorded)
        });
        let cpu_seconds: Vec<f64> = runs().map(|(_, run)| run.cpu_seconds).collect();
        Self {
            goals: agreements.len(),
            outcomes_as_recorded: share(0),
            outcomes_at_any_time: share(1),
            path_ratio: median(ratios),
            path: median(simulated().map(|(motion, agents)| motion.path(agents))),
            path_recorded: median(recorded().map(|(motion, agents)| motion.path(agents))),
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
            cpu_seconds_per_100_steps: mean(&cpu_seconds),
            cpu_seconds_per_100_steps_max: max(&cpu_seconds),
        }
    }
}

/// For each own positive goal and seed whether its outcome is as recorded, and whether it holds at any time as recorded.
fn agreements<'a>(member: &'a Member<'_>) -> impl Iterator<Item = [bool; 2]> + 'a {
    let recorded = &member.event.recorded.reached;
    member.event.simulated.iter().flat_map(move |run| {
        member.agents.iter().filter_map(move |&agent| {
            let (ours, theirs) = (run.motion.reached[agent]?, recorded[agent]?);
            Some([ours.outcome == theirs.outcome, ours.at_any_time == theirs.at_any_time])
        })
    })
}

fn speeds<'a>((motion, agents): (&'a Motion, &'a [AgentId])) -> impl Iterator<Item = f32> + 'a {
    agents.iter().flat_map(|&agent| &motion.agents[agent].speeds).copied()
}

fn mean_share<'a>(
    motions: impl Iterator<Item = (&'a Motion, &'a [AgentId])>,
    share: fn(&Motion, &[AgentId]) -> Option<f64>,
) -> Option<f64> {
    mean(&motions.filter_map(|(motion, agents)| share(motion, agents)).collect::<Vec<_>>())
}

fn still_seconds<'a>(motions: impl Iterator<Item = (&'a Motion, &'a [AgentId])>) -> Vec<f64> {
    motions.map(|(motion, _)| motion.longest_still as f64 * STEP_SECONDS).collect()
}

fn median(values: impl Iterator<Item = f32>) -> Option<f64> {
    percentile(&values.collect::<Vec<_>>(), 50).map(f64::from)
}

fn max(values: &[f64]) -> Option<f64> {
    values.iter().copied().reduce(f64::max)
}

//! Q(Y | S): the proposal distribution of hypotheses (appendix, "Bottom-up Proposals").

use crate::{Hypothesis, Posterior, cue, physical_goals, strength::StrengthCue};
use core::ops::RangeInclusive;
use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, AgentId, Attitude, Goal, Strength};
use rand::{Rng, RngExt};

/// The distribution of hypotheses that a time window of an observed event suggests: goals and strengths of
/// both agents independently; attitudes uniformly over no agent being social, one helping and one hindering,
/// either of the two.
#[derive(Clone, PartialEq, Debug)]
pub struct Proposal {
    goals: [Vec<Goal>; AGENT_COUNT],
    goal_logs: [Vec<f64>; AGENT_COUNT],
    strength_logs: [[f64; Strength::ALL.len()]; AGENT_COUNT],
}

impl Proposal {
    /// The proposal that the rows of a range of steps suggest; rows past the event's end are ignored. `gamma`
    /// is γ of the goals' exponent (1/u), and `strengths` estimates strengths from the same rows.
    #[must_use]
    pub fn new(
        observed: &ObservedEvent,
        range: RangeInclusive<usize>,
        gamma: f64,
        strengths: &dyn StrengthCue,
    ) -> Self {
        let last = observed.steps();
        let from = (*range.start()).min(last);
        let to = (*range.end()).min(last);
        let rows = observed.rows().get(from..=to).unwrap_or_default();
        let goals: [Vec<Goal>; AGENT_COUNT] =
            AgentId::ALL.map(|agent| physical_goals(agent, observed.object_sizes().len()));
        let goal_logs = AgentId::ALL.map(|agent| cue::log_proposal(&goals[agent], agent, rows, gamma));
        let sizes = observed.agent_sizes();
        let strength_logs = AgentId::ALL.map(|agent| strengths.log_proposal(rows, agent, sizes[agent]));
        Self { goals, goal_logs, strength_logs }
    }

    /// Draws a hypothesis.
    pub fn sample(&self, random: &mut impl Rng) -> Hypothesis {
        let goals = AgentId::ALL.map(|agent| self.sample_goal(agent, random));
        let mut attitudes = [Attitude::Neutral; AGENT_COUNT];
        let social = [Attitude::Hinder, Attitude::Neutral, Attitude::Help][random.random_range(0..3)];
        if social != Attitude::Neutral {
            attitudes[random.random_range(0..AGENT_COUNT)] = social;
        }
        let strengths =
            AgentId::ALL.map(|agent| Strength::ALL[sample_index(&self.strength_logs[agent], random)]);
        Hypothesis::new(goals, attitudes, strengths)
    }

    /// The goal that an agent pursues most likely.
    #[must_use]
    pub fn most_likely_goal(&self, agent: AgentId) -> Goal {
        let goals = self.goals[agent].iter().zip(&self.goal_logs[agent]);
        let best = goals.max_by(|a, b| a.1.total_cmp(b.1));
        best.map_or_else(|| unreachable!("there are landmarks to go to"), |(goal, _)| *goal)
    }

    /// Draws a goal of an agent.
    fn sample_goal(&self, agent: AgentId, random: &mut impl Rng) -> Goal {
        self.goals[agent][sample_index(&self.goal_logs[agent], random)]
    }

    /// The goals that an agent can have.
    #[must_use]
    pub fn goals(&self, agent: AgentId) -> &[Goal] {
        &self.goals[agent]
    }

    /// Every hypothesis weighted by its proposal probability; strengths, which carry no information about
    /// goals and relations, are left at the lowest.
    #[must_use]
    pub fn posterior(&self) -> Posterior {
        let strengths = [Strength::Weak; AGENT_COUNT];
        let mut hypotheses = Vec::new();
        for &first in &self.goals[0] {
            for &second in &self.goals[1] {
                hypotheses.push(Hypothesis::new(
                    [first, second],
                    [Attitude::Neutral; AGENT_COUNT],
                    strengths,
                ));
            }
        }
        for social in AgentId::ALL {
            for attitude in [Attitude::Help, Attitude::Hinder] {
                let mut attitudes = [Attitude::Neutral; AGENT_COUNT];
                attitudes[social] = attitude;
                let all = self.goals[social.other()].iter();
                hypotheses.extend(all.map(|&goal| Hypothesis::new([goal; 2], attitudes, strengths)));
            }
        }
        Posterior::new(hypotheses.iter().map(|hypothesis| (*hypothesis, self.log_probability(hypothesis))))
    }

    /// ln Q(Y | S), −∞ for what is never drawn. The goal of a social agent is ignored, since it follows from
    /// the other's.
    #[must_use]
    pub fn log_probability(&self, hypothesis: &Hypothesis) -> f64 {
        let strength =
            |agent: AgentId| self.strength_logs[agent][usize::from(hypothesis.strengths[agent].level())];
        let goal = |agent: AgentId| {
            let place = self.goals[agent].iter().position(|&goal| goal == hypothesis.goals[agent]);
            place.map_or(f64::NEG_INFINITY, |place| self.goal_logs[agent][place])
        };
        let (attitudes, goals) = match hypothesis.social_agent() {
            None => (1.0 / 3.0, goal(AgentId::ZERO) + goal(AgentId::ONE)),
            Some(social) => (1.0 / 6.0, goal(social.other())),
        };
        libm::log(attitudes) + goals + strength(AgentId::ZERO) + strength(AgentId::ONE)
    }
}

/// An index drawn by logarithms of probabilities that sum to 1.
pub(crate) fn sample_index(logs: &[f64], random: &mut impl Rng) -> usize {
    let mut left = random.random::<f64>();
    for (place, log) in logs.iter().enumerate() {
        left -= libm::exp(*log);
        if left < 0.0 {
            return place;
        }
    }
    // Rounding may leave a small remainder.
    logs.len().saturating_sub(1)
}

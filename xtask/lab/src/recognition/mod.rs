//! The true hypothesis in SIMPLE's posterior.

use phase_eval::goals::canonical;
use phase_model::{AgentId, Attitude, Relation};
use phase_simple::{Hypothesis, Posterior};

/// SIMPLE's answer about one event, beside the truth.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Recognition {
    /// ln of the posterior probability of the true goals and attitudes, whatever the strengths (nat).
    pub(crate) log_posterior: f64,
    /// Posterior probability of the true relation.
    pub(crate) relation: f64,
    /// Whether the true relation is the likeliest.
    pub(crate) relation_right: bool,
    /// Number of the two agents' true goals that are the likeliest.
    pub(crate) goals_right: usize,
    /// Answer about who helps or hinders, if one agent helps or hinders the other.
    pub(crate) social: Option<SocialAgent>,
}

/// Posterior of which agent helps (or hinders).
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct SocialAgent {
    /// Posterior probability that the agent that does so does.
    pub(crate) right: f64,
    /// Posterior probability that it is the other that does so.
    pub(crate) wrong: f64,
    /// Whether the true attitudes are the likeliest pair.
    pub(crate) named: bool,
}

impl Recognition {
    /// Compares a posterior with the true hypothesis.
    pub(crate) fn of(posterior: &Posterior, truth: &Hypothesis) -> Self {
        let goals = |hypothesis: &Hypothesis| hypothesis.goals.map(canonical);
        let sum = |counts: &dyn Fn(&Hypothesis) -> bool| -> f64 {
            let counted = posterior.hypotheses.iter().filter(|(hypothesis, _)| counts(hypothesis));
            counted.map(|(_, weight)| weight).sum()
        };
        let same = |hypothesis: &Hypothesis| {
            goals(hypothesis) == goals(truth) && hypothesis.attitudes == truth.attitudes
        };
        let relations = posterior.relation();
        let of = |relation: Relation| match relation {
            Relation::Friendly => relations.friendly,
            Relation::Adversarial => relations.adversarial,
            Relation::Neutral => relations.neutral,
        };
        let best = relations.friendly.max(relations.adversarial).max(relations.neutral);
        let goal_right = |agent: &AgentId| {
            let likeliest = posterior.goals(*agent).first().map(|(goal, _)| canonical(*goal));
            likeliest == Some(canonical(truth.goals[*agent]))
        };
        let social = truth.social_agent().map(|agent| {
            let attitude = truth.attitudes[agent];
            let named = sum(&|it| it.attitudes == truth.attitudes);
            let others = [Attitude::Help, Attitude::Hinder].into_iter().flat_map(|attitude| {
                AgentId::ALL.map(|agent| {
                    let mut attitudes = [Attitude::Neutral; 2];
                    attitudes[agent] = attitude;
                    attitudes
                })
            });
            let others = others.chain([[Attitude::Neutral; 2]]).filter(|it| *it != truth.attitudes);
            SocialAgent {
                right: posterior.attitude(agent, attitude),
                wrong: posterior.attitude(agent.other(), attitude),
                named: others.into_iter().all(|attitudes| sum(&|it| it.attitudes == attitudes) < named),
            }
        });
        Self {
            log_posterior: libm::log(sum(&same).max(f64::MIN_POSITIVE)),
            relation: of(truth.relation()),
            relation_right: of(truth.relation()) >= best,
            goals_right: AgentId::ALL.iter().filter(|agent| goal_right(agent)).count(),
            social,
        }
    }
}

#[cfg(test)]
mod tests;

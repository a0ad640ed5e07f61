//! From weighted hypotheses to marginals over goals, attitudes and relations.

use crate::Hypothesis;
use phase_event::ObservedEvent;
use phase_model::{
    AGENT_COUNT, AgentId, Attitude, Goal, Judgement, Relation, RelationProbabilities, RoleProbabilities,
};
use phase_statistics::log_softmax;
use std::collections::BTreeMap;

/// Hypotheses with their probabilities given the motion: weights that are not negative and sum to 1, unless
/// there are none.
///
/// All questions are answered from the joint distribution: goals, attitudes and relations that are likely one
/// by one need not be likely together.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Posterior {
    /// Different hypotheses with their weights, heaviest first.
    pub hypotheses: Vec<(Hypothesis, f64)>,
}

impl Posterior {
    /// w_m = P(s | Y_m) / Σ_k P(s | Y_k), from ln P(s | Y_m). Weights of equal hypotheses add up.
    #[must_use]
    pub fn new(particles: impl IntoIterator<Item = (Hypothesis, f64)>) -> Self {
        let particles: Vec<_> = particles.into_iter().collect();
        let mut logs: Vec<f64> = particles.iter().map(|(_, log)| *log).collect();
        log_softmax(&mut logs);
        let mut weights: BTreeMap<Hypothesis, f64> = BTreeMap::new();
        for ((hypothesis, _), log) in particles.iter().zip(logs) {
            *weights.entry(*hypothesis).or_default() += libm::exp(log);
        }
        let mut hypotheses: Vec<_> = weights.into_iter().collect();
        hypotheses.sort_by(|a, b| b.1.total_cmp(&a.1));
        Self { hypotheses }
    }

    /// The weighted mean of some posteriors; weights sum to 1. Strengths are those of the first.
    pub(crate) fn mixture(parts: &[(Self, f64)]) -> Self {
        let strengths = parts.iter().find_map(|(part, _)| part.hypotheses.first()).map(|it| it.0.strengths);
        let all = parts.iter().flat_map(|(part, share)| {
            let of_share = move |(hypothesis, weight): &(Hypothesis, f64)| {
                let strengths = strengths.unwrap_or(hypothesis.strengths);
                (Hypothesis { strengths, ..*hypothesis }, libm::log(share * weight))
            };
            part.hypotheses.iter().map(of_share)
        });
        Self::new(all)
    }

    /// The posterior given that goals can be judged: without those at landmarks if none was seen.
    #[must_use]
    pub fn judged(self, observed: &ObservedEvent) -> Self {
        let elsewhere = |it: &(Hypothesis, f64)| it.0.is_elsewhere();
        if !observed.missing().landmarks || !self.hypotheses.iter().any(elsewhere) {
            return self;
        }
        let kept = self.hypotheses.into_iter().filter(elsewhere);
        Self::new(kept.map(|(hypothesis, weight)| (hypothesis, libm::log(weight))))
    }

    /// The total variation of two posteriors, 0 to 1: the greatest difference in the probability of anything.
    #[must_use]
    pub fn total_variation(&self, other: &Self) -> f64 {
        let mut differences: BTreeMap<Hypothesis, f64> = self.hypotheses.iter().copied().collect();
        for (hypothesis, weight) in &other.hypotheses {
            *differences.entry(*hypothesis).or_default() -= weight;
        }
        differences.values().map(|difference| difference.abs()).sum::<f64>() / 2.0
    }

    /// P(g_i | s) of an agent, most likely first, without those of zero weight.
    #[must_use]
    pub fn goals(&self, agent: AgentId) -> Vec<(Goal, f64)> {
        let mut goals: BTreeMap<Goal, f64> = BTreeMap::new();
        for (hypothesis, weight) in &self.hypotheses {
            *goals.entry(hypothesis.goals[agent]).or_default() += weight;
        }
        let mut goals: Vec<_> = goals.into_iter().collect();
        goals.sort_by(|a, b| b.1.total_cmp(&a.1));
        goals
    }

    /// P(α_ij | s) of an agent.
    #[must_use]
    pub fn attitude(&self, agent: AgentId, attitude: Attitude) -> f64 {
        self.sum(|hypothesis| hypothesis.attitudes[agent] == attitude)
    }

    /// P(α | s) of both agents.
    #[must_use]
    pub fn roles(&self) -> RoleProbabilities {
        let of = |attitude| AgentId::ALL.map(|agent| self.attitude(agent, attitude));
        RoleProbabilities { helps: of(Attitude::Help), hinders: of(Attitude::Hinder) }
    }

    /// P(friendly | s), P(adversarial | s) and P(neutral | s). The paper multiplies P(g_i = g_j | s) by
    /// P(α_ij = 0, α_ji = 0 | s), which holds if goals and attitudes are independent given the event. Here
    /// their joint distribution is known, so their joint probability replaces the product.
    #[must_use]
    pub fn relation(&self) -> RelationProbabilities {
        if self.hypotheses.is_empty() {
            return RelationProbabilities::default();
        }
        let of = |relation: Relation| self.sum(|hypothesis| hypothesis.relation() == relation);
        RelationProbabilities {
            friendly: of(Relation::Friendly),
            adversarial: of(Relation::Adversarial),
            neutral: of(Relation::Neutral),
        }
    }

    /// The answer to Task 1: both agents' goals, their relation and their roles, without predicted reports.
    #[must_use]
    pub fn judgement(&self) -> Judgement {
        let goals: [Vec<(Goal, f64)>; AGENT_COUNT] = AgentId::ALL.map(|agent| self.goals(agent));
        Judgement { goals, relation: self.relation(), roles: Some(self.roles()), reported: None }
    }

    fn sum(&self, counts: impl Fn(&Hypothesis) -> bool) -> f64 {
        self.hypotheses.iter().filter(|(hypothesis, _)| counts(hypothesis)).map(|(_, weight)| weight).sum()
    }
}

//! The output of a model of social perception: Task 1 and Task 2 of the paper.

use crate::{AGENT_COUNT, AgentId, Attitude, Goal, Relation, Vec2};
use serde::{Deserialize, Serialize};

/// Task 1, joint inference of goals and relations: the predicted probability of each answer.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Judgement {
    /// Goals of each agent with their probabilities, most likely first, no goal twice. A helper has the
    /// other's goal, a hinderer the other's goal negated, as in the labels.
    pub goals: [Vec<(Goal, f64)>; AGENT_COUNT],
    /// The relation between the two.
    pub relation: RelationProbabilities,
    /// Probabilities of who helps or hinders whom, if the model says.
    pub roles: Option<RoleProbabilities>,
    /// The share of people who would report each relation, if the model says. People report what they saw,
    /// which is not always what is true.
    pub reported: Option<RelationProbabilities>,
}

/// The probability that either agent helps, and that it hinders, the other. At most one of the four is true;
/// what they lack to 1 is the probability that both agents pursue goals of their own.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RoleProbabilities {
    /// P(α = 1) of each agent.
    pub helps: [f64; AGENT_COUNT],
    /// P(α = −1) of each agent.
    pub hinders: [f64; AGENT_COUNT],
}

impl RoleProbabilities {
    /// The probability of an attitude of an agent towards the other.
    #[must_use]
    pub fn of(&self, agent: AgentId, attitude: Attitude) -> f64 {
        match attitude {
            Attitude::Help => self.helps[agent],
            Attitude::Hinder => self.hinders[agent],
            Attitude::Neutral => 1.0 - self.helps[agent] - self.hinders[agent],
        }
    }
}

/// The probability of each relation; the three sum to 1.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RelationProbabilities {
    /// One helps the other, or both want the same.
    pub friendly: f64,
    /// One hinders the other, or their goals conflict.
    pub adversarial: f64,
    /// Neither.
    pub neutral: f64,
}

impl Default for RelationProbabilities {
    fn default() -> Self {
        Self { friendly: 1.0 / 3.0, adversarial: 1.0 / 3.0, neutral: 1.0 / 3.0 }
    }
}

impl RelationProbabilities {
    /// The probability of one of them.
    #[must_use]
    pub const fn of(&self, relation: Relation) -> f64 {
        match relation {
            Relation::Friendly => self.friendly,
            Relation::Adversarial => self.adversarial,
            Relation::Neutral => self.neutral,
        }
    }

    /// The most likely relation; ties are resolved in the order friendly, adversarial, neutral.
    #[must_use]
    pub fn most_likely(&self) -> Relation {
        let mut best = Relation::Friendly;
        for relation in [Relation::Adversarial, Relation::Neutral] {
            if self.of(relation) > self.of(best) {
                best = relation;
            }
        }
        best
    }
}

/// Task 2, multi-entity trajectory prediction: `forecast[k][step]` is the predicted position of the entity
/// with index `k` (agents first), `step` + 1 steps after the last observed one (u).
pub type Forecast = Vec<Vec<Vec2>>;

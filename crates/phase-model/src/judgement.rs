//! What a model of social perception answers: Task 1 and Task 2 of the paper.

use crate::{AGENT_COUNT, Goal, Relation, Vec2};
use serde::{Deserialize, Serialize};

/// Task 1, joint inference of goals and relations: how likely each answer is to a viewer.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Judgement {
    /// Goals of each agent with their probabilities, most likely first, no goal twice. A helper bears the other's
    /// goal, a hinderer the other's goal negated, as labels have it.
    pub goals: [Vec<(Goal, f64)>; AGENT_COUNT],
    /// The relation between the two.
    pub relation: RelationProbabilities,
}

/// How likely each relation is; the three add up to 1.
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

    /// The most likely relation; of equals the first in the order friendly, adversarial, neutral.
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

/// Task 2, multi-entity trajectory prediction: `forecast[k][step]` is where the entity with index `k` (agents first)
/// will be so many steps after the last one watched, from 1 on (u).
pub type Forecast = Vec<Vec<Vec2>>;

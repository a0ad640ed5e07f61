//! A method's answer to an event, and the label.

use super::canonical;
use crate::ratings::RatingCounts;
use phase_event::MethodError;
use phase_model::{
    AGENT_COUNT, AgentId, Attitude, EventKind, Goal, Judgement, Relation, RelationProbabilities,
    RoleProbabilities,
};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use thiserror::Error;

/// Tolerance for the sum of probabilities to differ from 1.
const TOLERANCE: f64 = 1e-3;

/// Why values are not an answer. The text continues from the field's name.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum InvalidAnswer {
    /// A goal's probability is invalid.
    #[error("`goals[{agent}][{place}].p` must be a number from 0 to 1")]
    Goal {
        /// The agent whose goal it is.
        agent: AgentId,
        /// Its place in the list.
        place: usize,
    },
    /// The probabilities of an agent's goals sum to more than 1.
    #[error("`goals[{0}]` must have probabilities of at most 1 in all")]
    Goals(AgentId),
    /// The relations' probabilities are invalid.
    #[error("`relation` must have three numbers from 0 to 1 that add up to 1")]
    Relation,
    /// The shares of reports are invalid.
    #[error("`reported` must have three numbers from 0 to 1 that add up to 1")]
    Reported,
    /// The roles' probabilities are invalid.
    #[error("`roles` must have four numbers from 0 to 1 that add up to at most 1")]
    Roles,
}

impl From<InvalidAnswer> for MethodError {
    fn from(invalid: InvalidAnswer) -> Self {
        Self::new(format!("the method's {invalid}"))
    }
}

/// A goal and its probability.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GoalProbability {
    /// The goal.
    pub goal: Goal,
    /// Its probability, 0 to 1.
    pub p: f64,
}

/// A method's answer to an event.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Answer {
    /// Goals of each agent, most likely first, no goal twice; those of equal probability in the method's
    /// order.
    pub goals: [Vec<GoalProbability>; AGENT_COUNT],
    /// The relations' probabilities.
    pub relation: RelationProbabilities,
    /// The probabilities that either agent helps or hinders the other, if the method says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roles: Option<RoleProbabilities>,
    /// The shares of people who would report each relation, if the method says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reported: Option<RelationProbabilities>,
}

impl Answer {
    /// Checks and orders a judgement. Probabilities of goals that are [the same](canonical) are added up.
    ///
    /// # Errors
    /// If a probability is invalid.
    pub fn of(judgement: &Judgement) -> Result<Self, InvalidAnswer> {
        let mut goals: [Vec<GoalProbability>; AGENT_COUNT] = Default::default();
        for (agent, (ranked, given)) in AgentId::ALL.into_iter().zip(goals.iter_mut().zip(&judgement.goals)) {
            for (place, &(goal, p)) in given.iter().enumerate() {
                if !probable(p) {
                    return Err(InvalidAnswer::Goal { agent, place });
                }
                match ranked.iter_mut().find(|share| canonical(share.goal) == canonical(goal)) {
                    Some(share) => share.p = (share.p + p).min(1.0),
                    None => ranked.push(GoalProbability { goal, p: p.min(1.0) }),
                }
            }
            if ranked.iter().map(|share| share.p).sum::<f64>() > 1.0 + TOLERANCE {
                return Err(InvalidAnswer::Goals(agent));
            }
            ranked.sort_by(|a, b| b.p.total_cmp(&a.p));
        }
        let relation = distribution(&judgement.relation).ok_or(InvalidAnswer::Relation)?;
        let reported =
            judgement.reported.map(|it| distribution(&it).ok_or(InvalidAnswer::Reported)).transpose()?;
        if let Some(RoleProbabilities { helps, hinders }) = judgement.roles {
            let four = || helps.into_iter().chain(hinders);
            if !four().all(probable) || four().sum::<f64>() > 1.0 + TOLERANCE {
                return Err(InvalidAnswer::Roles);
            }
        }
        Ok(Self { goals, relation, roles: judgement.roles, reported })
    }

    /// The rank of the correct goal of an agent among those named, from 0; `None` if it was not named.
    #[must_use]
    pub fn place(&self, agent: AgentId, right: Goal) -> Option<usize> {
        let right = canonical(right);
        self.goals[agent].iter().position(|share| canonical(share.goal) == right)
    }
}

/// Three probabilities of relations, if they are valid. A sum of probabilities may exceed 1 by a rounding
/// error.
fn distribution(relation: &RelationProbabilities) -> Option<RelationProbabilities> {
    let three = [relation.friendly, relation.adversarial, relation.neutral];
    let valid = three.into_iter().all(probable) && (three.iter().sum::<f64>() - 1.0).abs() <= TOLERANCE;
    let [friendly, adversarial, neutral] = three.map(|p| p.min(1.0));
    valid.then_some(RelationProbabilities { friendly, adversarial, neutral })
}

/// The labels of an event.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Label {
    /// The kind of event.
    pub kind: EventKind,
    /// The goals; a helper's or hinderer's as in labels.
    pub goals: [Goal; AGENT_COUNT],
    /// The intended relation.
    pub relation: Relation,
    /// The relation in human judgement, where available.
    pub relation_human: Option<Relation>,
    /// Whether the base layout occurs in the training or validation events too; `None` where unknown.
    pub layout_seen: Option<bool>,
    /// The agent that helps or hinders the other, if one does.
    pub role: Option<SocialRole>,
    /// People's ratings of the relation, where they were asked.
    pub ratings: Option<RatingCounts>,
    /// The set of events that it belongs to, which differ in one social variable, if it belongs to one.
    pub set: Option<String>,
}

/// An agent that helps or hinders the other.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct SocialRole {
    /// The agent.
    pub agent: AgentId,
    /// Helping or hindering.
    pub attitude: Attitude,
}

impl SocialRole {
    /// The role in a scene; of two social agents, which labels do not have, the first. `None` if there is
    /// none.
    #[must_use]
    pub fn of(attitudes: [Attitude; AGENT_COUNT]) -> Option<Self> {
        let roles = AgentId::ALL.map(|agent| Self { agent, attitude: attitudes[agent] });
        roles.into_iter().find(|role| role.attitude != Attitude::Neutral)
    }
}

/// A method's answer after a prefix of an event.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct PartialAnswer {
    /// Length of the prefix (s of video).
    pub seconds: f64,
    /// The answer.
    #[serde(flatten)]
    pub answer: Answer,
}

/// One event with a method's answer.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct RecognisedEvent {
    /// The event's name.
    pub id: String,
    /// The answer after the whole event.
    #[serde(flatten)]
    pub answer: Answer,
    /// The label.
    pub label: Label,
    /// Answers after prefixes of the event, in the order requested.
    pub watched: Vec<PartialAnswer>,
    /// CPU time for the answer to the whole event (s), if measured.
    pub cpu_seconds: Option<f64>,
    /// Details that the method attached.
    pub details: Value,
}

fn probable(p: f64) -> bool {
    (0.0..=1.0 + TOLERANCE).contains(&p)
}

//! Goals, social attitudes and relations.

use crate::{AgentId, Entity, Flip, LandmarkId, ObjectId, State, arena};
use serde::{Deserialize, Serialize};

/// Whether a goal's condition is to be achieved or avoided; +1 and −1 in files.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(into = "i8", try_from = "i8")]
pub enum Sign {
    /// −1: avoid or undo.
    Negative,
    /// +1: achieve.
    Positive,
}

impl Sign {
    /// −1 or +1.
    #[must_use]
    pub const fn value(self) -> i8 {
        match self {
            Self::Negative => -1,
            Self::Positive => 1,
        }
    }

    /// The other sign.
    #[must_use]
    pub const fn negated(self) -> Self {
        match self {
            Self::Negative => Self::Positive,
            Self::Positive => Self::Negative,
        }
    }
}

impl From<Sign> for i8 {
    fn from(sign: Sign) -> Self {
        sign.value()
    }
}

impl TryFrom<i8> for Sign {
    type Error = &'static str;

    fn try_from(value: i8) -> Result<Self, Self::Error> {
        match value {
            1 => Ok(Self::Positive),
            -1 => Ok(Self::Negative),
            _ => Err("a goal's sign is 1 or -1"),
        }
    }
}

/// A physical goal gᵢ of an agent: a condition on the state, to be achieved or avoided by its [`Sign`].
///
/// A goal of agent 0 may be about agent 1 or an object: it names its subject. Goals are common knowledge in
/// PHASE; what an agent wants of the other agent's goal is its [`Attitude`].
///
/// ```
/// use phase_model::{AgentId, Entity, Goal, LandmarkId, Sign};
///
/// let goal = Goal::AgentOnLandmark {
///     agent: AgentId::ONE,
///     landmark: LandmarkId::TOP_LEFT,
///     sign: Sign::Positive,
/// };
/// assert_eq!(goal.subject(), Entity::Agent(AgentId::ONE));
/// assert_eq!(goal.negated().sign(), Sign::Negative);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Goal {
    /// On(agent, landmark).
    AgentOnLandmark {
        /// The agent to be on the landmark.
        agent: AgentId,
        /// The landmark.
        landmark: LandmarkId,
        /// +1, or −1 to keep the agent off.
        sign: Sign,
    },
    /// On(object, landmark).
    ObjectOnLandmark {
        /// The object to be on the landmark.
        object: ObjectId,
        /// The landmark.
        landmark: LandmarkId,
        /// +1, or −1 to keep the object off.
        sign: Sign,
    },
    /// Touch(agent, other agent): approach (+1) or get away (−1).
    Touch {
        /// The agent that touches (in a chase, the chaser, for both agents' goals).
        agent: AgentId,
        /// The other agent.
        other: AgentId,
        /// +1 to approach, −1 to get away.
        sign: Sign,
    },
}

impl Goal {
    /// The goal's sign.
    #[must_use]
    pub const fn sign(self) -> Sign {
        match self {
            Self::AgentOnLandmark { sign, .. }
            | Self::ObjectOnLandmark { sign, .. }
            | Self::Touch { sign, .. } => sign,
        }
    }

    /// This goal with the other sign.
    #[must_use]
    pub const fn negated(self) -> Self {
        match self {
            Self::AgentOnLandmark { agent, landmark, sign } => {
                Self::AgentOnLandmark { agent, landmark, sign: sign.negated() }
            }
            Self::ObjectOnLandmark { object, landmark, sign } => {
                Self::ObjectOnLandmark { object, landmark, sign: sign.negated() }
            }
            Self::Touch { agent, other, sign } => Self::Touch { agent, other, sign: sign.negated() },
        }
    }

    /// The goal in a mirrored arena: the landmark becomes its mirror image.
    #[must_use]
    pub const fn mirrored(self, flip: Flip) -> Self {
        match self {
            Self::AgentOnLandmark { agent, landmark, sign } => {
                Self::AgentOnLandmark { agent, landmark: flip.landmark(landmark), sign }
            }
            Self::ObjectOnLandmark { object, landmark, sign } => {
                Self::ObjectOnLandmark { object, landmark: flip.landmark(landmark), sign }
            }
            Self::Touch { .. } => self,
        }
    }

    /// The goal's subject, and the landmark or entity that it has to reach.
    #[must_use]
    pub const fn subject(self) -> Entity {
        match self {
            Self::AgentOnLandmark { agent, .. } | Self::Touch { agent, .. } => Entity::Agent(agent),
            Self::ObjectOnLandmark { object, .. } => Entity::Object(object),
        }
    }

    /// The landmark of the goal, if it has one.
    #[must_use]
    pub const fn landmark(self) -> Option<LandmarkId> {
        match self {
            Self::AgentOnLandmark { landmark, .. } | Self::ObjectOnLandmark { landmark, .. } => {
                Some(landmark)
            }
            Self::Touch { .. } => None,
        }
    }

    /// Straight-line distance between the subject and its target in a state (u); 0 is the minimum.
    #[must_use]
    pub fn distance(self, state: &State) -> f32 {
        let subject = state.position(self.subject());
        match self {
            Self::AgentOnLandmark { landmark, .. } | Self::ObjectOnLandmark { landmark, .. } => {
                subject.distance(arena::LANDMARKS[landmark])
            }
            Self::Touch { other, .. } => subject.distance(state.position(Entity::Agent(other))),
        }
    }
}

/// Social utility weight α of an agent towards the other, in Equation 1 of the paper; −1, 0, 1 in files.
///
/// A neutral agent is rewarded for its own goal alone, a social one for the other's goal alone: positively if
/// it helps, negatively if it hinders. See [`social_reward`](crate::reward::social_reward).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default, Serialize, Deserialize)]
#[serde(into = "i8", try_from = "i8")]
pub enum Attitude {
    /// α = −1: wants the other not to reach its goal.
    Hinder,
    /// α = 0: wants its own goal.
    #[default]
    Neutral,
    /// α = 1: wants the other to reach its goal.
    Help,
}

impl Attitude {
    /// −1, 0 or 1.
    #[must_use]
    pub const fn alpha(self) -> i8 {
        match self {
            Self::Hinder => -1,
            Self::Neutral => 0,
            Self::Help => 1,
        }
    }
}

impl From<Attitude> for i8 {
    fn from(attitude: Attitude) -> Self {
        attitude.alpha()
    }
}

impl TryFrom<i8> for Attitude {
    type Error = &'static str;

    fn try_from(value: i8) -> Result<Self, Self::Error> {
        match value {
            -1 => Ok(Self::Hinder),
            0 => Ok(Self::Neutral),
            1 => Ok(Self::Help),
            _ => Err("an attitude `alpha` is -1, 0 or 1"),
        }
    }
}

/// The relation between the two agents, as a viewer would name it: the label of the paper's Task 1.
///
/// [`Relation::of`] derives it from goals and attitudes, so that a scene cannot disagree with its label.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Relation {
    /// One helps the other, or both want the same.
    Friendly,
    /// One hinders the other, or their goals conflict.
    Adversarial,
    /// Neither.
    Neutral,
}

impl Relation {
    /// The name used in files and on screen.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Friendly => "friendly",
            Self::Adversarial => "adversarial",
            Self::Neutral => "neutral",
        }
    }

    /// The paper's definition on goals and attitudes (section "Inference" and appendix): an attitude that is
    /// not neutral decides; else equal goals are friendly; else the same object wanted on two landmarks, or
    /// one agent approaching another that gets away, are adversarial; else neutral.
    #[must_use]
    pub fn of(goals: [Goal; 2], attitudes: [Attitude; 2]) -> Self {
        if attitudes.contains(&Attitude::Help) {
            Self::Friendly
        } else if attitudes.contains(&Attitude::Hinder) {
            Self::Adversarial
        } else if goals[0] == goals[1] && goals[0].sign() == Sign::Positive {
            Self::Friendly
        } else if conflict(goals[0], goals[1]) {
            Self::Adversarial
        } else {
            Self::Neutral
        }
    }
}

/// The two kinds of conflict the paper names: one object, two landmarks; and chase against flight.
fn conflict(a: Goal, b: Goal) -> bool {
    match (a, b) {
        (
            Goal::ObjectOnLandmark { object: object_a, landmark: landmark_a, .. },
            Goal::ObjectOnLandmark { object: object_b, landmark: landmark_b, .. },
        ) => object_a == object_b && landmark_a != landmark_b,
        (Goal::Touch { sign: sign_a, .. }, Goal::Touch { sign: sign_b, .. }) => sign_a != sign_b,
        _ => false,
    }
}

//! The variants of each kind of event, and the goals that each of them is about.

use crate::draft::{agent_on, object_on};
use phase_model::{AgentId, EventKind, Goal, LandmarkId, ObjectId, Sign};
use serde::{Deserialize, Serialize};

/// How a kind of event comes about. The social agent, or the one that chases, is role 0 in what follows; which
/// agent plays it is drawn with the scene.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Variant {
    /// Helping: the object is too heavy for the other.
    Lift,
    /// Helping: the other is too big for the door behind which its object lies.
    Blocked,
    /// Helping: an object stands behind the door that the other has to go through.
    Move,
    /// Hindering: the other wants to go to a landmark.
    HinderPlace,
    /// Hindering: the other wants an object on a landmark.
    HinderObject,
    /// Hindering: the other wants to touch the hinderer.
    Evade,
    /// Hindering: the other wants to get away from the hinderer.
    Pester,
    /// Chasing: one wants to touch the other, which wants to get away.
    Chase,
    /// Competing: one object, two landmarks.
    Compete,
    /// Collaborating: one object, one landmark.
    Carry,
    /// Independent: two agents go to two landmarks.
    Places,
    /// Independent: one agent moves an object, the other goes to a landmark.
    Mixed,
    /// Independent: two agents move two objects.
    Objects,
}

impl Variant {
    /// All variants, by kind.
    pub const ALL: [Self; 13] = [
        Self::Lift,
        Self::Blocked,
        Self::Move,
        Self::HinderPlace,
        Self::HinderObject,
        Self::Evade,
        Self::Pester,
        Self::Chase,
        Self::Compete,
        Self::Carry,
        Self::Places,
        Self::Mixed,
        Self::Objects,
    ];

    /// The kind of event it belongs to.
    #[must_use]
    pub const fn kind(self) -> EventKind {
        match self {
            Self::Lift | Self::Blocked | Self::Move => EventKind::Helping,
            Self::HinderPlace | Self::HinderObject | Self::Evade | Self::Pester => EventKind::Hindering,
            Self::Chase => EventKind::Chasing,
            Self::Compete => EventKind::Competing,
            Self::Carry => EventKind::Collaborating,
            Self::Places | Self::Mixed | Self::Objects => EventKind::Independent,
        }
    }

    /// The name used in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lift => "lift",
            Self::Blocked => "blocked",
            Self::Move => "move",
            Self::HinderPlace => "hinder-place",
            Self::HinderObject => "hinder-object",
            Self::Evade => "evade",
            Self::Pester => "pester",
            Self::Chase => "chase",
            Self::Compete => "compete",
            Self::Carry => "carry",
            Self::Places => "places",
            Self::Mixed => "mixed",
            Self::Objects => "objects",
        }
    }

    /// The variants of a kind.
    #[must_use]
    pub fn of(kind: EventKind) -> Vec<Self> {
        Self::ALL.into_iter().filter(|variant| variant.kind() == kind).collect()
    }

    /// Number of pairs of goals.
    #[must_use]
    pub const fn goal_count(self) -> usize {
        match self {
            Self::Lift | Self::Blocked | Self::HinderObject | Self::Carry => 8,
            Self::Move | Self::HinderPlace => 4,
            Self::Evade | Self::Pester | Self::Chase => 1,
            Self::Compete | Self::Mixed => 24,
            Self::Places | Self::Objects => 12,
        }
    }

    /// The goals of roles 0 and 1 at `goal_index`; they repeat after [`Variant::goal_count`] indices, and any
    /// four consecutive indices name every landmark equally often.
    #[must_use]
    pub const fn goals(self, goal_index: usize) -> [Goal; 2] {
        let at = LandmarkId::ALL;
        let first = goal_index % at.len();
        let round = goal_index / at.len();
        let object = ObjectId::ALL[round % 2];
        match self {
            Self::Lift | Self::Blocked | Self::Carry => [object_on(object, at[first]); 2],
            Self::Move => [agent_on(AgentId::ONE, at[first]); 2],
            Self::HinderPlace => {
                [agent_on(AgentId::ONE, at[first]).negated(), agent_on(AgentId::ONE, at[first])]
            }
            Self::HinderObject => [object_on(object, at[first]).negated(), object_on(object, at[first])],
            Self::Evade => [touch(AgentId::ONE, Sign::Negative), touch(AgentId::ONE, Sign::Positive)],
            Self::Pester | Self::Chase => {
                [touch(AgentId::ZERO, Sign::Positive), touch(AgentId::ZERO, Sign::Negative)]
            }
            Self::Compete => {
                let second = (first + 1 + (round / 2) % 3) % at.len();
                [object_on(object, at[first]), object_on(object, at[second])]
            }
            Self::Places => [
                agent_on(AgentId::ZERO, at[first]),
                agent_on(AgentId::ONE, at[(first + 1 + round % 3) % at.len()]),
            ],
            Self::Mixed => {
                let second = (first + 1 + (round / 2) % 3) % at.len();
                [object_on(object, at[first]), agent_on(AgentId::ONE, at[second])]
            }
            Self::Objects => [
                object_on(ObjectId::ZERO, at[first]),
                object_on(ObjectId::ONE, at[(first + 1 + round % 3) % at.len()]),
            ],
        }
    }
}

/// The goal that an agent touches the other one.
const fn touch(agent: AgentId, sign: Sign) -> Goal {
    Goal::Touch { agent, other: agent.other(), sign }
}

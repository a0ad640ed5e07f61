//! The variants of each kind of event, and the goals that each of them is about.

use crate::draft::{agent_on, object_on};
use phase_model::{AgentId, Attitude, EventKind, Goal, LandmarkId, ObjectId, Sign};
use serde::{Deserialize, Serialize};

/// A way in which a kind of event comes about. The social agent, or the one that chases, is role 0 in what
/// follows; which agent plays it is drawn with the scene.
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
    /// Helping: the helper brings the object that the other wants on a landmark and cannot reach.
    Fetch,
    /// Helping: the helper brings that object part of the way, and the other takes it on.
    HandOver,
    /// Helping: the helper stands in the other's way, and leaves it.
    MakeWay,
    /// Hindering: the hinderer stands in the other's way to a landmark.
    Block,
    /// Hindering: the hinderer takes an object from the other and carries it off.
    Take,
    /// Hindering: both hold the object that the other wants on a landmark, and pull.
    Drag,
    /// Hindering: the hinderer carries the object off before the other comes to it.
    Hide,
    /// Hindering: the hinderer moves the object off the landmark that the other brought it to.
    Undo,
    /// Independent: two agents go to two landmarks, each to the room in which the other starts.
    Cross,
    /// Helping in whatever manner: the other's object gets to its landmark sooner.
    Assist,
    /// Competing: one agent waits while the other moves the object out of its sight, then looks for it.
    Seek,
}

impl Variant {
    /// All variants: those of the first edition, then those of the second, each by kind.
    pub const ALL: [Self; 24] = [
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
        Self::Fetch,
        Self::HandOver,
        Self::MakeWay,
        Self::Block,
        Self::Take,
        Self::Drag,
        Self::Hide,
        Self::Undo,
        Self::Cross,
        Self::Assist,
        Self::Seek,
    ];

    /// The kind of event it belongs to.
    #[must_use]
    pub const fn kind(self) -> EventKind {
        match self {
            Self::Lift
            | Self::Blocked
            | Self::Move
            | Self::Fetch
            | Self::HandOver
            | Self::MakeWay
            | Self::Assist => EventKind::Helping,
            Self::HinderPlace
            | Self::HinderObject
            | Self::Evade
            | Self::Pester
            | Self::Block
            | Self::Take
            | Self::Drag
            | Self::Hide
            | Self::Undo => EventKind::Hindering,
            Self::Chase => EventKind::Chasing,
            Self::Compete | Self::Seek => EventKind::Competing,
            Self::Carry => EventKind::Collaborating,
            Self::Places | Self::Mixed | Self::Objects | Self::Cross => EventKind::Independent,
        }
    }

    /// The attitude of role 0; role 1 is neutral.
    #[must_use]
    pub const fn attitude(self) -> Attitude {
        match self.kind() {
            EventKind::Helping => Attitude::Help,
            EventKind::Hindering => Attitude::Hinder,
            _ => Attitude::Neutral,
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
            Self::Fetch => "fetch",
            Self::HandOver => "hand-over",
            Self::MakeWay => "make-way",
            Self::Block => "block",
            Self::Take => "take",
            Self::Drag => "drag",
            Self::Hide => "hide",
            Self::Undo => "undo",
            Self::Cross => "cross",
            Self::Assist => "assist",
            Self::Seek => "seek",
        }
    }

    /// Whether it belongs to the first edition, whose scenes are drawn without regard to what else may happen
    /// in them.
    #[must_use]
    pub(crate) const fn is_first_edition(self) -> bool {
        matches!(
            self,
            Self::Lift
                | Self::Blocked
                | Self::Move
                | Self::HinderPlace
                | Self::HinderObject
                | Self::Evade
                | Self::Pester
                | Self::Chase
                | Self::Compete
                | Self::Carry
                | Self::Places
                | Self::Mixed
                | Self::Objects
        )
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
            Self::Lift
            | Self::Blocked
            | Self::HinderObject
            | Self::Carry
            | Self::Fetch
            | Self::HandOver
            | Self::Assist
            | Self::Take
            | Self::Drag
            | Self::Hide
            | Self::Undo => 8,
            Self::Move | Self::HinderPlace | Self::MakeWay | Self::Block => 4,
            Self::Evade | Self::Pester | Self::Chase => 1,
            Self::Compete | Self::Seek | Self::Mixed => 24,
            Self::Places | Self::Objects | Self::Cross => 12,
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
            Self::Lift | Self::Blocked | Self::Carry | Self::Fetch | Self::HandOver | Self::Assist => {
                [object_on(object, at[first]); 2]
            }
            Self::Move | Self::MakeWay => [agent_on(AgentId::ONE, at[first]); 2],
            Self::HinderPlace | Self::Block => {
                [agent_on(AgentId::ONE, at[first]).negated(), agent_on(AgentId::ONE, at[first])]
            }
            Self::HinderObject | Self::Take | Self::Drag | Self::Hide | Self::Undo => {
                [object_on(object, at[first]).negated(), object_on(object, at[first])]
            }
            Self::Evade => [touch(AgentId::ONE, Sign::Negative), touch(AgentId::ONE, Sign::Positive)],
            Self::Pester | Self::Chase => {
                [touch(AgentId::ZERO, Sign::Positive), touch(AgentId::ZERO, Sign::Negative)]
            }
            Self::Compete | Self::Seek => {
                let second = (first + 1 + (round / 2) % 3) % at.len();
                [object_on(object, at[first]), object_on(object, at[second])]
            }
            Self::Places | Self::Cross => [
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

//! Symbolic states, and the operators that lead from one to another.

use crate::problem::{Location, PlanningProblem};
use phase_model::{AGENT_COUNT, AgentId, BodySet, Entity, LandmarkId, MAX_OBJECTS, ObjectId, RoomId, SlotId};

/// A symbolic state of the search: positions are locations.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Node {
    /// Location of each agent.
    pub agents: [Location; AGENT_COUNT],
    /// Location of each object, and of its holders, if any.
    pub objects: [Location; MAX_OBJECTS],
    /// The object that each agent holds.
    pub holds: [Option<ObjectId>; AGENT_COUNT],
}

impl Node {
    /// The symbolic state that a physical state starts in.
    #[must_use]
    pub fn start(problem: &PlanningProblem<'_>) -> Self {
        Self {
            agents: AgentId::ALL.map(|agent| Location::Current(Entity::Agent(agent))),
            objects: ObjectId::ALL.map(|object| Location::Current(Entity::Object(object))),
            holds: problem.state.grips.map(|grip| grip.map(|grip| grip.object)),
        }
    }

    /// Objects that have not been moved.
    pub(crate) fn unmoved(&self) -> BodySet {
        ObjectId::ALL
            .into_iter()
            .filter(|&object| self.objects[object] == Location::Current(Entity::Object(object)))
            .map(Entity::Object)
            .collect()
    }

    /// Whether each agent holds an object.
    #[must_use]
    pub fn holders(&self, object: ObjectId) -> [bool; AGENT_COUNT] {
        self.holds.map(|held| held == Some(object))
    }
}

/// One symbolic action of one agent (of all holders, for carrying).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Operator {
    /// Go to where an object is.
    Approach {
        /// The agent.
        agent: AgentId,
        /// The object.
        object: ObjectId,
    },
    /// Go to where the other agent is.
    Meet {
        /// The agent.
        agent: AgentId,
    },
    /// Go to a landmark, with free hands.
    Go {
        /// The agent.
        agent: AgentId,
        /// The landmark.
        landmark: LandmarkId,
    },
    /// Grasp an object.
    Grab {
        /// The agent.
        agent: AgentId,
        /// The object.
        object: ObjectId,
    },
    /// Move a held object, and with it all agents that hold it, to a landmark.
    Carry {
        /// The leading agent.
        agent: AgentId,
        /// The object.
        object: ObjectId,
        /// The destination.
        landmark: LandmarkId,
    },
    /// Bring an object to a door that its holder does not fit through, push it through and release it.
    Pass {
        /// The agent.
        agent: AgentId,
        /// The object.
        object: ObjectId,
        /// The slot of the door.
        slot: SlotId,
        /// The room that the object ends up in.
        room: RoomId,
    },
    /// Release the object held.
    Release {
        /// The agent.
        agent: AgentId,
        /// The object.
        object: ObjectId,
    },
}

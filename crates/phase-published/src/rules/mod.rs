//! The rule sets of the high level: from one possible state of the world to one subgoal.

mod adversarial;
mod friendly;
mod neutral;

use crate::{
    aim::Aim,
    recorded::CARRYING_WIDTH,
    rooms::Rooms,
    senses::{attachable, in_view},
};
use phase_model::{
    AGENT_COUNT, AgentId, Attitude, Entity, Goal, LandmarkId, Layout, ObjectId, PhysicsConfig, RoomId, Sign,
    State, arena, layout::room_of,
};

/// The facts that the rules look at: the map, the bodies, goals and attitudes.
#[derive(Clone, Debug)]
pub(crate) struct Rules {
    pub(crate) layout: Layout,
    pub(crate) rooms: Rooms,
    pub(crate) physics: PhysicsConfig,
    pub(crate) agent: AgentId,
    pub(crate) goals: [Goal; AGENT_COUNT],
    pub(crate) attitude: Attitude,
    /// Whether one of the agents hinders the other.
    pub(crate) hindering: bool,
}

impl Rules {
    /// The subgoal in one possible state of the world.
    pub(crate) fn aim(&self, state: &State) -> Aim {
        let view = View { rules: self, state, me: self.agent, other: self.agent.other() };
        match self.attitude {
            Attitude::Neutral => view.neutral(self.goal()),
            Attitude::Help => view.friendly(self.goal()),
            Attitude::Hinder => view.adversarial(self.goal()),
        }
    }

    /// A room of the layout before reflection, as it is now.
    pub(crate) fn room(&self, room: RoomId) -> RoomId {
        self.layout.flip().map_or(room, |flip| flip.room(room))
    }

    /// The goal that the agent is concerned with: its own, or the other's if it helps or hinders.
    pub(crate) fn goal(&self) -> Goal {
        match self.attitude {
            Attitude::Neutral => self.goals[self.agent],
            Attitude::Help | Attitude::Hinder => self.goals[self.agent.other()],
        }
    }
}

/// One possible state, seen by one agent.
#[derive(Clone, Copy)]
struct View<'a> {
    rules: &'a Rules,
    state: &'a State,
    me: AgentId,
    other: AgentId,
}

impl View<'_> {
    const fn rooms(&self) -> &Rooms {
        &self.rules.rooms
    }

    fn room(&self, entity: Entity) -> RoomId {
        room_of(self.state.position(entity))
    }

    fn my_room(&self) -> RoomId {
        self.room(Entity::Agent(self.me))
    }

    fn other_room(&self) -> RoomId {
        self.room(Entity::Agent(self.other))
    }

    /// Length of the path from an entity to a landmark (u).
    fn landmark_distance(&self, entity: Entity, landmark: LandmarkId) -> f64 {
        self.rooms().distance(self.state.position(entity), arena::LANDMARKS[landmark])
    }

    /// Length of the path between two entities (u).
    fn between(&self, a: Entity, b: Entity) -> f64 {
        self.rooms().distance(self.state.position(a), self.state.position(b))
    }

    /// Whether a door on the way is too narrow for an agent that carries something.
    fn blocked(&self, agent: AgentId, from: RoomId, to: RoomId) -> bool {
        self.rooms().blocked(from, to, CARRYING_WIDTH * self.rules.physics.agents[agent].radius)
    }

    /// Lets go of what it holds, or stops.
    fn release_or_stop(&self) -> Aim {
        match self.state.held_object(self.me) {
            Some(object) => Aim::Grab(self.me, object, Sign::Negative),
            None => Aim::Stop,
        }
    }

    /// Whether it could grab an object now.
    fn attachable(&self, object: ObjectId) -> bool {
        attachable(&self.rules.physics, self.state, self.me, object)
    }

    fn sees(&self, entity: Entity) -> bool {
        in_view(&self.rules.physics, self.state, self.me, entity)
    }
}

//! The rule sets of the high level: from one possible state of the world to one subgoal.

mod adversarial;
mod friendly;
mod neutral;

use crate::{aim::Aim, rooms::Rooms, senses::in_view};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Attitude, Entity, Goal, LandmarkId, ObjectId, PhysicsConfig, RoomId, Sign,
    State, arena, layout::room_of,
};

/// An agent is on a landmark within this distance (u): a reward above −0.02.
pub(crate) const AGENT_REACHED: f32 = 0.02 * arena::DIAGONAL;
/// An object is on a landmark within this distance (u): a reward above −0.05.
pub(crate) const OBJECT_REACHED: f32 = 0.05 * arena::DIAGONAL;
/// Width of an agent that carries, for doors: one and a half times its size on each side.
const CARRYING_WIDTH: f32 = 1.5;

/// The facts that the rules look at: the map, the bodies, goals and attitudes.
#[derive(Clone, Debug)]
pub(crate) struct Rules {
    pub(crate) rooms: Rooms,
    pub(crate) physics: PhysicsConfig,
    pub(crate) agent: AgentId,
    pub(crate) goals: [Goal; AGENT_COUNT],
    pub(crate) attitude: Attitude,
    /// Whether the other hinders.
    pub(crate) hindered: bool,
}

impl Rules {
    /// The actions to choose from for a subgoal. One who is hindered on the way to a landmark, with the other
    /// in the same room of it, may push in all directions, as the other may who wants it elsewhere.
    pub(crate) fn actions(&self, aim: Aim, state: &State) -> &'static [Action] {
        let room = |agent| room_of(state.position(Entity::Agent(agent)));
        let wrestles = match aim {
            Aim::AgentToLandmark(agent, landmark, _) => {
                self.hindered
                    && agent == self.agent
                    && AgentId::ALL.iter().all(|&agent| room(agent) == landmark.room())
            }
            _ => false,
        };
        aim.actions(self.agent, wrestles, &self.rooms, &self.physics, state)
    }

    /// The subgoal in one possible state of the world.
    pub(crate) fn aim(&self, state: &State) -> Aim {
        let view = View { rules: self, state, me: self.agent, other: self.agent.other() };
        let others = self.goals[self.agent.other()];
        match self.attitude {
            Attitude::Neutral => view.neutral(self.goals[self.agent]),
            Attitude::Help => view.friendly(others),
            Attitude::Hinder => view.adversarial(others),
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
    fn landmark_distance(&self, entity: Entity, landmark: LandmarkId) -> f32 {
        self.rooms().distance(self.state.position(entity), arena::LANDMARKS[landmark])
    }

    /// Length of the path between two entities (u).
    fn between(&self, a: Entity, b: Entity) -> f32 {
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
        let found = self.state.attachable(&self.rules.physics, self.me);
        found.is_some_and(|(found, _)| found == object)
    }

    fn sees(&self, entity: Entity) -> bool {
        in_view(&self.rules.physics, self.state, self.me, entity)
    }
}

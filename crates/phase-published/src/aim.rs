//! The subgoals that the published planner's high level gives to its low level.

use crate::{
    recorded::{DIAGONAL, ROOM_BONUS},
    rooms::Rooms,
};
use phase_model::{
    Action, AgentId, Entity, Goal, LandmarkId, Literal, ObjectId, Predicate, PredicateTarget, RoomId, Sign,
    State, Subgoal, Vec2, arena, layout::room_of,
};

/// A subgoal of the published planner.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Aim {
    /// Stop at once, without a search.
    Stop,
    /// An agent on a landmark.
    AgentToLandmark(AgentId, LandmarkId, Sign),
    /// An object on a landmark.
    ObjectToLandmark(ObjectId, LandmarkId, Sign),
    /// An agent at an entity, or away from it.
    Touch(AgentId, Entity, Sign),
    /// An agent in a room, or away from it.
    AgentToRoom(AgentId, RoomId, Sign),
    /// An object in a room.
    ObjectToRoom(ObjectId, RoomId),
    /// An agent holds an object, or releases it.
    Grab(AgentId, ObjectId, Sign),
}

/// The actions of an agent whose hands play no part.
const WALKING: [Action; 5] = [Action::TurnLeft, Action::TurnRight, Action::Up, Action::Stop, Action::NoForce];

impl Aim {
    /// The actions that the low level chooses from. `older` is the action set of recordings before the 28th
    /// of August 2020, in which an agent may push in all directions on the way to a landmark.
    #[must_use]
    pub fn actions(self, own: AgentId, older: bool, state: &State) -> &'static [Action] {
        const ALL: &[Action; 14] = &Action::ALL;
        let with_attach = &ALL[..13];
        let without_hands = &ALL[..12];
        let holding = state.held_object(own).is_some();
        match self {
            Self::Stop => &[Action::Stop],
            Self::AgentToLandmark(agent, ..) if agent != own || older => without_hands,
            Self::AgentToLandmark(..) | Self::AgentToRoom(..) | Self::Touch(..) => &WALKING,
            Self::ObjectToLandmark(..) => with_attach,
            Self::Grab(..) if holding => ALL,
            Self::ObjectToRoom(..) if holding => without_hands,
            Self::Grab(..) | Self::ObjectToRoom(..) => with_attach,
        }
    }

    /// The distance that the reward of a state charges, or credits with a negative sign (u).
    #[must_use]
    pub fn distance(self, rooms: &Rooms, state: &State) -> f64 {
        let at = |entity| state.position(entity);
        match self {
            Self::Stop => 0.0,
            Self::AgentToLandmark(agent, landmark, _) => {
                rooms.distance(at(Entity::Agent(agent)), arena::LANDMARKS[landmark])
            }
            Self::ObjectToLandmark(object, landmark, _) => {
                rooms.distance(at(Entity::Object(object)), arena::LANDMARKS[landmark])
            }
            Self::Touch(agent, entity, _) => rooms.distance(at(Entity::Agent(agent)), at(entity)),
            Self::AgentToRoom(agent, room, _) => rooms.room_distance(at(Entity::Agent(agent)), room),
            Self::ObjectToRoom(object, room) => {
                let place: Vec2 = at(Entity::Object(object));
                let bonus = if room_of(place) == room { ROOM_BONUS } else { 0.0 };
                rooms.room_distance(place, room) - bonus
            }
            Self::Grab(agent, object, _) => {
                if state.holds(agent, object) {
                    0.0
                } else {
                    1.0
                }
            }
        }
    }

    /// The reward of a state and an action: the distance as a share of the arena's diagonal, and the cost of
    /// a push that is not forward.
    #[must_use]
    pub fn reward(self, rooms: &Rooms, state: &State, action: Action) -> f64 {
        let sign = f64::from(self.sign().value());
        -sign * self.distance(rooms, state) / DIAGONAL + phase_model::reward::action_cost(action)
    }

    /// Whether it is to be achieved or undone.
    #[must_use]
    pub const fn sign(self) -> Sign {
        match self {
            Self::AgentToLandmark(.., sign)
            | Self::ObjectToLandmark(.., sign)
            | Self::Touch(.., sign)
            | Self::AgentToRoom(.., sign)
            | Self::Grab(.., sign) => sign,
            Self::Stop | Self::ObjectToRoom(..) => Sign::Positive,
        }
    }

    /// This subgoal as one of the paper. Being in a room is being close to its landmark.
    #[must_use]
    pub fn subgoal(self) -> Subgoal {
        let room = |room: RoomId| PredicateTarget::Landmark(room.landmark());
        let predicate = match self {
            Self::Stop => return Subgoal::Stay,
            Self::AgentToLandmark(agent, landmark, _) => Predicate::On(Entity::Agent(agent), landmark),
            Self::ObjectToLandmark(object, landmark, _) => Predicate::On(Entity::Object(object), landmark),
            Self::Touch(agent, entity, _) => Predicate::Touch(agent, entity),
            Self::AgentToRoom(agent, to, _) => Predicate::Close(Entity::Agent(agent), room(to)),
            Self::ObjectToRoom(object, to) => Predicate::Close(Entity::Object(object), room(to)),
            Self::Grab(agent, object, _) => Predicate::Attach(agent, object),
        };
        Subgoal::Achieve(Literal { predicate, holds: self.sign() == Sign::Positive })
    }
}

impl From<Goal> for Aim {
    fn from(goal: Goal) -> Self {
        match goal {
            Goal::AgentOnLandmark { agent, landmark, sign } => Self::AgentToLandmark(agent, landmark, sign),
            Goal::ObjectOnLandmark { object, landmark, sign } => {
                Self::ObjectToLandmark(object, landmark, sign)
            }
            Goal::Touch { agent, other, sign } => Self::Touch(agent, Entity::Agent(other), sign),
        }
    }
}

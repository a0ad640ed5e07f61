//! The neutral rules: one's own goal.

use super::View;
use crate::{
    aim::Aim,
    recorded::{AGENT_REACHED, OBJECT_REACHED},
};
use phase_model::{Entity, Goal, LandmarkId, ObjectId, RoomId, Sign};

impl View<'_> {
    /// A goal of one's own. Negative ones are pursued as they are, by distance alone.
    pub(super) fn neutral(&self, goal: Goal) -> Aim {
        match goal {
            Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive } if agent == self.me => {
                self.go_to_landmark(landmark)
            }
            Goal::ObjectOnLandmark { object, landmark, sign: Sign::Positive } => self.put(object, landmark),
            Goal::Touch { agent, other, sign: Sign::Positive } if agent == self.me => {
                self.go_to(Entity::Agent(other))
            }
            _ => goal.into(),
        }
    }

    /// Goes to a landmark, room by room.
    pub(super) fn go_to_landmark(&self, landmark: LandmarkId) -> Aim {
        let aim = Aim::AgentToLandmark(self.me, landmark, Sign::Positive);
        if self.landmark_distance(Entity::Agent(self.me), landmark) < AGENT_REACHED {
            return self.release_or_stop();
        }
        if self.rooms().is_open() {
            return match self.state.held_object(self.me) {
                Some(object) => Aim::Grab(self.me, object, Sign::Negative),
                None => aim,
            };
        }
        self.towards(landmark.room()).unwrap_or(aim)
    }

    /// Goes to another entity, room by room until it is in view.
    pub(super) fn go_to(&self, entity: Entity) -> Aim {
        let aim = Aim::Touch(self.me, entity, Sign::Positive);
        match self.towards(self.room(entity)) {
            Some(next) if !self.rooms().is_open() && !self.sees(entity) => next,
            _ => aim,
        }
    }

    /// The next room on the way; `None` if it is there.
    pub(super) fn towards(&self, room: RoomId) -> Option<Aim> {
        let here = self.my_room();
        (here != room).then(|| Aim::AgentToRoom(self.me, self.rooms().next(here, room), Sign::Positive))
    }

    /// Puts an object on a landmark: goes there, grabs it, drags it room by room, releases it.
    pub(super) fn put(&self, object: ObjectId, landmark: LandmarkId) -> Aim {
        let entity = Entity::Object(object);
        let done = self.landmark_distance(entity, landmark) < OBJECT_REACHED;
        let aim = Aim::ObjectToLandmark(object, landmark, Sign::Positive);
        let release = Aim::Grab(self.me, object, Sign::Negative);
        let holding = self.state.held_object(self.me).is_some();
        let goal = landmark.room();
        let both_hold = self.state.grips.iter().all(Option::is_some);
        if !self.rooms().is_open() && both_hold && self.blocked(self.me, self.my_room(), goal) {
            return self.release_or_stop();
        }
        if !holding {
            return if done {
                Aim::Stop
            } else if self.attachable(object) {
                Aim::Grab(self.me, object, Sign::Positive)
            } else {
                self.go_to(entity)
            };
        }
        if done {
            return release;
        }
        let here = self.room(entity);
        if self.rooms().is_open() || here == goal {
            return aim;
        }
        Aim::ObjectToRoom(object, self.rooms().next(here, goal))
    }
}

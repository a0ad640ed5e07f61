//! The friendly rules: the other's goal, by what the other cannot do.

use super::View;
use crate::{
    aim::Aim,
    recorded::{OBJECT_REACHED, TOUCH_REACHED},
};
use phase_model::{AgentId, Entity, Goal, LandmarkId, ObjectId, Sign};

impl View<'_> {
    /// Helps the other with its goal.
    pub(super) fn friendly(&self, goal: Goal) -> Aim {
        match goal {
            Goal::ObjectOnLandmark { object, landmark, sign: Sign::Positive } => {
                self.help_put(object, landmark)
            }
            Goal::AgentOnLandmark { landmark, sign: Sign::Positive, .. } => self.help_go(landmark),
            Goal::Touch { agent, sign: Sign::Positive, .. } => {
                // What the other wants to touch is the helper itself.
                if self.between(Entity::Agent(self.me), Entity::Agent(agent)) < TOUCH_REACHED {
                    self.release_or_stop()
                } else {
                    self.go_to(Entity::Agent(agent))
                }
            }
            _ => goal.into(),
        }
    }

    /// Helps to put an object on a landmark.
    fn help_put(&self, object: ObjectId, landmark: LandmarkId) -> Aim {
        if self.rooms().is_open() {
            return self.put(object, landmark);
        }
        let entity = Entity::Object(object);
        if self.landmark_distance(entity, landmark) < OBJECT_REACHED {
            return self.release_or_stop();
        }
        let there = self.room(entity);
        let goal = landmark.room();
        let reaches = |agent: AgentId, to| !self.blocked(agent, self.room(Entity::Agent(agent)), to);
        let i_reach_it = reaches(self.me, there);
        let i_reach_goal = reaches(self.me, goal);
        if i_reach_it && i_reach_goal {
            return self.put(object, landmark);
        }
        let both_hold = self.state.grips.iter().all(Option::is_some);
        if both_hold && !i_reach_goal {
            return self.release_or_stop();
        }
        if self.state.grips[self.other].is_some() {
            return Aim::Stop;
        }
        let other_reaches_it = reaches(self.other, there);
        let other_reaches_goal = reaches(self.other, goal);
        if other_reaches_goal && !other_reaches_it {
            return if i_reach_it { self.bring(object) } else { Aim::Stop };
        }
        if other_reaches_it && !other_reaches_goal {
            return if i_reach_goal { self.put(object, landmark) } else { Aim::Stop };
        }
        Aim::ObjectToLandmark(object, landmark, Sign::Positive)
    }

    /// Brings an object to the other, which wants it.
    fn bring(&self, object: ObjectId) -> Aim {
        let entity = Entity::Object(object);
        let there = self.room(entity);
        let wanted = self.other_room();
        if there == wanted && self.between(Entity::Agent(self.other), entity) < TOUCH_REACHED {
            return self.release_or_stop();
        }
        if !self.state.holds(self.me, object) {
            return self.put(object, wanted.landmark());
        }
        if self.my_room() == wanted {
            Aim::Touch(self.other, entity, Sign::Positive)
        } else {
            Aim::ObjectToRoom(object, self.rooms().next(there, wanted))
        }
    }

    /// Helps the other to a landmark: clears the first object out of the doors on its way.
    fn help_go(&self, landmark: LandmarkId) -> Aim {
        let goal = landmark.room();
        if self.rooms().is_open() {
            return Aim::Stop;
        }
        let first = (self.rules.physics.object_count > 0).then_some(ObjectId::ZERO);
        if self.other_room() == goal {
            let here = first.is_some_and(|object| self.room(Entity::Object(object)) == goal);
            return if here && self.my_room() == goal {
                Aim::AgentToLandmark(self.other, landmark, Sign::Positive)
            } else {
                Aim::Stop
            };
        }
        let (Some(object), Some(way)) = (first, self.rooms().way(self.other_room(), goal)) else {
            return self.release_or_stop();
        };
        let place = self.state.position(Entity::Object(object));
        let reach = self.rules.physics.object_radii[object] + self.rules.physics.agents[self.other].radius;
        if self.rooms().doors(way).any(|door| door.middle().distance(place) < reach) {
            self.put(object, self.room(Entity::Object(object)).landmark())
        } else {
            self.release_or_stop()
        }
    }
}

//! The adversarial rules: against the other's goal.

use super::View;
use crate::aim::Aim;
use phase_model::{AgentId, Entity, Goal, LandmarkId, ObjectId, RoomId, Sign};

impl View<'_> {
    /// Hinders the other in its goal.
    pub(super) fn adversarial(&self, goal: Goal) -> Aim {
        match goal {
            Goal::AgentOnLandmark { landmark, sign: Sign::Positive, .. } => self.hinder_going(landmark),
            Goal::ObjectOnLandmark { object, landmark, sign: Sign::Positive } => {
                self.hinder_putting(object, landmark)
            }
            _ => goal.negated().into(),
        }
    }

    /// Keeps the other off a landmark.
    fn hinder_going(&self, landmark: LandmarkId) -> Aim {
        let goal = landmark.room();
        let there = self.other_room();
        let negated = Aim::AgentToLandmark(self.other, landmark, Sign::Negative);
        if self.rooms().is_open() {
            return negated;
        }
        if there == goal {
            if let Some(object) = self.state.held_object(self.me) {
                return Aim::Grab(self.me, object, Sign::Negative);
            }
            return self.towards(goal).unwrap_or(negated);
        }
        let radius = self.rules.physics.agents[self.other].radius;
        if self.rooms().blocked(there, goal, radius) {
            return Aim::Stop;
        }
        let way = self.rooms().way(there, goal).unwrap_or_default();
        if let Some(room) = self.room_to_plug(&way) {
            return self.put(ObjectId::ZERO, room.landmark());
        }
        if let Some(object) = self.state.held_object(self.me) {
            return Aim::Grab(self.me, object, Sign::Negative);
        }
        self.stand_on(&way).unwrap_or(negated)
    }

    /// The room beside a door on the other's way that is too narrow for the first object, the nearer of the
    /// two: the object there closes the door. `None` if there is no such door, or that way is not shorter
    /// than the other's.
    fn room_to_plug(&self, way: &[RoomId]) -> Option<RoomId> {
        if self.rules.physics.object_count == 0 {
            return None;
        }
        let object = ObjectId::ZERO;
        let diameter = 2.0 * self.rules.physics.object_radii[object];
        let here = self.room(Entity::Object(object));
        let length = |to: RoomId| self.rooms().way(here, to).map(|way| way.len());
        way.windows(2)
            .filter(|pair| self.rooms().door(pair[0], pair[1]).is_some_and(|door| door.length() < diameter))
            .flat_map(|pair| [pair[0], pair[1]])
            .filter_map(|room| Some((length(room)?, room)))
            .filter(|&(length, _)| length < way.len())
            .min_by_key(|&(length, _)| length)
            .map(|(_, room)| room)
    }

    /// Goes to the nearest room on the other's way with a wall beside its door. The room that it is in is not
    /// among them, so that it goes to and fro where there is no other.
    fn stand_on(&self, way: &[RoomId]) -> Option<Aim> {
        let here = self.my_room();
        let walled = way.windows(2).filter(|pair| self.rooms().walled(pair[0], pair[1]));
        let nearest = walled
            .flatten()
            .filter(|&&room| room != here)
            .filter_map(|&room| Some((self.rooms().way(here, room)?.len(), room)))
            .min_by_key(|&(length, _)| length);
        self.towards(nearest?.1)
    }

    /// Keeps an object off a landmark.
    fn hinder_putting(&self, object: ObjectId, landmark: LandmarkId) -> Aim {
        let negated = Aim::ObjectToLandmark(object, landmark, Sign::Negative);
        if self.rooms().is_open() {
            return negated;
        }
        let entity = Entity::Object(object);
        let goal = landmark.room();
        let there = self.room(entity);
        let reaches = |agent: AgentId, to| !self.blocked(agent, self.room(Entity::Agent(agent)), to);
        if !reaches(self.me, there) {
            let way = self.rooms().way(self.other_room(), goal).unwrap_or_default();
            return self.stand_on(&way).unwrap_or(Aim::Stop);
        }
        let holding = self.state.holds(self.me, object);
        if self.state.holds(self.other, object) && !holding {
            if self.blocked(self.other, there, goal) {
                return self.release_or_stop();
            }
            return if self.attachable(object) {
                Aim::Grab(self.me, object, Sign::Positive)
            } else {
                self.go_to(entity)
            };
        }
        if !reaches(self.other, there) && !holding {
            return Aim::Stop;
        }
        if !holding {
            return if self.attachable(object) {
                Aim::Grab(self.me, object, Sign::Positive)
            } else {
                self.go_to(entity)
            };
        }
        self.drag_away(object).unwrap_or(Aim::AgentToLandmark(self.other, landmark, Sign::Negative))
    }

    /// Drags an object to the room where it is farthest from the other and still nearer to the agent: a room
    /// that the other cannot enter with it, if there is one. `None` if there is no such room.
    fn drag_away(&self, object: ObjectId) -> Option<Aim> {
        let there = self.room(Entity::Object(object));
        let length = |from, to| self.rooms().way(from, to).map_or(usize::MAX, |way| way.len());
        let open = |room: &RoomId| !self.blocked(self.me, there, *room);
        let hidden = |room: &RoomId| self.blocked(self.other, self.other_room(), *room);
        let hide = RoomId::ALL.into_iter().find(|room| open(room) && hidden(room));
        let farthest = || {
            let rooms = RoomId::ALL.into_iter().filter(open);
            rooms
                .filter(|&room| length(there, room) < length(self.other_room(), room))
                .max_by_key(|&room| length(self.other_room(), room))
        };
        let room = hide.or_else(farthest)?;
        Some(Aim::ObjectToRoom(object, self.rooms().next(there, room)))
    }
}

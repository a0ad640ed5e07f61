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

    /// The room beside the first door on the other's way that is too narrow for the first object, where the
    /// object closes the door: across the door if it lies beside it, else the nearer one. `None` if there is
    /// no such door, or the agent's way there is not shorter than the other's.
    fn room_to_plug(&self, way: &[RoomId]) -> Option<RoomId> {
        if self.rules.physics.object_count == 0 {
            return None;
        }
        let object = ObjectId::ZERO;
        let diameter = 2.0 * self.rules.physics.object_radii[object];
        let here = self.room(Entity::Object(object));
        let door = way.windows(2).find(|pair| {
            self.rooms().door(pair[0], pair[1]).is_some_and(|door| door.length() < diameter)
        })?;
        let (before, after) = (door[0], door[1]);
        if here == before {
            return Some(after);
        }
        if here == after {
            return Some(before);
        }
        let fetch = if self.state.holds(self.me, object) { 0 } else { self.steps(self.my_room(), here)? };
        let room = [after, before].into_iter().min_by_key(|&room| self.steps(here, room))?;
        (fetch + self.steps(here, room)? < way.len() - 1).then_some(room)
    }

    /// The number of doors on the way from one room to another; `None` where there is no way.
    fn steps(&self, from: RoomId, to: RoomId) -> Option<usize> {
        self.rooms().way(from, to).map(|way| way.len() - 1)
    }

    /// Goes to the nearest room on the other's way whose exit has a wall beside it, or to its last room.
    fn stand_on(&self, way: &[RoomId]) -> Option<Aim> {
        let here = self.my_room();
        let nearest = way
            .iter()
            .enumerate()
            .filter(|&(k, &room)| way.get(k + 1).is_none_or(|&next| self.rooms().walled(room, next)))
            .filter_map(|(_, &room)| Some((self.steps(here, room)?, room)))
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
        let (there, goal, here, others) = (self.room(entity), landmark.room(), self.my_room(), self.other_room());
        let radius = |agent: AgentId| self.rules.physics.agents[agent].radius;
        let other_blocked = |from, to| self.rooms().blocked(from, to, radius(self.other));
        if self.rooms().blocked(here, there, radius(self.me)) {
            let helpless = self.state.grips[self.other].is_some() || others == there;
            return if helpless { Aim::Stop } else { Aim::AgentToRoom(self.other, there, Sign::Negative) };
        }
        let holding = self.state.held_object(self.me).is_some();
        if self.state.grips[self.other].is_some() {
            return if other_blocked(others, goal) || other_blocked(there, goal) {
                self.release_or_stop()
            } else if holding {
                self.push_away(object, landmark)
            } else {
                self.put(object, there.landmark())
            };
        }
        if other_blocked(others, there) {
            return Aim::Stop;
        }
        let hidden = RoomId::ALL.into_iter().find(|&room| {
            room != others
                && room != there
                && other_blocked(others, room)
                && !self.rooms().blocked(there, room, self.rules.physics.object_radii[object])
                && !self.rooms().blocked(here, room, radius(self.me))
        });
        if let Some(room) = hidden {
            return self.put_in_room(object, room);
        }
        let way = self.rooms().way(others, there).unwrap_or_default();
        if way.len() > 2 && way[..way.len() - 1].contains(&here) {
            return Aim::AgentToRoom(self.other, there, Sign::Negative);
        }
        if !holding {
            return Aim::Grab(self.me, object, Sign::Positive);
        }
        self.push_away(object, landmark)
    }

    /// Drags an object to the room where it is farthest from the other and still nearer to the object.
    fn push_away(&self, object: ObjectId, landmark: LandmarkId) -> Aim {
        let place = |entity| self.state.position(entity);
        let (there, others) = (self.room(Entity::Object(object)), self.other_room());
        let from_other = |room| self.rooms().room_distance(place(Entity::Agent(self.other)), room);
        let from_object = |room| self.rooms().room_distance(place(Entity::Object(object)), room);
        let farthest = RoomId::ALL
            .into_iter()
            .filter(|&room| room != others && room != there && from_object(room) < from_other(room))
            .max_by(|&a, &b| from_other(a).total_cmp(&from_other(b)));
        let _ = landmark;
        match farthest {
            Some(room) => Aim::ObjectToRoom(object, self.rooms().next(there, room)),
            None => Aim::AgentToLandmark(self.other, others.landmark(), Sign::Negative),
        }
    }

    /// Puts an object in a room.
    fn put_in_room(&self, object: ObjectId, room: RoomId) -> Aim {
        let holding = self.state.held_object(self.me).is_some();
        if holding {
            let there = self.room(Entity::Object(object));
            return if there == room { Aim::Grab(self.me, object, Sign::Negative) } else { Aim::ObjectToRoom(object, self.rooms().next(there, room)) };
        }
        self.put(object, room.landmark())
    }
}

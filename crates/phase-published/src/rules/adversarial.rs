//! The adversarial rules: against the other's goal.

use super::View;
use crate::{aim::Aim, recorded::SMALL_PLUG_BASE};
use phase_model::{AgentId, Entity, Goal, LandmarkId, ObjectId, RoomId, Sign, Size};

impl View<'_> {
    /// Hinders the other in its goal.
    pub(super) fn adversarial(&self, goal: Goal) -> Aim {
        match goal {
            Goal::AgentOnLandmark { landmark, sign: Sign::Positive, .. } => self.hinder_going(landmark),
            Goal::ObjectOnLandmark { object, landmark, sign: Sign::Positive } => {
                self.hinder_putting(object, landmark)
            }
            // Whomever the other wants to touch, the original takes it for the first object.
            Goal::Touch { sign: Sign::Positive, .. } if self.rules.physics.object_count > 0 => {
                self.hinder_touching(ObjectId::ZERO)
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
        if self.other_cannot(there, goal) {
            return Aim::Stop;
        }
        let way = self.rooms().way(there, goal).unwrap_or_default();
        if let Some(room) = self.room_to_plug(way) {
            return self.put(ObjectId::ZERO, room.landmark());
        }
        if let Some(object) = self.state.held_object(self.me) {
            return Aim::Grab(self.me, object, Sign::Negative);
        }
        self.stand_on(way).unwrap_or(negated)
    }

    /// The room beside a door on the other's way that is too narrow for the first object, where the object
    /// closes the door: across the first such door that it lies beside, or the nearer one if the agent gets
    /// it there before the other comes. `None` if there is no such door.
    fn room_to_plug(&self, way: &[RoomId]) -> Option<RoomId> {
        if self.rules.physics.object_count == 0 {
            return None;
        }
        let object = ObjectId::ZERO;
        let diameter = 2.0 * self.rules.physics.object_radii[object];
        let here = self.room(Entity::Object(object));
        let fetch =
            if self.state.holds(self.me, object) { Some(0) } else { self.steps(self.my_room(), here) };
        way.windows(2).enumerate().find_map(|(others_steps, pair)| {
            let before = pair[0];
            let after = pair[1];
            if self.rooms().door(before, after)?.length() >= diameter {
                return None;
            }
            if here == before {
                return Some(after);
            }
            if here == after {
                return Some(before);
            }
            let room = [after, before].into_iter().min_by_key(|&room| self.steps(here, room))?;
            (fetch? + self.steps(here, room)? < others_steps).then_some(room)
        })
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
            .filter(|&(_, &room)| room != here)
            .filter(|&(k, &room)| way.get(k + 1).is_none_or(|&next| self.rooms().walled(room, next)))
            .filter_map(|(_, &room)| Some((self.steps(here, room)?, room)))
            .min_by_key(|&(length, _)| length);
        self.towards(nearest?.1)
    }

    /// Keeps an object off a landmark.
    fn hinder_putting(&self, object: ObjectId, landmark: LandmarkId) -> Aim {
        if self.rooms().is_open() {
            return Aim::ObjectToLandmark(object, landmark, Sign::Negative);
        }
        let there = self.object_room(object);
        let others = self.other_room();
        let radii = [self.radius(self.other), self.rules.physics.object_radii[object]];
        if self.rules.layout.base() == SMALL_PLUG_BASE && radii.iter().all(|&it| it == Size::Small.radius()) {
            return if self.other_cannot(others, there) {
                Aim::Stop
            } else {
                self.put_in_room(object, self.rules.room(RoomId::TOP_LEFT))
            };
        }
        let goal = landmark.room();
        if let Some(aim) = self.out_of_reach(object) {
            return aim;
        }
        let holding = self.state.held_object(self.me).is_some();
        let last = Aim::AgentToLandmark(self.other, others.landmark(), Sign::Negative);
        if self.state.grips[self.other].is_some() {
            return if self.other_cannot(others, goal) || self.other_cannot(there, goal) {
                self.release_or_stop()
            } else if holding {
                self.drag_away(object).unwrap_or(last)
            } else {
                self.put(object, there.landmark())
            };
        }
        if self.other_cannot(others, there) {
            return Aim::Stop;
        }
        if let Some(aim) = self.keep_apart(object) {
            return aim;
        }
        if holding {
            self.drag_away(object).unwrap_or(last)
        } else {
            Aim::Grab(self.me, object, Sign::Positive)
        }
    }

    /// Keeps an object away from the other.
    fn hinder_touching(&self, object: ObjectId) -> Aim {
        let away = Aim::Touch(self.other, Entity::Object(object), Sign::Negative);
        let stay = || self.put(object, self.object_room(object).landmark());
        let holding = self.state.held_object(self.me).is_some();
        if self.rooms().is_open() {
            return if holding { away } else { stay() };
        }
        if let Some(aim) = self.out_of_reach(object) {
            return aim;
        }
        if self.other_cannot(self.other_room(), self.object_room(object)) {
            return self.release_or_stop();
        }
        if self.is_taken(object) {
            return if holding { away } else { stay() };
        }
        if let Some(aim) = self.keep_apart(object) {
            return aim;
        }
        if holding { self.drag_away(object).unwrap_or(away) } else { stay() }
    }

    /// Whether the other holds something or is in the room of an object.
    fn is_taken(&self, object: ObjectId) -> bool {
        self.state.grips[self.other].is_some() || self.other_room() == self.object_room(object)
    }

    /// The subgoal for an object that the agent cannot reach; `None` if it can.
    fn out_of_reach(&self, object: ObjectId) -> Option<Aim> {
        let there = self.object_room(object);
        if !self.rooms().blocked(self.my_room(), there, self.radius(self.me)) {
            return None;
        }
        Some(if self.is_taken(object) {
            Aim::Stop
        } else {
            Aim::AgentToRoom(self.other, there, Sign::Negative)
        })
    }

    /// The subgoal where walls can keep an object from the other; `None` if they cannot.
    fn keep_apart(&self, object: ObjectId) -> Option<Aim> {
        let here = self.my_room();
        let there = self.object_room(object);
        let others = self.other_room();
        let hidden = RoomId::ALL.into_iter().find(|&room| {
            room != others
                && room != there
                && self.other_cannot(others, room)
                && !self.rooms().blocked(there, room, self.rules.physics.object_radii[object])
                && !self.rooms().blocked(here, room, self.radius(self.me))
        });
        if let Some(room) = hidden {
            return Some(self.put_in_room(object, room));
        }
        let way = self.rooms().way(others, there).unwrap_or_default();
        let is_between = way.len() > 2 && way[1..way.len() - 1].contains(&here);
        // Whatever the way, the original names the room with number 3.
        is_between.then(|| Aim::AgentToRoom(self.other, self.rules.room(RoomId::BOTTOM_LEFT), Sign::Negative))
    }

    /// Drags an object to the room farthest from it that is nearer to it than to the other. `None` if there
    /// is none.
    fn drag_away(&self, object: ObjectId) -> Option<Aim> {
        let there = self.object_room(object);
        let others = self.other_room();
        let far_from = |entity| move |room| self.rooms().room_distance(self.state.position(entity), room);
        let from_object = far_from(Entity::Object(object));
        let from_other = far_from(Entity::Agent(self.other));
        let room = RoomId::ALL
            .into_iter()
            .filter(|&room| room != others && room != there && from_object(room) < from_other(room))
            .max_by(|&a, &b| from_object(a).total_cmp(&from_object(b)))?;
        Some(Aim::ObjectToRoom(object, self.rooms().next(there, room)))
    }

    fn object_room(&self, object: ObjectId) -> RoomId {
        self.room(Entity::Object(object))
    }

    fn radius(&self, agent: AgentId) -> f32 {
        self.rules.physics.agents[agent].radius
    }

    /// Whether a door on the way is too narrow for the other.
    fn other_cannot(&self, from: RoomId, to: RoomId) -> bool {
        self.rooms().blocked(from, to, self.radius(self.other))
    }

    /// Puts an object in a room.
    fn put_in_room(&self, object: ObjectId, room: RoomId) -> Aim {
        let holding = self.state.held_object(self.me).is_some();
        let there = self.room(Entity::Object(object));
        if holding {
            return if there == room {
                Aim::Grab(self.me, object, Sign::Negative)
            } else {
                Aim::ObjectToRoom(object, self.rooms().next(there, room))
            };
        }
        if there == room { Aim::Stop } else { self.put(object, room.landmark()) }
    }
}

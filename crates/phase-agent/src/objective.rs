//! A subgoal as the low-level planner sees it: a distance to minimise and a waypoint.

use crate::course::{self, Course, Way};
use phase_model::{
    AgentId, Entity, Literal, ObjectId, Physique, Place, Predicate, RoomId, Segment, Side, State, Subgoal,
    Vec2, arena, layout::room_of,
};
use phase_planner::{
    Routes,
    aside::{self, Intrusion},
};
use phase_predicates::is_true;

/// Diagonal of the arena (u), the scale of distances in rewards.
pub const LONGEST: f32 = 28.284;
/// Penalty while the object of an Attach subgoal is not held (u), more than the gain of standing next to it.
const NOT_IN_HAND: f32 = 2.0;
/// Half of the heading penalty for facing away from the target (u).
const FACING: f32 = 0.5;
/// Heading penalty at the edge of the field of view, 55° off (u).
const IN_VIEW: f32 = 0.42 * FACING;
/// Clearance between bodies that pass each other (u).
const CLEARANCE: f32 = 0.4;
/// Distance from the guarded landmark beyond which the other agent's proximity is not penalised (u).
const KEPT_OFF: f32 = 6.0;
/// Maximum distance of a guard from its landmark (u).
const GREATEST_REACH: f32 = 4.0;
/// Penalty while the other agent is on the guarded landmark (u).
const TRESPASS: f32 = 8.0;

/// One agent's subgoal, in one scene.
#[derive(Clone, Copy, Debug)]
pub struct Objective<'a> {
    /// Bodies and walls.
    pub physique: &'a Physique,
    /// The ways between rooms.
    pub routes: &'a Routes,
    /// Who pursues it.
    pub agent: AgentId,
    /// What is pursued.
    pub subgoal: Subgoal,
    /// Back-off point to visit first if the agent has stalled (u).
    pub retreat: Option<Vec2>,
}

impl Objective<'_> {
    /// Distance of a state from the subgoal (u); 0 where it is achieved, finite for every finite state.
    #[must_use]
    pub fn distance(&self, state: &State) -> f32 {
        self.look(state).0
    }

    /// The distance of a state, and the steering if the distance was measured along it, so that it is computed
    /// once.
    #[must_use]
    pub fn look(&self, state: &State) -> (f32, Option<Course>) {
        if let Some(place) = self.retreat {
            let course = self.back_to(state, place);
            return (course.remaining, Some(course));
        }
        let mut course = None;
        let mut remaining = || course.insert(self.course(state)).remaining;
        let distance = match self.subgoal {
            Subgoal::Stay => 0.0,
            Subgoal::Achieve(Literal { predicate: Predicate::Attach(agent, object), holds }) => {
                let held = state.holds(agent, object);
                match (holds, held) {
                    (true, false) => remaining() + NOT_IN_HAND,
                    (true, true) => 0.0,
                    (false, _) => f32::from(u8::from(held)) + self.slide(state, object),
                }
            }
            Subgoal::Achieve(Literal { predicate: Predicate::Touch(..), holds: false })
            | Subgoal::Achieve(Literal { predicate: Predicate::Close(_, Place::Entity(_)), holds: false }) => {
                LONGEST - self.apart(state).min(LONGEST)
            }
            Subgoal::Achieve(literal) => {
                let distance = remaining() + self.averted(state, literal) + self.nearness(state, literal);
                if literal.holds || is_true(self.physique, state, literal) {
                    distance
                } else {
                    distance + TRESPASS
                }
            }
        };
        (distance, course)
    }

    /// Heading penalty (u) for not facing the entity to approach or keep off. It makes agents look where they go
    /// and turn to the believed position of an unobserved entity, which confirms or refutes it.
    fn averted(&self, state: &State, literal: Literal) -> f32 {
        let me = Entity::Agent(self.agent);
        let other = Entity::Agent(self.agent.other());
        let target = match (literal.predicate, literal.holds) {
            (Predicate::Close(who, Place::Entity(target)), true) if who == me => target,
            (Predicate::Touch(who, target @ Entity::Object(_)), true) if Entity::Agent(who) == me => target,
            (Predicate::On(who, _), false) if who == other => other,
            _ => return 0.0,
        };
        self.turned_away(state, state.position(target))
    }

    /// Heading penalty for not facing a point (u).
    fn turned_away(&self, state: &State, target: Vec2) -> f32 {
        let body = state.body(Entity::Agent(self.agent));
        let way = (target - body.position).normalize_or_zero();
        FACING * (1.0 - way.dot(body.forward()))
    }

    /// Proximity penalty (u) for the other agent's closeness to the guarded landmark, so that the guard pushes
    /// it back.
    fn nearness(&self, state: &State, literal: Literal) -> f32 {
        let other = Entity::Agent(self.agent.other());
        match (literal.predicate, literal.holds) {
            (Predicate::On(who, landmark), false) if who == other => {
                let centre = arena::LANDMARKS[landmark];
                (KEPT_OFF - state.position(other).distance(centre)).max(0.0)
            }
            _ => 0.0,
        }
    }

    /// The entity that the subgoal positions and the agent controls: itself or the object it holds.
    #[must_use]
    pub fn mover(&self, state: &State) -> Entity {
        match self.subgoal {
            Subgoal::Achieve(Literal {
                predicate:
                    Predicate::On(Entity::Object(object), _) | Predicate::Close(Entity::Object(object), _),
                ..
            }) if state.holds(self.agent, object) => Entity::Object(object),
            _ => Entity::Agent(self.agent),
        }
    }

    /// Steering of the moved entity, around bodies in the way.
    #[must_use]
    pub fn course(&self, state: &State) -> Course {
        let mut course = self.open_course(state);
        let mover = self.mover(state);
        let leads = self.load_leads(state, mover);
        if let Entity::Object(_) = mover {
            course.remaining = self.with_carrier(state, mover, leads, course.remaining);
        }
        let clearance = self.physique.radius(mover) + CLEARANCE;
        let discs = self
            .physique
            .entities()
            .filter(|&entity| {
                self.is_in_the_way(state, entity) || (leads && entity == Entity::Agent(self.agent))
            })
            .map(|entity| (state.position(entity), self.physique.radius(entity) + clearance));
        let from = state.position(mover);
        let bent = course::around(course, from, discs);
        // Inside a door, proceed before turning off.
        let heading_for = if self.grazes(from, bent.heading_for, self.physique.radius(mover)) {
            course.heading_for
        } else {
            bent.heading_for
        };
        Course { heading_for, ..bent }
    }

    /// Whether a round body that moves straight from a point to another meets a wall or the end of one.
    pub(crate) fn grazes(&self, from: Vec2, to: Vec2, radius: f32) -> bool {
        let way = Segment { a: from, b: to };
        self.physique
            .walls
            .iter()
            .any(|&wall| way.crosses(wall) || way.distance(wall.a).min(way.distance(wall.b)) < radius)
    }

    /// Whether an entity is an obstacle: neither the agent nor the subgoal's target, nor held by or with
    /// either.
    fn is_in_the_way(&self, state: &State, entity: Entity) -> bool {
        let me = Entity::Agent(self.agent);
        let about = match self.subgoal {
            Subgoal::Achieve(Literal { predicate, .. }) => match predicate {
                Predicate::On(subject, _) | Predicate::Close(subject, Place::Landmark(_)) => subject,
                Predicate::Close(_, Place::Entity(target)) | Predicate::Touch(_, target) => target,
                Predicate::Attach(_, object) => Entity::Object(object),
            },
            Subgoal::Stay => me,
        };
        let held_with = |object: ObjectId| match entity {
            Entity::Agent(who) => state.holds(who, object),
            Entity::Object(other) => other == object,
        };
        let mine = state.grips[self.agent].is_some_and(|grip| held_with(grip.object));
        entity != me && entity != about && !mine
    }

    /// Steering of the moved entity, ignoring other bodies except in doors.
    fn open_course(&self, state: &State) -> Course {
        let mover = self.mover(state);
        let from = state.position(mover);
        let here = Course { heading_for: from, remaining: 0.0 };
        let Subgoal::Achieve(Literal { predicate, holds }) = self.subgoal else { return here };
        match (predicate, holds) {
            (Predicate::On(entity, landmark), true) => {
                let centre = arena::LANDMARKS[landmark];
                if entity == mover {
                    let way = self.way_of(state, mover, centre);
                    self.along(state, &way, course::to_point)
                } else {
                    self.escort(state, entity, centre)
                }
            }
            (Predicate::Close(entity, Place::Landmark(landmark)), true) => {
                if entity != mover {
                    self.escort(state, entity, arena::LANDMARKS[landmark])
                } else if room_of(from) == landmark.room() {
                    here
                } else {
                    let way = self.way_of(state, mover, arena::LANDMARKS[landmark]);
                    self.along(state, &way, course::into_room)
                }
            }
            (Predicate::Attach(_, object), true) => self.within_reach_of(state, object),
            (Predicate::Close(_, Place::Entity(entity)) | Predicate::Touch(_, entity), true) => {
                self.up_to(state, entity)
            }
            (Predicate::Touch(_, other) | Predicate::Close(_, Place::Entity(other)), false) => {
                self.away_from(state, other)
            }
            (Predicate::Close(entity, Place::Landmark(landmark)), false) => {
                self.blocking(state, entity, landmark.room())
            }
            (Predicate::On(entity, landmark), false) if entity == Entity::Agent(self.agent) => {
                aside::intrusion(self.physique, self.routes, state, self.agent, landmark).map_or(
                    here,
                    |Intrusion { place, .. }| Course { heading_for: place, remaining: from.distance(place) },
                )
            }
            (Predicate::On(entity, landmark), false) => {
                let target = arena::LANDMARKS[landmark];
                let reach = self.physique.radius(entity) + self.physique.agents[self.agent].radius;
                let offset = state.position(entity) - target;
                // Half-way, so that a body that has been pushed back is pushed further.
                let most = (0.5 * offset.length()).min(GREATEST_REACH).max(reach);
                self.towards(state, from, target + offset.clamp_length_max(most))
            }
            (Predicate::Attach(..), false) => here,
        }
    }

    fn towards(&self, state: &State, from: Vec2, to: Vec2) -> Course {
        let way = self.way(state, from, to);
        self.along(state, &way, course::to_point)
    }

    /// Steering along a path, unless another body has priority.
    fn along(&self, state: &State, way: &Way<'_>, course: fn(&Way<'_>) -> Course) -> Course {
        let mut course = self.give_way(state, way).unwrap_or_else(|| course(way));
        if let Some(door) = way.barred().filter(|_| state.grips[self.agent].is_none()) {
            // An agent that cannot pass watches the door.
            course.remaining += self.turned_away(state, door);
        }
        course
    }

    /// Steering to a waiting point while the other agent occupies the door, unless both carry the same
    /// object or the other agent is the target.
    fn give_way(&self, state: &State, way: &Way<'_>) -> Option<Course> {
        let Subgoal::Achieve(Literal { predicate, holds: true }) = self.subgoal else { return None };
        let other = Entity::Agent(self.agent.other());
        let about_other = match predicate {
            Predicate::Touch(_, entity) | Predicate::Close(_, Place::Entity(entity)) => entity == other,
            _ => false,
        };
        let mine = state.held_object(self.agent);
        if about_other || (mine.is_some() && mine == state.held_object(self.agent.other())) {
            return None;
        }
        let mut course = course::give_way(way, state.position(other), self.agent == AgentId::ONE)?;
        // A waiting agent faces the other one, so that it observes when the door is free.
        course.remaining += (self.turned_away(state, state.position(other)) - IN_VIEW).max(0.0);
        Some(course)
    }

    /// Until the surfaces meet.
    fn up_to(&self, state: &State, entity: Entity) -> Course {
        let from = state.position(Entity::Agent(self.agent));
        let mut course = self.towards(state, from, state.position(entity));
        let reach = self.physique.radius(entity) + self.physique.agents[self.agent].radius;
        course.remaining = (course.remaining - reach).max(0.0);
        course
    }

    /// Until an object is within reach of the nearest of the four sides.
    fn within_reach_of(&self, state: &State, object: ObjectId) -> Course {
        let entity = Entity::Object(object);
        let body = state.body(Entity::Agent(self.agent));
        let mut course = self.up_to(state, entity);
        if room_of(body.position) == room_of(state.position(entity)) {
            let rotation = Vec2::from_angle(body.angle);
            let radius = self.physique.agents[self.agent].radius;
            let nearest = Side::ALL
                .iter()
                .map(|side| body.position + rotation.rotate(side.direction() * radius))
                .map(|point| point.distance(state.position(entity)))
                .fold(f32::INFINITY, f32::min);
            let reach = self.physique.radius(entity) + 0.5 * phase_model::physique::GRAB_REACH;
            course.remaining = (nearest - reach).max(0.0);
        }
        course
    }

    /// For an object that has to move but is not held: approach it, and add its own remaining distance.
    fn escort(&self, state: &State, entity: Entity, target: Vec2) -> Course {
        let mut course = self.up_to(state, entity);
        course.remaining += course::to_point(&Way::find(
            self.routes,
            state.position(entity),
            target,
            self.physique.radius(entity),
        ))
        .remaining;
        course
    }

    /// Path length from the other agent to this one (u).
    fn apart(&self, state: &State) -> f32 {
        let (me, other) = (Entity::Agent(self.agent), Entity::Agent(self.agent.other()));
        let width = self.physique.agents[self.agent.other()].width();
        self.routes.cost(state.position(other), state.position(me), width, self.routes.gaps())
    }

    fn away_from(&self, state: &State, other: Entity) -> Course {
        let from = state.position(Entity::Agent(self.agent));
        let direction = (from - state.position(other)).normalize_or(Vec2::Y);
        // Along the wall rather than into it.
        let heading_for = (from + direction * 4.0).clamp(arena::MIN + Vec2::ONE, arena::MAX - Vec2::ONE);
        Course { heading_for, remaining: LONGEST - self.apart(state).min(LONGEST) }
    }

    /// Into the door through which an entity would enter a room, in front of it.
    fn blocking(&self, state: &State, entity: Entity, room: RoomId) -> Course {
        let from = state.position(Entity::Agent(self.agent));
        let there = state.position(entity);
        let width = 2.0 * self.physique.radius(entity);
        let route = self.routes.best(there, arena::LANDMARKS[room.landmark()], width, self.routes.gaps());
        let crossing = route.and_then(|route| route.doors().last().map(|&(_, point)| point));
        self.towards(state, from, crossing.unwrap_or(there))
    }
}

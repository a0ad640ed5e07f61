//! A subgoal in the low-level planner: a distance to minimise and a waypoint.

use crate::steering::{self, PlannedPath, Steering};
use phase_model::{
    AgentId, Entity, Literal, ObjectId, PhysicsConfig, Predicate, PredicateTarget, RoomId, Segment, Side,
    State, Subgoal, Vec2, arena, layout::room_of,
};
use phase_planner::{
    Routes,
    yielding::{self, PathObstruction},
};
use phase_predicates::is_true;

/// Diagonal of the arena (u), the scale of distances in rewards.
pub const ARENA_DIAGONAL: f32 = 28.284;
/// Penalty while the object of an Attach subgoal is not held (u), more than the gain of standing next to it.
const UNGRASPED_PENALTY: f32 = 2.0;
/// Half of the heading penalty for facing away from the target (u).
const HEADING_PENALTY: f32 = 0.5;
/// Heading penalty at the edge of the field of view, 55° off (u).
const VIEW_EDGE_PENALTY: f32 = 0.42 * HEADING_PENALTY;
/// Clearance between bodies that pass each other (u).
const CLEARANCE: f32 = 0.4;
/// Distance from the guarded landmark beyond which the other agent's proximity is not penalised (u).
const PROXIMITY_RANGE: f32 = 6.0;
/// Maximum distance of a guard from its landmark (u).
const MAX_GUARD_DISTANCE: f32 = 4.0;
/// Penalty while the other agent is on the guarded landmark (u).
const INTRUSION_PENALTY: f32 = 8.0;

/// One agent's subgoal, in one scene.
#[derive(Clone, Copy, Debug)]
pub struct Objective<'a> {
    /// Bodies and walls.
    pub physics: &'a PhysicsConfig,
    /// The routes between rooms.
    pub routes: &'a Routes,
    /// The agent that pursues it.
    pub agent: AgentId,
    /// The subgoal pursued.
    pub subgoal: Subgoal,
    /// Back-off point to visit first if the agent has stalled (u).
    pub backoff: Option<Vec2>,
}

impl Objective<'_> {
    /// Distance of a state from the subgoal (u); 0 where it is achieved, finite for every finite state.
    #[must_use]
    pub fn distance(&self, state: &State) -> f32 {
        self.evaluate(state).0
    }

    /// The distance of a state, and the steering if the distance was measured along it, so that it is computed
    /// once.
    #[must_use]
    pub fn evaluate(&self, state: &State) -> (f32, Option<Steering>) {
        if let Some(place) = self.backoff {
            let steering = self.backoff_steering(state, place);
            return (steering.remaining, Some(steering));
        }
        let mut steering = None;
        let mut remaining = || steering.insert(self.steering(state)).remaining;
        let distance = match self.subgoal {
            Subgoal::Stay => 0.0,
            Subgoal::Achieve(Literal { predicate: Predicate::Attach(agent, object), holds }) => {
                let held = state.holds(agent, object);
                match (holds, held) {
                    (true, false) => remaining() + UNGRASPED_PENALTY,
                    (true, true) => 0.0,
                    (false, _) => f32::from(u8::from(held)) + self.sliding_distance(state, object),
                }
            }
            Subgoal::Achieve(Literal { predicate: Predicate::Touch(..), holds: false })
            | Subgoal::Achieve(Literal {
                predicate: Predicate::Close(_, PredicateTarget::Entity(_)),
                holds: false,
            }) => ARENA_DIAGONAL - self.separation(state).min(ARENA_DIAGONAL),
            Subgoal::Achieve(literal) => {
                let distance = remaining()
                    + self.heading_penalty(state, literal)
                    + self.proximity_penalty(state, literal);
                if literal.holds || is_true(self.physics, state, literal) {
                    distance
                } else {
                    distance + INTRUSION_PENALTY
                }
            }
        };
        (distance, steering)
    }

    /// Heading penalty (u) for not facing the entity to approach or keep off. It makes agents look where they go
    /// and turn to the believed position of an unobserved entity, which confirms or refutes it.
    fn heading_penalty(&self, state: &State, literal: Literal) -> f32 {
        let me = Entity::Agent(self.agent);
        let other = Entity::Agent(self.agent.other());
        let target = match (literal.predicate, literal.holds) {
            (Predicate::Close(who, PredicateTarget::Entity(target)), true) if who == me => target,
            (Predicate::Touch(who, target @ Entity::Object(_)), true) if Entity::Agent(who) == me => target,
            (Predicate::On(who, _), false) if who == other => other,
            _ => return 0.0,
        };
        self.heading_error_penalty(state, state.position(target))
    }

    /// Heading penalty for not facing a point (u).
    fn heading_error_penalty(&self, state: &State, target: Vec2) -> f32 {
        let body = state.body(Entity::Agent(self.agent));
        let way = (target - body.position).normalize_or_zero();
        HEADING_PENALTY * (1.0 - way.dot(body.forward()))
    }

    /// Proximity penalty (u) for the other agent's closeness to the guarded landmark, so that the guard pushes
    /// it back.
    fn proximity_penalty(&self, state: &State, literal: Literal) -> f32 {
        let other = Entity::Agent(self.agent.other());
        match (literal.predicate, literal.holds) {
            (Predicate::On(who, landmark), false) if who == other => {
                let centre = arena::LANDMARKS[landmark];
                (PROXIMITY_RANGE - state.position(other).distance(centre)).max(0.0)
            }
            _ => 0.0,
        }
    }

    /// The entity that the subgoal positions and the agent controls: itself or the object it holds.
    #[must_use]
    pub fn moved_entity(&self, state: &State) -> Entity {
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
    pub fn steering(&self, state: &State) -> Steering {
        let mut steering = self.unobstructed_steering(state);
        let moved_entity = self.moved_entity(state);
        let leads = self.load_goes_first(state, moved_entity);
        if let Entity::Object(_) = moved_entity {
            steering.remaining = self.with_carrier_terms(state, moved_entity, leads, steering.remaining);
        }
        let clearance = self.physics.radius(moved_entity) + CLEARANCE;
        let discs = self
            .physics
            .entities()
            .filter(|&entity| {
                self.is_in_the_way(state, entity) || (leads && entity == Entity::Agent(self.agent))
            })
            .map(|entity| (state.position(entity), self.physics.radius(entity) + clearance));
        let from = state.position(moved_entity);
        let bent = steering::avoid_discs(steering, from, discs);
        // Inside a door, proceed before turning off.
        let waypoint = if self.path_hits_wall(from, bent.waypoint, self.physics.radius(moved_entity)) {
            steering.waypoint
        } else {
            bent.waypoint
        };
        Steering { waypoint, ..bent }
    }

    /// Whether a round body that moves straight from a point to another meets a wall or the end of one.
    pub(crate) fn path_hits_wall(&self, from: Vec2, to: Vec2, radius: f32) -> bool {
        let way = Segment { a: from, b: to };
        self.physics
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
                Predicate::On(subject, _) | Predicate::Close(subject, PredicateTarget::Landmark(_)) => {
                    subject
                }
                Predicate::Close(_, PredicateTarget::Entity(target)) | Predicate::Touch(_, target) => target,
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
    fn unobstructed_steering(&self, state: &State) -> Steering {
        let moved_entity = self.moved_entity(state);
        let from = state.position(moved_entity);
        let here = Steering { waypoint: from, remaining: 0.0 };
        let Subgoal::Achieve(Literal { predicate, holds }) = self.subgoal else { return here };
        match (predicate, holds) {
            (Predicate::On(entity, landmark), true) => {
                let centre = arena::LANDMARKS[landmark];
                if entity == moved_entity {
                    let way = self.path_of(state, moved_entity, centre);
                    self.along(state, &way, steering::to_point)
                } else {
                    self.approach_then_carry(state, entity, centre)
                }
            }
            (Predicate::Close(entity, PredicateTarget::Landmark(landmark)), true) => {
                if entity != moved_entity {
                    self.approach_then_carry(state, entity, arena::LANDMARKS[landmark])
                } else if room_of(from) == landmark.room() {
                    here
                } else {
                    let way = self.path_of(state, moved_entity, arena::LANDMARKS[landmark]);
                    self.along(state, &way, steering::into_room)
                }
            }
            (Predicate::Attach(_, object), true) => self.within_reach_of(state, object),
            (Predicate::Close(_, PredicateTarget::Entity(entity)) | Predicate::Touch(_, entity), true) => {
                self.approach(state, entity)
            }
            (Predicate::Touch(_, other) | Predicate::Close(_, PredicateTarget::Entity(other)), false) => {
                self.away_from(state, other)
            }
            (Predicate::Close(entity, PredicateTarget::Landmark(landmark)), false) => {
                self.blocking(state, entity, landmark.room())
            }
            (Predicate::On(entity, landmark), false) if entity == Entity::Agent(self.agent) => {
                yielding::path_obstruction(self.physics, self.routes, state, self.agent, landmark).map_or(
                    here,
                    |PathObstruction { place, .. }| Steering {
                        waypoint: place,
                        remaining: from.distance(place),
                    },
                )
            }
            (Predicate::On(entity, landmark), false) => {
                let target = arena::LANDMARKS[landmark];
                let reach = self.physics.radius(entity) + self.physics.agents[self.agent].radius;
                let offset = state.position(entity) - target;
                // Half-way, so that a body that has been pushed back is pushed further.
                let most = (0.5 * offset.length()).min(MAX_GUARD_DISTANCE).max(reach);
                self.towards(state, from, target + offset.clamp_length_max(most))
            }
            (Predicate::Attach(..), false) => here,
        }
    }

    fn towards(&self, state: &State, from: Vec2, to: Vec2) -> Steering {
        let way = self.way(state, from, to);
        self.along(state, &way, steering::to_point)
    }

    /// Steering along a path, unless another body has priority.
    fn along(
        &self,
        state: &State,
        way: &PlannedPath<'_>,
        steering: fn(&PlannedPath<'_>) -> Steering,
    ) -> Steering {
        let mut steering = self.yield_to(state, way).unwrap_or_else(|| steering(way));
        if let Some(door) = way.impassable_crossing().filter(|_| state.grips[self.agent].is_none()) {
            // An agent that cannot pass watches the door.
            steering.remaining += self.heading_error_penalty(state, door);
        }
        steering
    }

    /// Steering to a waiting point while the other agent occupies the door, unless both carry the same
    /// object or the other agent is the target.
    fn yield_to(&self, state: &State, way: &PlannedPath<'_>) -> Option<Steering> {
        let Subgoal::Achieve(Literal { predicate, holds: true }) = self.subgoal else { return None };
        let other = Entity::Agent(self.agent.other());
        let about_other = match predicate {
            Predicate::Touch(_, entity) | Predicate::Close(_, PredicateTarget::Entity(entity)) => {
                entity == other
            }
            _ => false,
        };
        let mine = state.held_object(self.agent);
        if about_other || (mine.is_some() && mine == state.held_object(self.agent.other())) {
            return None;
        }
        let mut steering = steering::yield_to(way, state.position(other), self.agent == AgentId::ONE)?;
        // A waiting agent faces the other one, so that it observes when the door is free.
        steering.remaining +=
            (self.heading_error_penalty(state, state.position(other)) - VIEW_EDGE_PENALTY).max(0.0);
        Some(steering)
    }

    /// Until the surfaces meet.
    fn approach(&self, state: &State, entity: Entity) -> Steering {
        let from = state.position(Entity::Agent(self.agent));
        let mut steering = self.towards(state, from, state.position(entity));
        let reach = self.physics.radius(entity) + self.physics.agents[self.agent].radius;
        steering.remaining = (steering.remaining - reach).max(0.0);
        steering
    }

    /// Until an object is within reach of the nearest of the four sides.
    fn within_reach_of(&self, state: &State, object: ObjectId) -> Steering {
        let entity = Entity::Object(object);
        let body = state.body(Entity::Agent(self.agent));
        let mut steering = self.approach(state, entity);
        if room_of(body.position) == room_of(state.position(entity)) {
            let rotation = Vec2::from_angle(body.angle);
            let radius = self.physics.agents[self.agent].radius;
            let nearest = Side::ALL
                .iter()
                .map(|side| body.position + rotation.rotate(side.direction() * radius))
                .map(|point| point.distance(state.position(entity)))
                .fold(f32::INFINITY, f32::min);
            let reach = self.physics.radius(entity) + 0.5 * phase_model::physics::GRAB_REACH;
            steering.remaining = (nearest - reach).max(0.0);
        }
        steering
    }

    /// For an object that has to move but is not held: approach it, and add its own remaining distance.
    fn approach_then_carry(&self, state: &State, entity: Entity, target: Vec2) -> Steering {
        let mut steering = self.approach(state, entity);
        steering.remaining += steering::to_point(&PlannedPath::find(
            self.routes,
            state.position(entity),
            target,
            self.physics.radius(entity),
        ))
        .remaining;
        steering
    }

    /// Path length from the other agent to this one (u).
    fn separation(&self, state: &State) -> f32 {
        let (me, other) = (Entity::Agent(self.agent), Entity::Agent(self.agent.other()));
        let width = self.physics.agents[self.agent.other()].width();
        self.routes.cost(state.position(other), state.position(me), width, self.routes.gaps())
    }

    fn away_from(&self, state: &State, other: Entity) -> Steering {
        let from = state.position(Entity::Agent(self.agent));
        let direction = (from - state.position(other)).normalize_or(Vec2::Y);
        // Along the wall rather than into it.
        let waypoint = (from + direction * 4.0).clamp(arena::MIN + Vec2::ONE, arena::MAX - Vec2::ONE);
        Steering { waypoint, remaining: ARENA_DIAGONAL - self.separation(state).min(ARENA_DIAGONAL) }
    }

    /// Into the door through which an entity would enter a room, in front of it.
    fn blocking(&self, state: &State, entity: Entity, room: RoomId) -> Steering {
        let from = state.position(Entity::Agent(self.agent));
        let there = state.position(entity);
        let width = 2.0 * self.physics.radius(entity);
        let route = self.routes.best(there, arena::LANDMARKS[room.landmark()], width, self.routes.gaps());
        let crossing = route.and_then(|route| route.doors().last().map(|&(_, point)| point));
        self.towards(state, from, crossing.unwrap_or(there))
    }
}

//! Distance to go while grasping, carrying and releasing.

use super::{ARENA_DIAGONAL, Compiler, Objective, way::{LOOK_AHEAD, Way}};
use phase_model::{AgentId, Entity, ObjectId, PhysicsConfig, State, Vec2, physics};
use phase_navigation::{Field, Target};
use std::sync::Arc;

/// The way of a load and its carrier to a target.
#[derive(Clone, Debug)]
pub(crate) struct Carry {
    object: ObjectId,
    load: Arc<Field>,
    carrier: Arc<Field>,
}

impl Carry {
    /// Distance of the load, and by how much its carrier lags behind the length of its arm (u).
    pub(crate) fn distance(&self, physics: &PhysicsConfig, state: &State, agent: AgentId) -> f32 {
        let load = self.load_distance(state);
        let me = Entity::Agent(agent);
        let arm = physics.radius(me) + physics.radius(Entity::Object(self.object));
        let lag = self.carrier.distance(state.position(me)) - load - arm;
        load + 0.5 * lag.max(0.0)
    }

    /// Distance of the load alone (u).
    pub(crate) fn load_distance(&self, state: &State) -> f32 {
        self.load.distance(state.position(Entity::Object(self.object)))
    }

    /// The point that the load should head for (u).
    pub(crate) fn waypoint(&self, state: &State) -> Vec2 {
        self.load.waypoint(state.position(Entity::Object(self.object)), LOOK_AHEAD)
    }
}

impl Objective<'_> {
    /// Distance until an object is held (u).
    pub(crate) fn to_grasp(&self, state: &State, object: ObjectId, way: &Way) -> f32 {
        if state.holds(self.agent, object) {
            return 0.0;
        }
        let body = state.body(Entity::Agent(self.agent));
        let there = state.position(Entity::Object(object));
        let rotation = Vec2::from_angle(body.angle);
        let radius = self.physics.agents[self.agent].radius;
        // From the nearest of the four sides, by which it could be held.
        let nearest = phase_model::Side::ALL
            .iter()
            .map(|side| body.position + rotation.rotate(side.direction() * radius))
            .map(|point| point.distance(there))
            .fold(f32::INFINITY, f32::min);
        let reach = self.physics.object_radii[object] + 0.5 * physics::GRAB_REACH;
        let straight = body.position.distance(there);
        let detour = way.distance(body.position, there) - straight;
        (nearest - reach).max(0.0) + detour.max(0.0) + self.grasp
    }

    /// How far an object would slide if it were released now (u): it should stay where it is put.
    pub(crate) fn sliding_distance(&self, state: &State, object: ObjectId) -> f32 {
        let mass = physics::object_mass(self.physics.object_radii[object]);
        let speed = state.body(Entity::Object(object)).velocity.length();
        (0.5 * mass * speed * speed / physics::GROUND_FRICTION).min(ARENA_DIAGONAL)
    }
}

impl Compiler<'_, '_> {
    /// Carrying an object to a target.
    pub(crate) fn carry(&mut self, object: ObjectId, target: Target) -> Carry {
        let entity = Entity::Object(object);
        let obstacles = self.obstacles(Some(entity));
        let (load, own) = (self.mover(entity), self.mover(Entity::Agent(self.agent)));
        Carry {
            object,
            load: self.navigator.field(target, load, &obstacles),
            carrier: self.navigator.field(target, own, &[]),
        }
    }
}

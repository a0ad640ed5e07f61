//! Distance to go while grasping, carrying and releasing.

use super::{Compiler, Motion, Objective, way::Way};
use phase_model::{Entity, ObjectId, State, Vec2, arena, physics};
use phase_navigation::{Assembly, AssemblyField, Field, Target};
use phase_predicates::threshold::ON_OBJECT;
use std::sync::Arc;

/// The way of a load to a target.
#[derive(Clone, Debug)]
pub(crate) struct Carry {
    object: ObjectId,
    load: Arc<Field>,
    /// Of the load with all its holders, if the agent is one of them.
    assembly: Option<Arc<AssemblyField>>,
}

impl Carry {
    /// Distance of the load with its holders (u): which way, whether it has to turn first, whether it fits.
    pub(crate) fn distance(&self, state: &State) -> f32 {
        let body = state.body(Entity::Object(self.object));
        match &self.assembly {
            Some(assembly) => assembly.distance(body.position, body.angle),
            None => self.load.distance(body.position),
        }
    }

    /// Distance of the load alone (u).
    pub(crate) fn load_distance(&self, state: &State) -> f32 {
        self.load.distance(state.position(Entity::Object(self.object)))
    }

    /// The load's next motion, towards a point so far ahead on the way (u).
    pub(crate) fn motion(&self, state: &State, look_ahead: f32) -> Motion {
        let entity = Entity::Object(self.object);
        let body = state.body(entity);
        let Some(assembly) = &self.assembly else {
            return Motion::to(entity, self.load.waypoint(body.position, look_ahead));
        };
        let descent = assembly.descent(body.position, body.angle);
        Motion { entity, waypoint: body.position + descent.direction * look_ahead, turn: descent.turn }
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
        let reach = self.physics.object_radii[object] + self.parameters.grasp_reach * physics::GRAB_REACH;
        let here = self.place(state, Entity::Agent(self.agent));
        let detour = way.distance(here, there) - here.distance(there);
        // What is grasped has to be released later.
        (nearest - reach).max(0.0) + detour.max(0.0) + 2.0 * self.parameters.grasp
    }

    /// Distance (u) that an object would slide if it were released now: it should stay where it is put.
    pub(crate) fn sliding_distance(&self, state: &State, object: ObjectId) -> f32 {
        let mass = physics::object_mass(self.physics.object_radii[object]);
        let speed = state.body(Entity::Object(object)).velocity.length();
        (0.5 * mass * speed * speed / physics::GROUND_FRICTION).min(arena::DIAGONAL)
    }
}

impl Compiler<'_, '_> {
    /// Carrying an object to a target.
    pub(crate) fn carry(&mut self, object: ObjectId, target: Target) -> Carry {
        let entity = Entity::Object(object);
        let obstacles = self.obstacles(Some(entity));
        let load = self.navigator.field(target, self.mover(entity), &obstacles);
        let assembly = self.state.holds(self.agent, object).then(|| {
            let assembly = Assembly::of(self.physics, &self.state.grips, object);
            self.navigator.assembly_field(target, ON_OBJECT, &assembly, self.parameters.carrying())
        });
        Carry { object, load, assembly }
    }
}

//! The dynamics as the published planner imagines them.

use crate::{Forward, finish::stop_turning, model::Model, reach, solver_cache::SolverCache, world::World};
use phase_model::{
    AGENT_COUNT, Action, Dynamics, Entity, MAX_OBJECTS, PhysicsConfig, State, Strength, Vec2, arena::SUBSTEPS,
};

/// The dynamics as the published planner imagines them.
///
/// Pushes act at the agent's origin. An object that is held at the start of a step hangs on a spring of
/// 100 Hz between the two origins, free to pivot, which keeps their distance; what is grabbed in the step
/// itself is welded. Objects lose their spin and their angle with every step. Steps begin without impulses,
/// as in a world that has just been made.
#[derive(Clone, Debug)]
pub struct Imagined {
    forward: Forward,
    stops: [bool; AGENT_COUNT],
}

impl Imagined {
    /// Prepares the dynamics of a scene.
    #[must_use]
    pub fn new(physics: &PhysicsConfig) -> Self {
        let mut model = Model::new(physics);
        model.imagined = true;
        for shape in &mut model.shapes[..AGENT_COUNT] {
            shape.push_point = shape.origin;
        }
        Self { forward: Forward { model }, stops: [true; AGENT_COUNT] }
    }

    /// These dynamics without collisions between bodies ([`Forward::without_collisions`]).
    #[must_use]
    pub fn without_collisions(self) -> Self {
        Self { forward: self.forward.without_collisions(), ..self }
    }

    /// These dynamics with agents of the greatest strength that coast when they mean to stop, as in the
    /// published recordings.
    #[must_use]
    pub fn with_coasting_strongest(mut self) -> Self {
        let physics = &self.forward.model.physics;
        let strongest = Strength::Mighty.max_force();
        self.stops = physics.agents.map(|agent| agent.max_force < strongest);
        self
    }

    /// One step in which agents grab what would be within reach if the objects were at these places (u). The
    /// object grabbed is pulled from where it is.
    pub fn step_reaching(
        &self,
        state: &mut State,
        actions: [Action; AGENT_COUNT],
        objects_at: [Vec2; MAX_OBJECTS],
    ) {
        let model = &self.forward.model;
        let actions = [0, 1].map(|agent: usize| match actions[agent] {
            Action::Stop if !self.stops[agent] => Action::NoForce,
            action => action,
        });
        for object in model.physics.objects() {
            let body = state.body_mut(Entity::Object(object));
            (body.angle, body.angular_velocity) = (0.0, 0.0);
        }
        let mut world = World::new(model, state, actions);
        if actions.contains(&Action::Attach) {
            let mut reached = *state;
            for (object, at) in model.physics.objects().zip(objects_at) {
                reached.body_mut(Entity::Object(object)).position = at;
            }
            world.grab(&reached);
        } else {
            world.grab(state);
        }
        let reachable_bodies = reach::reachable_bodies(&mut world);
        if reachable_bodies == 0 {
            for body in 0..model.count {
                self.forward.drift(&mut world, body, SUBSTEPS);
            }
            world.finish(state, 0);
        } else {
            let latest_grip = world.latest_grip;
            let mut cache = SolverCache::new(&world);
            let mut touching = cache.enter(&mut world);
            world.latest_grip = latest_grip;
            for _ in 0..SUBSTEPS {
                self.forward.substep_warm(&mut world, &mut cache, &mut touching);
            }
            world.finish(state, cache.active_pairs());
        }
        stop_turning(state);
    }
}

impl Dynamics for Imagined {
    /// [`Imagined::step_reaching`] for objects where they are.
    fn step(&self, state: &mut State, actions: [Action; AGENT_COUNT]) {
        let at = [2, 3].map(|body: usize| state.bodies[body].position);
        self.step_reaching(state, actions, at);
    }
}

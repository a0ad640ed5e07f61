//! The world: a scene's bodies in the engine, stepped by actions.

use crate::{
    bodies, contact, contact::ContactRules, dynamic_body::DynamicBody, grip::Weld, impact, impact::Impacts,
    settings, substep,
};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Entity, Grip, MAX_OBJECTS, PhysicsConfig, Segment, State, arena::SUBSTEPS,
};
use rapier2d::prelude::*;

/// A simulated scene and its bodies.
pub struct World {
    physics: PhysicsConfig,
    engine: PhysicsWorld,
    walls: Vec<Segment>,
    dynamic_bodies: Vec<DynamicBody>,
    welds: [Option<Weld>; AGENT_COUNT],
    rules: ContactRules,
}

/// A copy continues bit for bit as the original does. That cannot be said of a world rebuilt from
/// [`World::state`], which lacks what the engine remembers of contacts, and which pairs were released.
impl Clone for World {
    fn clone(&self) -> Self {
        let engine = &self.engine;
        // What is left at its default is scratch memory of a step.
        let engine = PhysicsWorld {
            gravity: engine.gravity,
            integration_parameters: engine.integration_parameters,
            islands: engine.islands.clone(),
            broad_phase: engine.broad_phase.clone(),
            narrow_phase: engine.narrow_phase.clone(),
            bodies: engine.bodies.clone(),
            colliders: engine.colliders.clone(),
            impulse_joints: engine.impulse_joints.clone(),
            multibody_joints: engine.multibody_joints.clone(),
            ..PhysicsWorld::default()
        };
        Self {
            physics: self.physics.clone(),
            engine,
            walls: self.walls.clone(),
            dynamic_bodies: self.dynamic_bodies.clone(),
            welds: self.welds,
            rules: self.rules,
        }
    }
}

impl World {
    /// A world in the given state. Any start is accepted: overlapping bodies are pushed apart over the first
    /// substeps and hardly gain speed by it, grips become rigid welds that pull their object into place, and
    /// numbers that are not finite or lie outside the arena are replaced by the closest valid ones. A body
    /// that starts across an inner wall may come out on either side of it.
    #[must_use]
    pub fn new(physics: &PhysicsConfig, state: &State) -> Self {
        let mut physics = physics.clone();
        physics.object_count = physics.object_count.min(MAX_OBJECTS);
        let mut engine = settings::engine();
        let ground = bodies::insert_ground(&mut engine, &physics.walls);
        let dynamic_bodies = physics
            .entities()
            .map(|entity| DynamicBody::insert(&mut engine, ground, &physics, entity, state.body(entity)))
            .collect();
        let rules = ContactRules::default();
        let mut world = Self {
            walls: impact::walls(&physics),
            physics,
            engine,
            dynamic_bodies,
            welds: [None; AGENT_COUNT],
            rules,
        };
        for (agent, grip) in AgentId::ALL.into_iter().zip(state.grips) {
            if let Some(grip) = grip {
                world.weld(agent, grip);
            }
        }
        world
    }

    /// This world with another number of sweeps over all constraints in a substep, for measurements of what
    /// the usual number costs in accuracy. Everything else uses the usual number.
    #[must_use]
    pub fn with_solver_passes(mut self, passes: usize) -> Self {
        settings::set_passes(&mut self.engine.integration_parameters, passes);
        self
    }

    /// The present state, with grips and with the contacts between bodies that the engine finds. A body and
    /// its holder have no contact entry; their grip implies that they touch.
    #[must_use]
    pub fn state(&self) -> State {
        let mut state = State::new(Default::default());
        state.grips = self.welds.map(|weld| weld.map(|weld| weld.grip));
        for (index, dynamic_body) in self.dynamic_bodies.iter().enumerate() {
            state.bodies[index] = dynamic_body.state(&self.engine);
            for (other, earlier) in self.dynamic_bodies.iter().enumerate().take(index) {
                let a = Entity::ALL[index];
                let b = Entity::ALL[other];
                if !state.touching(a, b) && contact::touching(&self.engine, dynamic_body, earlier) {
                    state.contacts.insert(a, b);
                }
            }
        }
        state
    }

    /// Advances by one substep of 1/60 s without actions, and returns the state after it. The published
    /// simulator does so once before the first step.
    pub fn settle(&mut self) -> State {
        self.substep([Action::NoForce; AGENT_COUNT]);
        self.state()
    }

    /// Advances by one step under both agents' actions: five substeps of 1/60 s. Returns the state after
    /// each.
    ///
    /// Attaching and detaching happen once, before the first substep; pushes and torques act in every
    /// substep, and `stop` sets the velocity to zero in every substep; the agents' angular velocities are
    /// zero after the last.
    pub fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        for (agent, action) in AgentId::ALL.into_iter().zip(actions) {
            match action {
                Action::Attach => self.attach(agent),
                Action::Detach => self.detach(agent),
                _ => {}
            }
        }
        core::array::from_fn(|substep| {
            self.substep(actions);
            if substep + 1 == SUBSTEPS {
                for dynamic_body in self.dynamic_bodies.iter().take(AGENT_COUNT) {
                    dynamic_body.stop_turning(&mut self.engine);
                }
            }
            self.state()
        })
    }

    /// Sets both agents' velocities to zero; objects keep theirs.
    pub fn stop_agents(&mut self) {
        for dynamic_body in self.dynamic_bodies.iter().take(AGENT_COUNT) {
            dynamic_body.stop(&mut self.engine);
        }
    }

    fn attach(&mut self, agent: AgentId) {
        let state = self.state();
        if let Some((object, side)) = state.attachable(&self.physics, agent) {
            let angle = |entity| state.body(entity).angle;
            let relative_angle = angle(Entity::Object(object)) - angle(Entity::Agent(agent));
            self.weld(agent, Grip { object, side, relative_angle });
        }
    }

    fn detach(&mut self, agent: AgentId) {
        if let Some(weld) = self.welds[agent].take() {
            let [holder, held] = [Entity::Agent(agent), Entity::Object(weld.grip.object)]
                .map(|entity| &self.dynamic_bodies[entity.index()]);
            self.rules.release(&self.engine, holder, held);
            weld.remove(&mut self.engine);
        }
    }

    /// Applies a grip; a grip on an object that does not exist, or at an invalid angle, is dropped.
    fn weld(&mut self, agent: AgentId, grip: Grip) {
        let object = grip.object;
        if object.index() < self.physics.object_count && grip.relative_angle.is_finite() {
            let length = self.physics.agents[agent].radius + self.physics.object_radii[object];
            let ends = [Entity::Agent(agent), Entity::Object(object)]
                .map(|entity| self.dynamic_bodies[entity.index()].body);
            self.welds[agent] = Some(Weld::insert(&mut self.engine, ends, grip, length));
        }
    }

    fn substep(&mut self, actions: [Action; AGENT_COUNT]) {
        for ((dynamic_body, body), action) in
            self.dynamic_bodies.iter().zip(&self.physics.agents).zip(actions)
        {
            dynamic_body.act(&mut self.engine, body, action);
        }
        let impacts = Impacts::new(&self.physics, &self.walls);
        substep::advance(&mut self.engine, impacts, &mut self.dynamic_bodies, &self.rules);
        self.rules.restore_clear(&self.engine, &self.dynamic_bodies);
    }
}

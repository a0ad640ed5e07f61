//! The world: a scene's bodies in the engine, stepped by actions.

use crate::{
    bodies, contact, contact::ContactRules, grip::Weld, impact, impact::Impacts, mover::Mover, settings,
    substep,
};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Entity, Grip, MAX_OBJECTS, Physique, Segment, State, arena::SUBSTEPS,
};
use rapier2d::prelude::*;

/// A scene's bodies in motion.
pub struct World {
    physique: Physique,
    engine: PhysicsWorld,
    walls: Vec<Segment>,
    movers: Vec<Mover>,
    welds: [Option<Weld>; AGENT_COUNT],
    rules: ContactRules,
}

impl World {
    /// A world in the given state. Any start will do: bodies that overlap are pushed apart over the first
    /// substeps and hardly gain speed by it, grips become rigid welds that pull their object into place, and numbers
    /// that are not finite or lie outside the arena are replaced by the nearest that make sense. A body that
    /// starts across an inner wall may come out on either side of it.
    #[must_use]
    pub fn new(physique: &Physique, state: &State) -> Self {
        let mut physique = physique.clone();
        physique.object_count = physique.object_count.min(MAX_OBJECTS);
        let mut engine = settings::engine();
        let ground = bodies::insert_ground(&mut engine, &physique.walls);
        let movers = physique
            .entities()
            .map(|entity| Mover::insert(&mut engine, ground, &physique, entity, state.body(entity)))
            .collect();
        let rules = ContactRules::default();
        let mut world = Self {
            walls: impact::walls(&physique),
            physique,
            engine,
            movers,
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

    /// The present state, with grips and with the contacts between bodies that the engine finds. A body and
    /// the one that holds it are in no contact; their grip says that they touch.
    #[must_use]
    pub fn state(&self) -> State {
        let mut state = State::new(Default::default());
        state.grips = self.welds.map(|weld| weld.map(|weld| weld.grip));
        for (index, mover) in self.movers.iter().enumerate() {
            state.bodies[index] = mover.state(&self.engine);
            for (other, earlier) in self.movers.iter().enumerate().take(index) {
                let (a, b) = (Entity::ALL[index], Entity::ALL[other]);
                if !state.touching(a, b) && contact::touching(&self.engine, mover, earlier) {
                    state.contacts.insert(a, b);
                }
            }
        }
        state
    }

    /// Lets one substep of 1/60 s pass in which nobody acts, and returns the state after it. The published
    /// simulator does so once before the first step.
    pub fn settle(&mut self) -> State {
        self.substep([Action::NoForce; AGENT_COUNT]);
        self.state()
    }

    /// Advances by one step under both agents' actions: five substeps of 1/60 s. Returns the state after each.
    ///
    /// Attaching and detaching happen once, before the first substep; pushes and torques act and `stop` takes
    /// the velocity away in every substep; the agents' angular velocities are zero after the last.
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
                for mover in self.movers.iter().take(AGENT_COUNT) {
                    mover.stop_turning(&mut self.engine);
                }
            }
            self.state()
        })
    }

    fn attach(&mut self, agent: AgentId) {
        let state = self.state();
        if let Some((object, side)) = state.attachable(&self.physique, agent) {
            let angle = |entity| state.body(entity).angle;
            let relative_angle = angle(Entity::Object(object)) - angle(Entity::Agent(agent));
            self.weld(agent, Grip { object, side, relative_angle });
        }
    }

    fn detach(&mut self, agent: AgentId) {
        if let Some(weld) = self.welds[agent].take() {
            let [holder, held] = [Entity::Agent(agent), Entity::Object(weld.grip.object)]
                .map(|entity| &self.movers[entity.index()]);
            self.rules.release(&self.engine, holder, held);
            weld.remove(&mut self.engine);
        }
    }

    /// Makes a grip real; one on an object that is not there, or at no angle, is dropped.
    fn weld(&mut self, agent: AgentId, grip: Grip) {
        let object = grip.object;
        if object.index() < self.physique.object_count && grip.relative_angle.is_finite() {
            let length = self.physique.agents[agent].radius + self.physique.object_radii[object];
            let ends =
                [Entity::Agent(agent), Entity::Object(object)].map(|entity| self.movers[entity.index()].body);
            self.welds[agent] = Some(Weld::insert(&mut self.engine, ends, grip, length));
        }
    }

    fn substep(&mut self, actions: [Action; AGENT_COUNT]) {
        for ((mover, body), action) in self.movers.iter().zip(&self.physique.agents).zip(actions) {
            mover.act(&mut self.engine, body, action);
        }
        let impacts = Impacts::new(&self.physique, &self.walls);
        substep::advance(&mut self.engine, impacts, &mut self.movers, &self.rules);
        self.rules.restore_clear(&self.engine, &self.movers);
    }
}

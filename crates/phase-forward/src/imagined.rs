//! The dynamics as the published planner imagines them.

use crate::{
    box2d::{BodyState, Joint, Scenery, Shape, World},
    wall,
    world::sanitized,
};
use glam::Vec3;
use phase_model::{
    AGENT_COUNT, Action, AgentId, Body, Contacts, Dynamics, Entity, Grip, MAX_OBJECTS, ObjectId,
    PhysicsConfig, Segment, Side, State, Strength, Vec2, arena::SUBSTEPS,
};
use std::sync::Arc;

/// The dynamics as the published planner imagines them, bit for bit.
///
/// Pushes act at the agent's origin. An object that is held at the start of a step hangs on a spring of
/// 100 Hz between the two origins, free to pivot, which keeps their distance; what is grabbed in the step
/// itself is welded. Objects lose their spin and their angle with every step. Steps begin without impulses,
/// as in a world that has just been made. Bodies that overlap a wall may get through it.
#[derive(Clone, Debug)]
pub struct Imagined {
    pub(crate) physics: PhysicsConfig,
    scenery: Arc<Scenery>,
    /// Torques of the agents' turns (N u).
    torques: [f32; AGENT_COUNT],
    stops: [bool; AGENT_COUNT],
}

/// Equal dynamics lead from equal states to equal states.
impl PartialEq for Imagined {
    fn eq(&self, other: &Self) -> bool {
        // Walls, shapes and torques follow from the physics.
        let same_scenery =
            Arc::ptr_eq(&self.scenery, &other.scenery) || self.scenery.collisions == other.scenery.collisions;
        same_scenery && self.stops == other.stops && self.physics == other.physics
    }
}

impl Imagined {
    /// Prepares the dynamics of a scene.
    #[must_use]
    pub fn new(physics: &PhysicsConfig) -> Self {
        let (walls, wall_count) = wall::walls(&physics.walls);
        let sizes = physics.agents.map(|agent| stated(agent.radius));
        let objects = physics.object_radii.iter().take(physics.object_count);
        let agents = sizes.into_iter().map(Shape::agent);
        let walls = walls[..wall_count].iter().map(|it| Shape::wall(Segment { a: it.a, b: it.b }));
        let shapes = agents.chain(objects.map(|&radius| Shape::object(stated(radius))));
        Self {
            scenery: Arc::new(Scenery::new(walls.collect(), shapes.collect())),
            torques: sizes.map(|size| (300.0 * (size / 0.8) * (size / 0.8)) as f32),
            physics: physics.clone(),
            stops: [true; AGENT_COUNT],
        }
    }

    /// These dynamics without collisions between bodies ([`Forward::without_collisions`](crate::Forward::without_collisions)).
    #[must_use]
    pub fn without_collisions(mut self) -> Self {
        Arc::make_mut(&mut self.scenery).collisions = false;
        self
    }

    /// These dynamics with agents of the greatest strength that coast when they mean to stop, as in the
    /// published recordings.
    #[must_use]
    pub fn with_coasting_strongest(mut self) -> Self {
        let strongest = Strength::Mighty.max_force();
        self.stops = self.physics.agents.map(|agent| agent.max_force < strongest);
        self
    }

    /// One step imagined by one of the agents, who grabs before the other does. They grab what would be
    /// within reach if the objects were at these places (u), and the object is pulled from where it is.
    pub fn step_reaching(
        &self,
        own: AgentId,
        state: &mut State,
        actions: [Action; AGENT_COUNT],
        objects_at: [Vec2; MAX_OBJECTS],
    ) {
        let count = self.scenery.count();
        let mut states = [BodyState::STILL; 4];
        for (index, (body, state)) in state.bodies.iter().zip(&mut states).enumerate().take(count) {
            let body = sanitized(*body);
            let is_object = index >= AGENT_COUNT;
            *state = BodyState {
                place: body.position,
                angle: if is_object { 0.0 } else { body.angle },
                velocity: body.velocity,
                spin: if is_object { 0.0 } else { body.angular_velocity },
            };
        }
        let mut world = self.world(&states);
        let mut grips = state.grips;
        for agent in AgentId::ALL {
            let held = grips[agent].map(|grip| (agent.index(), body_of(grip.object)));
            grips[agent] = grips[agent].filter(|grip| body_of(grip.object) < count);
            if let Some(bodies) = held.filter(|bodies| bodies.1 < count) {
                let length = states[bodies.1].place.distance(states[bodies.0].place);
                world.join(Joint::Spring { bodies, length, impulse: 0.0 });
            }
        }
        let mut reached = *state;
        for (object, at) in self.physics.objects().zip(objects_at) {
            reached.body_mut(Entity::Object(object)).position = at;
        }
        for agent in [own, own.other()] {
            match actions[agent] {
                Action::Attach => {
                    if let Some((object, side)) = reached.attachable(&self.physics, agent) {
                        let relative_angle = -states[agent.index()].angle;
                        grips[agent] = Some(Grip { object, side, relative_angle });
                        world.join(self.weld(agent, object, side, relative_angle));
                    }
                }
                Action::Detach => {
                    if let Some(grip) = grips[agent].take() {
                        world.part((agent.index(), body_of(grip.object)));
                    }
                }
                _ => {}
            }
        }
        for substep in 0..SUBSTEPS {
            for agent in AgentId::ALL {
                self.act(&mut world, agent, actions[agent], 0.0);
            }
            world.substep(substep == 0);
        }
        for agent in AgentId::ALL {
            world.stop_turning(agent.index());
        }
        state.grips = grips;
        self.read(&world, state);
    }

    /// A world with the bodies of a state.
    pub(crate) fn world(&self, states: &[BodyState]) -> World {
        World::new(&self.scenery, &states[..self.scenery.count()])
    }

    /// Writes poses, velocities and contacts of a world into a state.
    pub(crate) fn read(&self, world: &World, state: &mut State) {
        for (index, body) in state.bodies.iter_mut().enumerate().take(self.scenery.count()) {
            let BodyState { place, angle, velocity, spin } = world.state(index);
            *body = Body { position: place, angle, velocity, angular_velocity: spin };
        }
        state.contacts = Contacts::NONE;
        for (a, b) in world.touching() {
            state.contacts.insert(Entity::ALL[a], Entity::ALL[b]);
        }
    }

    pub(crate) fn weld(&self, agent: AgentId, object: ObjectId, side: Side, angle: f32) -> Joint {
        let reach = stated(self.physics.agents[agent].radius) + stated(self.physics.object_radii[object]);
        let anchor = side.direction() * reach as f32;
        Joint::Weld { bodies: (agent.index(), body_of(object)), anchor, angle, impulse: Vec3::ZERO }
    }

    /// Applies what an action does in every substep. Pushes act at this share of the agent's size behind its
    /// origin.
    pub(crate) fn act(&self, world: &mut World, agent: AgentId, action: Action, behind: f64) {
        let body = agent.index();
        if let Some(push) = action.push() {
            let at = Vec2::new(0.0, (-stated(self.physics.agents[agent].radius) * behind) as f32);
            world.push(body, at, push * self.physics.agents[agent].max_force);
        } else if action == Action::Stop && self.stops[agent] {
            world.stop(body);
        } else {
            world.turn(body, action.turn() * self.torques[agent]);
        }
    }
}

/// A radius as it is stated, in double precision: the original computes outlines with that.
fn stated(radius: f32) -> f64 {
    const DECIMALS: f64 = 1e4;
    (f64::from(radius) * DECIMALS).round() / DECIMALS
}

pub(crate) const fn body_of(object: ObjectId) -> usize {
    AGENT_COUNT + object.index()
}

impl Dynamics for Imagined {
    /// [`Imagined::step_reaching`] of the first agent, for objects where they are.
    fn step(&self, state: &mut State, actions: [Action; AGENT_COUNT]) {
        let at = [2, 3].map(|body: usize| state.bodies[body].position);
        self.step_reaching(AgentId::ZERO, state, actions, at);
    }
}

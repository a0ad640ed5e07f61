//! The world: a scene's bodies in the engine, stepped by actions.

use crate::{bodies, contact, contact::ContactRules, friction, grip::Weld, settings};
use phase_model::{
    AGENT_COUNT, Action, Body, Entity, Grip, Physique, State, Vec2, arena, arena::SUBSTEP_SECONDS,
    arena::SUBSTEPS,
};
use rapier2d::prelude::*;

/// A scene's bodies in motion.
pub struct World {
    physique: Physique,
    engine: PhysicsWorld,
    movers: Vec<Mover>,
    welds: [Option<Weld>; AGENT_COUNT],
    rules: ContactRules,
}

/// What the world keeps of one body.
struct Mover {
    body: RigidBodyHandle,
    collider: ColliderHandle,
    friction: ImpulseJointHandle,
    /// The unbounded angle; the engine knows it only modulo a full turn (rad).
    angle: f32,
}

impl World {
    /// A world in the given state. Any start will do: bodies that overlap are pushed apart over the first
    /// substeps, grips become rigid welds that pull their object into place, and numbers that are not finite
    /// or lie outside the arena are brought back to what is possible.
    #[must_use]
    pub fn new(physique: &Physique, state: &State) -> Self {
        let mut engine = settings::engine();
        let ground = bodies::insert_ground(&mut engine, &physique.walls);
        let movers: Vec<Mover> = physique
            .entities()
            .map(|entity| {
                let start = possible(state.body(entity));
                let (body, collider) = bodies::insert_body(&mut engine, physique, entity, &start);
                let friction = friction::insert(&mut engine, ground, body);
                Mover { body, collider, friction, angle: start.angle }
            })
            .collect();
        let mut world =
            Self { physique: physique.clone(), engine, movers, welds: [None; AGENT_COUNT], rules: ContactRules::default() };
        for agent in 0..AGENT_COUNT {
            if let Some(grip) = state.grips[agent] {
                world.weld(agent, grip);
            }
        }
        world.find_contacts();
        world
    }

    /// The present state, with grips and with the contacts between bodies as the engine reports them.
    #[must_use]
    pub fn state(&self) -> State {
        let mut state = State::new(Default::default());
        for (index, mover) in self.movers.iter().enumerate() {
            let rigid_body = &self.engine.bodies[mover.body];
            state.bodies[index] = Body {
                position: rigid_body.translation(),
                velocity: rigid_body.linvel(),
                angle: mover.angle,
                angular_velocity: rigid_body.angvel(),
            };
            for (other, before) in self.movers[..index].iter().enumerate() {
                if contact::touching(&self.engine, mover.collider, before.collider) {
                    state.contacts.insert(Entity::from_index(index), Entity::from_index(other));
                }
            }
        }
        state.grips = self.welds.map(|weld| weld.map(|weld| weld.grip));
        state
    }

    /// Lets one substep of 1/60 s pass in which nobody acts.
    pub fn settle(&mut self) -> State {
        self.substep([Action::NoForce; AGENT_COUNT]);
        self.state()
    }

    /// Advances by one step under both agents' actions: five substeps of 1/60 s. Returns the state after each.
    ///
    /// Attaching and detaching happen once, before the first substep; pushes and torques act and `stop` takes
    /// the velocity away in every substep; the agents' angular velocities are zero after the last.
    pub fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        for (agent, action) in actions.into_iter().enumerate() {
            match action {
                Action::Attach => self.attach(agent),
                Action::Detach => self.detach(agent),
                _ => {}
            }
        }
        core::array::from_fn(|substep| {
            self.substep(actions);
            if substep + 1 == SUBSTEPS {
                for mover in &self.movers[..AGENT_COUNT] {
                    self.engine.bodies[mover.body].set_angvel(0.0, true);
                }
            }
            self.state()
        })
    }

    fn attach(&mut self, agent: usize) {
        let state = self.state();
        let Some((object, side)) = state.attachable(&self.physique, agent) else { return };
        let relative_angle = state.body(Entity::object(object)).angle - state.body(Entity::agent(agent)).angle;
        self.weld(agent, Grip { object: object as u8, side, relative_angle });
    }

    fn detach(&mut self, agent: usize) {
        if let Some(weld) = self.welds[agent].take() {
            self.rules.release(Entity::agent(agent), Entity::Object(weld.grip.object));
            weld.remove(&mut self.engine);
        }
    }

    fn weld(&mut self, agent: usize, grip: Grip) {
        let object = usize::from(grip.object);
        if object >= self.physique.object_count || !grip.relative_angle.is_finite() {
            return;
        }
        let length = self.physique.agents[agent].radius + self.physique.object_radii[object];
        let held = self.movers[Entity::object(object).index()].body;
        self.welds[agent] = Some(Weld::insert(&mut self.engine, self.movers[agent].body, held, grip, length));
    }

    fn substep(&mut self, actions: [Action; AGENT_COUNT]) {
        for (agent, action) in actions.into_iter().enumerate() {
            self.act(agent, action);
        }
        self.aim_friction();
        let rotations: Vec<Rotation> = self.movers.iter().map(|m| *self.engine.bodies[m.body].rotation()).collect();
        let passes = std::env::var("PASSES").map_or(3, |s| s.parse::<usize>().unwrap());
        for pass in 0..passes {
            let before: Vec<(Pose, RigidBodyVelocity<f32>)> = self.movers.iter().map(|m| { let b = &self.engine.bodies[m.body]; (*b.position(), *b.vels()) }).collect();
            self.engine.step_with_events(&self.rules, &());
            if pass + 1 < passes {
                let mut turned = false;
                let mut aims = vec![];
                for (mover, (pose, _)) in self.movers.iter().zip(&before) {
                    let body = &self.engine.bodies[mover.body];
                    let arm = pose.rotation * -body.local_center_of_mass();
                    let slip = friction::impulse_for2(body, arm, body.linvel() + arm.perp() * body.angvel());
                    let exerted = friction::exerted(&self.engine, mover.friction);
                    let rot = self.engine.impulse_joints.get(mover.friction).unwrap().data.local_frame1.rotation;
                    let now = Vec2::new(rot.re, rot.im);
                    if std::env::var("NOSTRUCK").is_err() && contact::struck_wall(&self.engine, mover.collider) { aims.push((now, false)); continue; }
                    let hold = slip.length() < 0.01 * friction::IMPULSE;
                    let axis = if hold { exerted } else { slip };
                    turned |= now.perp_dot(axis.normalize_or_zero()).abs() > 1e-3;
                    aims.push((axis, hold));
                }
                if !turned { break; }
                for (mover, (pose, vels)) in self.movers.iter().zip(before) {
                    let body = &mut self.engine.bodies[mover.body];
                    body.set_position(pose, true);
                    body.set_vels(vels, true);
                }
                for (mover, (axis, hold)) in self.movers.iter().zip(aims) {
                    friction::aim(&mut self.engine, mover.friction, axis, hold);
                }
            }
        }
        for (mover, before) in self.movers.iter_mut().zip(rotations) {
            let rigid_body = &mut self.engine.bodies[mover.body];
            let turned = before.inverse() * *rigid_body.rotation();
            // The engine moves a body's axis along the tangent, by tan Δθ where it should have been Δθ.
            mover.angle += turned.im / turned.re.max(0.1);
            let rotation = bodies::rotation(mover.angle);
            let centre = rigid_body.center_of_mass();
            let origin = centre - rotation * rigid_body.local_center_of_mass();
            rigid_body.set_position(Pose::from_parts(origin, rotation), true);
        }
        let colliders: Vec<ColliderHandle> = self.movers.iter().map(|mover| mover.collider).collect();
        self.rules.restore_clear(&self.engine, &colliders);
    }

    /// Applies an agent's push, torque or stop for one substep.
    fn act(&mut self, agent: usize, action: Action) {
        let body = &self.physique.agents[agent];
        let rigid_body = &mut self.engine.bodies[self.movers[agent].body];
        rigid_body.reset_forces(true);
        rigid_body.reset_torques(true);
        if let Some(push) = action.push() {
            let point = *rigid_body.position() * Vec2::new(0.0, -body.push_point_offset());
            let force = *rigid_body.rotation() * (push * body.max_force);
            rigid_body.add_force_at_point(force, point, true);
        }
        rigid_body.add_torque(action.turn() * body.turn_torque(), true);
        if action == Action::Stop {
            rigid_body.set_linvel(Vec2::ZERO, true);
        }
    }

    /// Aims every body's ground friction against the motion it is about to make.
    fn aim_friction(&mut self) {
        for mover in &self.movers {
            let body = &self.engine.bodies[mover.body];
            let slip = friction::impulse_for(body, friction::origin_velocity(body, true));
            friction::aim(&mut self.engine, mover.friction, slip, slip.length() <= friction::IMPULSE);
        }
    }

    /// Lets the engine look for contacts without letting time pass.
    fn find_contacts(&mut self) {
        self.engine.integration_parameters.dt = 0.0;
        self.engine.step_with_events(&self.rules, &());
        self.engine.integration_parameters.dt = SUBSTEP_SECONDS;
    }
}

/// The nearest body that can be in the arena: finite, with its origin inside.
fn possible(body: &Body) -> Body {
    let finite = |vector: Vec2, default| if vector.is_finite() { vector } else { default };
    let number = |number: f32| if number.is_finite() { number } else { 0.0 };
    Body {
        position: finite(body.position, arena::CENTRE).clamp(arena::MIN, arena::MAX),
        velocity: finite(body.velocity, Vec2::ZERO),
        angle: number(body.angle),
        angular_velocity: number(body.angular_velocity),
    }
}

//! The solver's working state: a state unpacked for solving and packed again.

use crate::{
    body::BodyMotion,
    constants::{BOUNDARY_MARGIN, H, VELOCITY_ITERATIONS},
    key::{BodyMask, KeySet},
    model::Model,
    outline::Outlines,
    wall::WallSet,
    weld::held_body,
};
use phase_model::{
    AGENT_COUNT, Action, AgentId, Body, Entity, Grip, State, Vec2, arena,
    physics::{MAX_ANGLE, valid_angle},
};

/// Impulses of the last substep other than contacts', used for warm starting.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Impulses {
    /// Of ground friction on each body (N s).
    pub(crate) ground: [Vec2; 4],
    /// Of each agent's grip (N s and N u s).
    pub(crate) grasps: [(Vec2, f32); AGENT_COUNT],
}

impl Impulses {
    pub(crate) const NONE: Self = Self { ground: [Vec2::ZERO; 4], grasps: [(Vec2::ZERO, 0.0); AGENT_COUNT] };
}

/// The working data of one step.
#[derive(Clone)]
pub(crate) struct World<'a> {
    pub(crate) model: &'a Model,
    /// The four bodies and the static body for all walls.
    pub(crate) motions: [BodyMotion; 5],
    /// Pose of each body at the start of the substep: centre, angle, unit vector to its right.
    pub(crate) starts: [(Vec2, f32, Vec2); 4],
    pub(crate) outlines: Outlines,
    /// For each body, the walls that it can reach in this step.
    pub(crate) walls: [WallSet; 4],
    pub(crate) grips: [Option<Grip>; AGENT_COUNT],
    /// The agent that grabbed last; its weld comes first.
    pub(crate) latest_grip: usize,
    pub(crate) actions: [Action; AGENT_COUNT],
    /// Maximum push of each agent (N).
    pub(crate) max_forces: [f32; AGENT_COUNT],
    pub(crate) impulses: Impulses,
    /// Pairs that may not touch, because one holds the other.
    pub(crate) excluded_pairs: KeySet,
    /// Pairs whose contact tolerates an overlap: released, and not yet clear.
    pub(crate) released: KeySet,
    /// Places of all bodies at the release (u).
    pub(crate) let_go_at: [Vec2; 4],
    /// Distance that each body has to move from there before it counts as clear (u).
    pub(crate) release_distance: [f32; 4],
    /// Sleeping bodies: at rest and in equilibrium with ground friction and walls.
    pub(crate) sleeping: u8,
    /// Iterations of the velocity solver in the coming substep.
    pub(crate) iterations: usize,
    /// Maximum displacement of each body in the step on its own (u).
    pub(crate) max_displacements: [f32; 4],
    /// Duration of the substep (s).
    pub(crate) seconds: f32,
}

impl<'a> World<'a> {
    /// Unpacks a state. Invalid values are replaced, and centres of mass are clamped to the arena.
    pub(crate) fn new(model: &'a Model, state: &State, actions: [Action; AGENT_COUNT]) -> Self {
        let mut motions = [BodyMotion::AT_REST; 5];
        for (index, motion) in motions.iter_mut().enumerate().take(model.count) {
            *motion = unpacked(model, index, &state.bodies[index]);
        }
        let angles = motions.map(|motion| motion.angle);
        let grips = [0, 1].map(|agent| Some(sanitized_grip(state.grips[agent]?, agent, &angles)));
        Self {
            model,
            motions,
            starts: [(Vec2::ZERO, 0.0, Vec2::X); 4],
            outlines: Outlines::NONE,
            walls: [WallSet::MAX; 4],
            grips,
            latest_grip: 1,
            actions,
            max_forces: [0, 1].map(|agent: usize| model.shapes[agent].max_force),
            impulses: Impulses::NONE,
            excluded_pairs: 0,
            released: 0,
            let_go_at: [Vec2::ZERO; 4],
            release_distance: [0.0; 4],
            sleeping: 0,
            iterations: VELOCITY_ITERATIONS,
            max_displacements: [0.0; 4],
            seconds: H,
        }
    }

    /// The held pair of each agent, as bodies.
    pub(crate) fn held(&self, agent: usize) -> Option<usize> {
        let body = held_body(self.grips[agent].as_ref()?);
        (body < self.model.count).then_some(body)
    }

    /// Distance between a held object and where its agent holds it (u).
    pub(crate) fn joint_error(&self, agent: usize) -> Option<f32> {
        let grip = self.grips[agent].as_ref()?;
        let held = self.held(agent)?;
        let shape = &self.model.shapes[agent];
        let holder = &self.motions[agent];
        let reach = grip.side.direction() * (shape.radius + self.model.shapes[held].radius);
        let place = holder.place(reach + Vec2::new(0.0, shape.origin));
        Some(place.distance(self.motions[held].centre))
    }

    /// Writes the bodies and grips into a state, whose contacts are not changed. Origins lie inside the
    /// arena, as in the reference world: an agent's is ahead of its centre of mass, which alone is contained
    /// while bodies move.
    pub(crate) fn write(&self, state: &mut State) {
        for index in 0..self.model.count {
            let body = &mut state.bodies[index];
            *body = self.motions[index].body(&self.model.shapes[index]);
            body.position = body.position.clamp(arena::MIN, arena::MAX);
        }
        state.grips = self.grips;
    }

    /// Lets both agents grab or release, once and before anything moves. Returns the agents that released
    /// something, with the body they held.
    pub(crate) fn grab(&mut self, state: &State) -> [Option<usize>; AGENT_COUNT] {
        let mut released = [None; AGENT_COUNT];
        for agent in AgentId::ALL {
            match self.actions[agent] {
                Action::Attach => {
                    if let Some((object, side)) = state.attachable(&self.model.physics, agent) {
                        // Not the state's angles, which may have been corrected.
                        let angle = |entity: Entity| self.motions[entity.index()].angle;
                        let relative_angle = angle(Entity::Object(object)) - angle(Entity::Agent(agent));
                        self.grips[agent] = Some(Grip { object, side, relative_angle });
                        self.impulses.grasps[agent] = (Vec2::ZERO, 0.0);
                        self.latest_grip = agent.index();
                    }
                }
                Action::Detach => {
                    released[agent] = self.held(agent.index());
                    self.grips[agent] = None;
                }
                _ => {}
            }
        }
        released
    }

    /// Updates the outlines of some bodies.
    #[inline]
    pub(crate) fn outline(&mut self, bodies: BodyMask) {
        self.outlines.update(bodies, self.model, &self.motions);
    }

    /// Records that a body's pose has changed.
    #[inline]
    pub(crate) fn moved(&mut self, body: usize) {
        self.outlines.moved(body);
    }

    /// Records that the poses of all bodies have changed.
    pub(crate) fn all_moved(&mut self) {
        self.outlines.all_moved();
    }
}

/// Largest number of a velocity (u/s, rad/s) that a step begins with: one step's impacts may leave more than
/// [`MAX_SPEED`](phase_model::physics::MAX_SPEED), to which the next limits it before anything moves.
const MAX_VELOCITY: f32 = 1e4;

/// Maximum accepted twist of a grip (rad); the strongest agents stay far below it.
const MAX_GRIP_ANGLE: f32 = 1.0;

/// A body of a state. Invalid values are replaced, and its centre of mass is clamped to the arena.
#[inline]
fn unpacked(model: &Model, index: usize, body: &Body) -> BodyMotion {
    let replaced;
    let body = if is_sane(body) {
        body
    } else {
        replaced = sanitized(*body);
        &replaced
    };
    let mut motion = if index < AGENT_COUNT {
        BodyMotion::of_agent(body, &model.shapes[index])
    } else {
        BodyMotion::of_object(body)
    };
    if !arena::contains(motion.centre) {
        motion.centre = motion.centre.clamp(arena::MIN + BOUNDARY_MARGIN, arena::MAX - BOUNDARY_MARGIN);
    }
    motion
}

/// A grip at the actual angle of its object if the stated angle differs much from that or is NaN.
/// Takes the angles of the bodies.
fn sanitized_grip(grip: Grip, agent: usize, angles: &[f32; 5]) -> Grip {
    let angle = angles[held_body(&grip)] - angles[agent];
    let is_sane = (grip.relative_angle - angle).abs() <= MAX_GRIP_ANGLE;
    Grip { relative_angle: if is_sane { grip.relative_angle } else { angle }, ..grip }
}

/// Whether all numbers of a body are valid.
fn is_sane(body: &Body) -> bool {
    body.position.is_finite()
        && body.velocity.abs().max_element() <= MAX_VELOCITY
        && body.angular_velocity.abs() <= MAX_VELOCITY
        && body.angle.abs() <= MAX_ANGLE
        && !body.velocity.is_nan()
}

/// The body with invalid values replaced: 0 for non-finite ones, the closest bound for those out of range.
pub(crate) fn sanitized(body: Body) -> Body {
    let number = |x: f32, most: f32| if x.is_nan() { 0.0 } else { x.clamp(-most, most) };
    Body {
        position: Vec2::new(
            number(body.position.x, 2.0 * arena::MAX.x),
            number(body.position.y, 2.0 * arena::MAX.y),
        ),
        velocity: Vec2::new(number(body.velocity.x, MAX_VELOCITY), number(body.velocity.y, MAX_VELOCITY)),
        angle: valid_angle(body.angle),
        angular_velocity: number(body.angular_velocity, MAX_VELOCITY),
    }
}

//! The physical state of the world at one moment, as plain copyable data.

use crate::{
    AGENT_COUNT, Action, AgentId, Entity, Flip, MAX_ENTITIES, ObjectId, PhysicsConfig, Vec2, geometry,
};
use serde::{Deserialize, Serialize};

/// Pose and motion of one body, in world coordinates: the arena is 20 u × 20 u, x to the right, y upwards.
///
/// An angle of 0 rad faces upwards, and angles grow to the left (counter-clockwise). An agent's position is
/// the origin of its trapezoid, an object's the centre of its disc.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Body {
    /// The body's origin (u): mid-height of an agent (not its centre of mass), centre of an object.
    pub position: Vec2,
    /// Velocity of the centre of mass (u/s).
    pub velocity: Vec2,
    /// Angle (rad), unbounded, 0 facing +y, positive counter-clockwise.
    pub angle: f32,
    /// Angular velocity (rad/s). An agent's is 0 after every whole step.
    pub angular_velocity: f32,
}

impl Body {
    /// A body at rest.
    #[must_use]
    pub const fn at_rest(position: Vec2, angle: f32) -> Self {
        Self { position, velocity: Vec2::ZERO, angle, angular_velocity: 0.0 }
    }

    /// Unit vector of the heading, (−sin θ, cos θ).
    #[must_use]
    pub fn forward(&self) -> Vec2 {
        geometry::forward(self.angle)
    }

    /// The body in a mirrored arena.
    #[must_use]
    pub fn mirrored(&self, flip: Flip) -> Self {
        Self {
            position: flip.point(self.position),
            velocity: flip.vector(self.velocity),
            angle: flip.angle(self.angle),
            angular_velocity: -self.angular_velocity,
        }
    }

    /// Whether every number is finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.position.is_finite()
            && self.velocity.is_finite()
            && self.angle.is_finite()
            && self.angular_velocity.is_finite()
    }
}

/// The side of an agent that holds an object.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// The narrow front.
    Head,
    /// The wide back.
    Tail,
    /// The right flank.
    Right,
    /// The left flank.
    Left,
}

impl Side {
    /// All sides, in the order in which grabbing tries them.
    pub const ALL: [Self; 4] = [Self::Head, Self::Tail, Self::Right, Self::Left];

    /// Unit vector from the agent's origin to the side, in the agent's frame (x right, y forward).
    #[must_use]
    pub const fn direction(self) -> Vec2 {
        match self {
            Self::Head => Vec2::new(0.0, 1.0),
            Self::Tail => Vec2::new(0.0, -1.0),
            Self::Right => Vec2::new(1.0, 0.0),
            Self::Left => Vec2::new(-1.0, 0.0),
        }
    }
}

/// An agent's rigid grip of an object: the object's centre is at distance R + r on the given side.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Grip {
    /// The object held.
    pub object: ObjectId,
    /// The side that holds it.
    pub side: Side,
    /// The object's angle minus the agent's, constant from the moment of grabbing (rad).
    pub relative_angle: f32,
}

/// The pairs of bodies that are in physical contact, as the dynamics reported it after the last substep.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
pub struct Contacts(u8);

impl Contacts {
    /// No contacts.
    pub const NONE: Self = Self(0);

    /// Records a contact between two different entities. A pair of equal entities is ignored.
    pub const fn insert(&mut self, a: Entity, b: Entity) {
        self.0 |= Self::bit(a, b);
    }

    /// Whether two entities touch.
    #[must_use]
    pub const fn touching(self, a: Entity, b: Entity) -> bool {
        self.0 & Self::bit(a, b) != 0
    }

    /// The union of two sets of pairs.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// One bit for each of the six unordered pairs; none for a pair of equals.
    const fn bit(a: Entity, b: Entity) -> u8 {
        let a = a.index();
        let b = b.index();
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        match (low, high) {
            (0, 1) => 1,
            (0, 2) => 2,
            (0, 3) => 4,
            (1, 2) => 8,
            (1, 3) => 16,
            (2, 3) => 32,
            _ => 0,
        }
    }
}

/// The complete physical state s of the Dec-POMDP: at most four bodies, with grips and contacts.
///
/// Bodies are indexed by [`Entity`]; those of objects that a scene does not have are ignored.
/// A state is plain data without pointers, small enough to be copied for every particle of a belief.
///
/// ```
/// use phase_model::{AgentId, Body, Entity, State, Vec2};
///
/// let places = [Vec2::new(10.0, 6.0), Vec2::new(20.0, 16.0), Vec2::ZERO, Vec2::ZERO];
/// let state = State::new(places.map(|place| Body::at_rest(place, 0.0)));
/// assert_eq!(state.position(Entity::Agent(AgentId::ONE)).x, 20.0);
/// assert_eq!(state.held_object(AgentId::ONE), None);
/// ```
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct State {
    /// Bodies by [`Entity::index`]; those past [`PhysicsConfig::entity_count`] are meaningless.
    pub bodies: [Body; MAX_ENTITIES],
    /// The grip of each agent, if it holds an object.
    pub grips: [Option<Grip>; AGENT_COUNT],
    /// Contacts between bodies (not with walls) after the last substep.
    pub contacts: Contacts,
}

impl State {
    /// A state without grips and contacts.
    #[must_use]
    pub const fn new(bodies: [Body; MAX_ENTITIES]) -> Self {
        Self { bodies, grips: [None; AGENT_COUNT], contacts: Contacts::NONE }
    }

    /// The body of an entity.
    #[must_use]
    pub const fn body(&self, entity: Entity) -> &Body {
        &self.bodies[entity.index()]
    }

    /// The body of an entity, mutably.
    pub const fn body_mut(&mut self, entity: Entity) -> &mut Body {
        &mut self.bodies[entity.index()]
    }

    /// Position of an entity's origin (u).
    #[must_use]
    pub const fn position(&self, entity: Entity) -> Vec2 {
        self.bodies[entity.index()].position
    }

    /// The object an agent holds.
    #[must_use]
    pub fn held_object(&self, agent: AgentId) -> Option<ObjectId> {
        self.grips[agent].map(|grip| grip.object)
    }

    /// Whether an agent holds an object.
    #[must_use]
    pub fn holds(&self, agent: AgentId, object: ObjectId) -> bool {
        self.held_object(agent) == Some(object)
    }

    /// Whether two entities touch: they are in contact or one holds the other.
    #[must_use]
    pub fn touching(&self, a: Entity, b: Entity) -> bool {
        self.contacts.touching(a, b)
            || match (a, b) {
                (Entity::Agent(agent), Entity::Object(object))
                | (Entity::Object(object), Entity::Agent(agent)) => self.holds(agent, object),
                _ => false,
            }
    }

    /// The object that `attach` would grab, and with which side: of the objects whose centre is closer
    /// than r + [`crate::physics::GRAB_REACH`] to one of the agent's four grab points, the closest. `None` if
    /// the agent already holds something.
    #[must_use]
    pub fn attachable(&self, physics: &PhysicsConfig, agent: AgentId) -> Option<(ObjectId, Side)> {
        if self.grips[agent].is_some() {
            return None;
        }
        let body = self.body(Entity::Agent(agent));
        let radius = physics.agents[agent].radius;
        let rotation = Vec2::from_angle(body.angle);
        let mut best: Option<(f32, ObjectId, Side)> = None;
        for object in physics.objects() {
            let centre = self.position(Entity::Object(object));
            let reach = physics.object_radii[object] + crate::physics::GRAB_REACH;
            for side in Side::ALL {
                let point = body.position + rotation.rotate(side.direction() * radius);
                let distance = point.distance(centre);
                if distance < reach && best.is_none_or(|(nearest, ..)| distance < nearest) {
                    best = Some((distance, object, side));
                }
            }
        }
        best.map(|(_, object, side)| (object, side))
    }

    /// Whether all numbers of the bodies present are finite.
    #[must_use]
    pub fn is_finite(&self, physics: &PhysicsConfig) -> bool {
        self.bodies[..physics.entity_count()].iter().all(Body::is_finite)
    }
}

/// State transitions of the Dec-POMDP, P(s′ | s, {aᵢ}, {fᵢ}); the forces fᵢ belong to the implementor.
///
/// Implementations are deterministic: equal states and actions give equal bits. A step lasts 1/12 s of
/// simulated time. Planning, beliefs and inference are generic over this trait, so that they run without a
/// physics engine.
pub trait Dynamics {
    /// Advances the state by one step: five substeps of 1/60 s under the two agents' actions.
    fn step(&self, state: &mut State, actions: [Action; AGENT_COUNT]);

    /// Advances the state by one step approximately, for comparing actions within a search. The default is
    /// [`step`](Self::step).
    fn step_approximate(&self, state: &mut State, actions: [Action; AGENT_COUNT]) {
        self.step(state, actions);
    }
}

//! The parameters of a scene's physics: walls, radii and forces, but no goals or attitudes.

use crate::{Entity, MAX_OBJECTS, ObjectId, Segment, arena::SUBSTEP_SECONDS, entity::AGENT_COUNT};
use serde::{Deserialize, Serialize};

/// Size level of an entity; the levels are not in order of size.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub enum Size {
    /// Level 0, radius 0.8 u.
    Small,
    /// Level 1, radius 1.2 u.
    Large,
    /// Level 2, radius 1.6 u.
    Huge,
    /// Level 3, radius 1.01 u.
    Medium,
}

impl Size {
    /// All sizes, in level order.
    pub const ALL: [Self; 4] = [Self::Small, Self::Large, Self::Huge, Self::Medium];

    /// Level 0 to 3.
    #[must_use]
    pub const fn level(self) -> u8 {
        self as u8
    }

    /// The size of a level, or `None` past 3.
    #[must_use]
    pub fn from_level(level: u8) -> Option<Self> {
        Self::ALL.get(usize::from(level)).copied()
    }

    /// The name on pages: small, medium, large or huge.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Small => "small",
            Self::Medium => "medium",
            Self::Large => "large",
            Self::Huge => "huge",
        }
    }

    /// Radius R (u): an object's radius, or half an agent's height.
    #[must_use]
    pub const fn radius(self) -> f32 {
        match self {
            Self::Small => 0.8,
            Self::Large => 1.2,
            Self::Huge => 1.6,
            Self::Medium => 1.01,
        }
    }
}

/// Strength level of an agent.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub enum Strength {
    /// Level 0, 150 N: moves itself, but no object alone.
    Weak,
    /// Level 1, 300 N.
    Fair,
    /// Level 2, 450 N.
    Strong,
    /// Level 3, 600 N.
    Mighty,
}

impl Strength {
    /// All strengths, in level order.
    pub const ALL: [Self; 4] = [Self::Weak, Self::Fair, Self::Strong, Self::Mighty];

    /// Level 0 to 3.
    #[must_use]
    pub const fn level(self) -> u8 {
        self as u8
    }

    /// The strength of a level, or `None` past 3.
    #[must_use]
    pub fn from_level(level: u8) -> Option<Self> {
        Self::ALL.get(usize::from(level)).copied()
    }

    /// The name on pages: weak, fair, strong or mighty.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Weak => "weak",
            Self::Fair => "fair",
            Self::Strong => "strong",
            Self::Mighty => "mighty",
        }
    }

    /// Maximum force (N), held constant through a step.
    #[must_use]
    pub const fn max_force(self) -> f32 {
        150.0 * (self as u8 + 1) as f32
    }
}

/// Maximum force of ground friction on each body, whatever its mass (N).
pub const GROUND_FRICTION: f32 = 100.0;
/// Maximum distance between a grab point and an object's surface at which grabbing works (u).
pub const GRAB_REACH: f32 = 0.5;
/// Overlap that a released object and its holder may keep, skins included, until one of them has moved away
/// (u).
pub const RELEASED_OVERLAP: f32 = 0.1;
/// Distance from its place at the release beyond which a body at rest is clear of its former partner (u).
pub const RELEASE_CLEARANCE: f32 = 0.1;

/// Distance from its place at the release beyond which a body is clear of its former partner (u):
/// [`RELEASE_CLEARANCE`], and what it covers in four substeps at its speed then (u/s).
#[must_use]
pub fn release_distance(speed: f32) -> f32 {
    RELEASE_CLEARANCE + 4.0 * SUBSTEP_SECONDS * speed
}

/// Mass per area of every body (kg/u²).
pub const DENSITY: f32 = 1.0;

/// An agent's body.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct AgentBody {
    /// Half the height of the trapezoid, R (u). See [`crate::geometry::trapezoid`].
    pub radius: f32,
    /// Maximum force the agent can exert (N).
    pub max_force: f32,
}

impl AgentBody {
    /// Mass 4R² (kg).
    #[must_use]
    pub fn mass(self) -> f32 {
        DENSITY * 4.0 * self.radius * self.radius
    }

    /// Moment of inertia about the centre of mass, 26R⁴/9 (kg u²).
    #[must_use]
    pub fn inertia(self) -> f32 {
        let square = self.radius * self.radius;
        DENSITY * square * square * (26.0 / 9.0)
    }

    /// Torque of a turn (N u); it does not depend on strength.
    #[must_use]
    pub fn turn_torque(self) -> f32 {
        let scale = self.radius / 0.8;
        300.0 * scale * scale
    }

    /// Distance of the centre of mass behind the body's origin, R/6 (u).
    #[must_use]
    pub fn centre_of_mass_offset(self) -> f32 {
        self.radius / 6.0
    }

    /// Distance behind the origin at which pushes act, R/12 (u).
    #[must_use]
    pub fn push_point_offset(self) -> f32 {
        self.radius / 12.0
    }

    /// Width of the gap the body needs to move forward: its base, 3R (u).
    #[must_use]
    pub fn width(self) -> f32 {
        3.0 * self.radius
    }
}

/// Mass of an object of radius r, πr² (kg).
#[must_use]
pub fn object_mass(radius: f32) -> f32 {
    DENSITY * core::f32::consts::PI * radius * radius
}

/// Moment of inertia of an object of radius r about its centre, πr⁴/2 (kg u²).
#[must_use]
pub fn object_inertia(radius: f32) -> f32 {
    0.5 * object_mass(radius) * radius * radius
}

/// Everything that physics and perception need to know about a scene and that does not change over time.
#[derive(Clone, PartialEq, Debug)]
pub struct PhysicsConfig {
    /// Inner walls; the arena's boundary is implied.
    pub walls: Vec<Segment>,
    /// The two agents' bodies.
    pub agents: [AgentBody; AGENT_COUNT],
    /// Radii of the objects (u); only the first `object_count` are used.
    pub object_radii: [f32; MAX_OBJECTS],
    /// Number of objects, 0 to 2.
    pub object_count: usize,
}

impl PhysicsConfig {
    /// Number of entities, agents included.
    #[must_use]
    pub const fn entity_count(&self) -> usize {
        AGENT_COUNT + self.object_count
    }

    /// The entities present, agents first.
    pub fn entities(&self) -> impl Iterator<Item = Entity> + use<> {
        Entity::ALL.into_iter().take(self.entity_count())
    }

    /// The objects present.
    pub fn objects(&self) -> impl Iterator<Item = ObjectId> + use<> {
        ObjectId::ALL.into_iter().take(self.object_count)
    }

    /// Radius of an entity (u).
    #[must_use]
    pub fn radius(&self, entity: Entity) -> f32 {
        match entity {
            Entity::Agent(agent) => self.agents[agent].radius,
            Entity::Object(object) => self.object_radii[object],
        }
    }
}

/// Greatest angle of a body, to either side (rad): 16,000 turns. Beyond it, adjacent numbers differ by a
/// visible rotation.
pub const MAX_ANGLE: f32 = 1e5;

/// Greatest displacement of a body in one substep (u), in both engines, as in Box2D.
pub const MAX_TRANSLATION: f32 = 2.0;
/// Greatest rotation of a body in one substep (rad), as in Box2D.
pub const MAX_ROTATION: f32 = 0.5 * core::f32::consts::PI;
/// Greatest speed of a body (u/s): 120. The fastest agents stay below a tenth of it.
pub const MAX_SPEED: f32 = MAX_TRANSLATION / SUBSTEP_SECONDS;
/// Greatest angular velocity of a body, to either side (rad/s): 94.
pub const MAX_SPIN: f32 = MAX_ROTATION / SUBSTEP_SECONDS;

/// The angle that engines take a body's to be: 0 if it is no number, and the closest of [`MAX_ANGLE`] if it
/// is beyond. A scene has no such angles ([`Scene::validate`](crate::Scene::validate)).
#[must_use]
pub const fn valid_angle(angle: f32) -> f32 {
    if angle.is_finite() { angle.clamp(-MAX_ANGLE, MAX_ANGLE) } else { 0.0 }
}

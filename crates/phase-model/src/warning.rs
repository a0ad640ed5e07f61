//! Suspicious properties of a scene that can nevertheless be simulated.

use crate::{Entity, EventKind, Scene, geometry::Outline, validate::field_name};
use core::{f32::consts::PI, fmt};

/// Bodies that overlap by no more than this are merely in contact (u).
const TOUCH: f32 = 0.01;

/// A start angle beyond this is likely to be in degrees by mistake (rad). Published recordings begin with
/// angles of up to 1.3 turns.
const LARGEST_ANGLE: f32 = 4.0 * PI;

/// Something in a scene that is likely to be a mistake. The text names the field and the rule.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum SceneWarning {
    /// Two bodies overlap at the start. The physics will push them apart.
    Overlap {
        /// The one body.
        first: Entity,
        /// The other body.
        second: Entity,
        /// Minimum distance by which one of them has to be moved (u).
        depth: f32,
    },
    /// A body overlaps a wall or the arena's boundary at the start. The physics will push it to one side.
    AcrossWall {
        /// The body.
        body: Entity,
        /// Minimum distance by which it has to be moved (u).
        depth: f32,
    },
    /// The kind of event does not follow from goals and attitudes.
    Kind {
        /// The kind given.
        kind: EventKind,
        /// The kind that follows from goals and attitudes.
        follows: EventKind,
    },
    /// An angle at the start appears to be in degrees.
    Degrees {
        /// The body.
        body: Entity,
        /// Its angle (rad).
        angle: f32,
    },
}

impl fmt::Display for SceneWarning {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Overlap { first, second, depth } => {
                let first = field_name(first);
                let second = field_name(second);
                write!(formatter, "{first}.start and {second}.start: the bodies overlap by {depth:.2} u")
            }
            Self::AcrossWall { body, depth } => {
                write!(formatter, "{}.start: the body stands across a wall by {depth:.2} u", field_name(body))
            }
            Self::Kind { kind, follows } => {
                let kind = kind.name();
                let follows = follows.name();
                write!(formatter, "event is {kind:?}, but goals and attitudes make it {follows:?}")
            }
            Self::Degrees { body, angle } => {
                let field = field_name(body);
                let radians = angle.to_radians();
                write!(
                    formatter,
                    "{field}.start: the angle {angle} is in radians; {angle} degrees are {radians:.4} rad"
                )
            }
        }
    }
}

impl Scene {
    /// Suspicious properties of the scene: bodies that overlap each other or walls at the start, a kind of
    /// event that does not follow from goals and attitudes, angles that appear to be in degrees. Empty for
    /// most scenes. A scene with warnings can be simulated; violations that prevent a simulation are errors
    /// of [`Scene::validate`].
    #[must_use]
    pub fn warnings(&self) -> Vec<SceneWarning> {
        let physics = self.physics();
        let state = self.initial_state();
        let body = |entity: Entity| (entity, Outline::of(&physics, entity, state.body(entity)));
        let outlines: Vec<(Entity, Outline)> = physics.entities().map(body).collect();
        let mut warnings = Vec::new();
        for (k, &(first, outline)) in outlines.iter().enumerate() {
            for &(second, other) in &outlines[k + 1..] {
                if let Some(depth) = outline.depth(&other).filter(|&depth| depth > TOUCH) {
                    warnings.push(SceneWarning::Overlap { first, second, depth });
                }
            }
            let walls = physics.walls.iter().filter_map(|&wall| outline.depth_in_wall(wall));
            let depth = walls.chain(outline.depth_in_boundary()).fold(0.0, f32::max);
            if depth > TOUCH {
                warnings.push(SceneWarning::AcrossWall { body: first, depth });
            }
            let angle = state.body(first).angle;
            if angle.abs() > LARGEST_ANGLE {
                warnings.push(SceneWarning::Degrees { body: first, angle });
            }
        }
        let kind = self.kind;
        let follows = EventKind::of(self.goals(), self.attitudes());
        if kind != follows {
            warnings.push(SceneWarning::Kind { kind, follows });
        }
        warnings
    }
}

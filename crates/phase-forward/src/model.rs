//! The constants of a scene: walls, shapes, masses and forces.

use crate::{
    body::Shape,
    key::{BodyMask, KeySet, WALL_KEYS},
    wall::{MAX_WALLS, Wall, WallBoxes, walls},
};
use phase_model::{AGENT_COUNT, PhysicsConfig, Segment, Vec2};

/// The constants of one scene's dynamics, prepared for stepping.
///
/// At most two objects and four inner walls are used, which is all that PHASE has; more are ignored.
#[derive(Clone, Debug)]
pub(crate) struct Model {
    pub(crate) physics: PhysicsConfig,
    pub(crate) shapes: [Shape; 5],
    pub(crate) walls: [Wall; MAX_WALLS],
    pub(crate) wall_count: usize,
    pub(crate) boxes: WallBoxes,
    pub(crate) count: usize,
    /// Whether bodies collide with each other, and not with walls alone.
    pub(crate) collisions: bool,
}

impl Model {
    /// Prepares the dynamics of a scene.
    pub(crate) fn new(physics: &PhysicsConfig) -> Self {
        let mut shapes = [Shape::immovable(); 5];
        for (shape, agent) in shapes.iter_mut().zip(&physics.agents) {
            *shape = Shape::agent(agent);
        }
        for (shape, radius) in shapes[AGENT_COUNT..4].iter_mut().zip(physics.object_radii) {
            *shape = Shape::object(radius);
        }
        let (walls, wall_count) = walls(&physics.walls);
        let count = physics.entity_count().min(4);
        let boxes = WallBoxes::new(&walls[..wall_count]);
        Self { physics: physics.clone(), shapes, walls, wall_count, boxes, count, collisions: true }
    }

    /// Those of some pairs of shapes whose contacts are resisted.
    pub(crate) const fn resisting(&self, candidates: KeySet) -> KeySet {
        if self.collisions { candidates } else { candidates & WALL_KEYS }
    }

    /// Whether a straight path leads through no wall.
    pub(crate) fn is_free(&self, from: Vec2, to: Vec2) -> bool {
        let path = Segment { a: from, b: to };
        self.walls[..self.wall_count].iter().all(|wall| !path.crosses(Segment { a: wall.a, b: wall.b }))
    }

    /// All bodies of the scene.
    pub(crate) fn everyone(&self) -> BodyMask {
        (1 << self.count) - 1
    }
}

//! Walls: the arena's boundary, the inner walls, and the degenerate points at their ends.

use crate::constants::SKIN;
use phase_model::{Segment, Vec2, arena};

/// Maximum number of inner walls in a kernel; PHASE has at most four.
const MAX_INNER: usize = 4;
/// Pieces of the boundary: four sides and one degenerate point.
const BOUNDARY: usize = 5;
/// Maximum number of wall pieces: five for the boundary, two for every inner wall.
pub(crate) const MAX_WALLS: usize = BOUNDARY + 2 * MAX_INNER;

/// A straight piece of wall without thickness, or a single point if its ends coincide.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wall {
    pub(crate) a: Vec2,
    pub(crate) b: Vec2,
    /// Unit normal, to the right of the direction from `a` to `b`; zero for a point.
    pub(crate) normal: Vec2,
    /// Lower left corner of the box around it, skin included (u).
    pub(crate) min: Vec2,
    /// Upper right corner of the box around it, skin included (u).
    pub(crate) max: Vec2,
}

impl Wall {
    pub(crate) fn new(a: Vec2, b: Vec2) -> Self {
        let normal = -(b - a).perp().normalize_or_zero();
        let skin = Vec2::splat(SKIN);
        Self { a, b, normal, min: a.min(b) - skin, max: a.max(b) + skin }
    }

    /// Whether a point lies beside it, neither before its one end nor past its other.
    pub(crate) fn is_beside(&self, point: Vec2) -> bool {
        let along = self.b - self.a;
        along.dot(point - self.a) > 0.0 && along.dot(self.b - point) > 0.0
    }

    /// Whether it is a single point.
    #[inline]
    pub(crate) fn is_point(&self) -> bool {
        self.a == self.b
    }
}

/// A set of walls, one bit each.
pub(crate) type WallSet = u16;

/// Boxes that are tested together: a whole number of the processor's vectors.
const BOXES: usize = MAX_WALLS.next_multiple_of(4);

/// AABBs of all walls, skin included, as a structure of arrays, so that one box is tested against several at
/// once. Boxes of absent walls are empty.
#[derive(Clone, Debug)]
pub(crate) struct WallBoxes {
    min_x: [f32; BOXES],
    min_y: [f32; BOXES],
    max_x: [f32; BOXES],
    max_y: [f32; BOXES],
}

impl WallBoxes {
    pub(crate) fn new(walls: &[Wall]) -> Self {
        let coordinate =
            |of: fn(&Wall) -> f32, none: f32| core::array::from_fn(|wall| walls.get(wall).map_or(none, of));
        Self {
            min_x: coordinate(|wall| wall.min.x, f32::INFINITY),
            min_y: coordinate(|wall| wall.min.y, f32::INFINITY),
            max_x: coordinate(|wall| wall.max.x, f32::NEG_INFINITY),
            max_y: coordinate(|wall| wall.max.y, f32::NEG_INFINITY),
        }
    }

    /// The walls whose boxes come within a margin of a point, along both axes.
    #[inline]
    pub(crate) fn near_point(&self, point: Vec2, room: f32) -> WallSet {
        self.near(point - room, point + room)
    }

    /// The walls whose boxes overlap a box.
    #[inline]
    pub(crate) fn near(&self, min: Vec2, max: Vec2) -> WallSet {
        let mut near = 0;
        // Without branches, so that the compiler tests several boxes in one instruction.
        for wall in 0..BOXES {
            let overlaps = (self.min_x[wall] <= max.x)
                & (self.max_x[wall] >= min.x)
                & (self.min_y[wall] <= max.y)
                & (self.max_y[wall] >= min.y);
            near |= WallSet::from(overlaps) << wall;
        }
        near
    }
}

/// All pieces of wall, in the order in which the original creates them, and their number.
///
/// The original builds each chain of edges with a degenerate second edge, so there is a point contact at
/// the second corner of the boundary, (26, 22), and at the far end of each inner wall.
pub(crate) fn walls(inner: &[Segment]) -> ([Wall; MAX_WALLS], usize) {
    let min = arena::MIN;
    let max = arena::MAX;
    let corners = [Vec2::new(min.x, max.y), max, Vec2::new(max.x, min.y), min];
    let mut walls = [Wall::new(max, max); MAX_WALLS];
    walls[0] = Wall::new(corners[0], corners[1]);
    walls[2] = Wall::new(corners[1], corners[2]);
    walls[3] = Wall::new(corners[2], corners[3]);
    walls[4] = Wall::new(corners[3], corners[0]);
    let mut count = BOUNDARY;
    for segment in inner.iter().take(MAX_INNER) {
        walls[count] = Wall::new(segment.a, segment.b);
        walls[count + 1] = Wall::new(segment.b, segment.b);
        count += 2;
    }
    (walls, count)
}

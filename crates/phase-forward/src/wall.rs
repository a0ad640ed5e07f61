//! Walls: the arena's boundary, the inner walls, and the stray points at their ends.

use crate::tuning::SKIN;
use phase_model::{Segment, Vec2, arena};

/// Most inner walls a kernel holds; PHASE has at most four.
pub(crate) const MAX_INNER: usize = 4;
/// Most wall pieces: five for the boundary, two for every inner wall.
pub(crate) const MAX_WALLS: usize = 5 + 2 * MAX_INNER;

/// A straight piece of wall without thickness, or a single point if its ends coincide.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wall {
    pub(crate) a: Vec2,
    pub(crate) b: Vec2,
    /// Unit normal, to the right of the way from `a` to `b`; zero for a point.
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

    /// Whether it is just a point.
    #[inline]
    pub(crate) fn is_point(&self) -> bool {
        self.a == self.b
    }
}

/// All pieces of wall, in the order in which the original creates them, and their number.
///
/// The original builds each chain of edges with a degenerate second edge, so there is a point contact at
/// the second corner of the boundary, (26, 22), and at the far end of each inner wall.
pub(crate) fn walls(inner: &[Segment]) -> ([Wall; MAX_WALLS], usize) {
    let (min, max) = (arena::MIN, arena::MAX);
    let corners = [Vec2::new(min.x, max.y), max, Vec2::new(max.x, min.y), min];
    let mut walls = [Wall::new(max, max); MAX_WALLS];
    walls[0] = Wall::new(corners[0], corners[1]);
    walls[2] = Wall::new(corners[1], corners[2]);
    walls[3] = Wall::new(corners[2], corners[3]);
    walls[4] = Wall::new(corners[3], corners[0]);
    let mut count = 5;
    for segment in inner.iter().take(MAX_INNER) {
        walls[count] = Wall::new(segment.a, segment.b);
        walls[count + 1] = Wall::new(segment.b, segment.b);
        count += 2;
    }
    (walls, count)
}

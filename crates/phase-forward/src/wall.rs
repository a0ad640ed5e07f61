//! Walls: the arena's boundary, the inner walls, and the stray points at their ends.

use crate::{
    key::{KeySet, wall_key},
    tuning::SKIN,
};
use phase_model::{Segment, Vec2, arena};

/// Most inner walls a kernel holds; PHASE has at most four.
pub(crate) const MAX_INNER: usize = 4;
/// Pieces of the boundary: four sides and one stray point.
const BOUNDARY: usize = 5;
/// Most wall pieces: five for the boundary, two for every inner wall.
pub(crate) const MAX_WALLS: usize = BOUNDARY + 2 * MAX_INNER;

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

/// The boxes around all walls, coordinate by coordinate, so that one box is held against all at once.
/// Those of walls that are not there are empty.
#[derive(Clone, Debug)]
pub(crate) struct Boxes {
    min_x: [f32; MAX_WALLS],
    min_y: [f32; MAX_WALLS],
    max_x: [f32; MAX_WALLS],
    max_y: [f32; MAX_WALLS],
    /// The boxes around all upright and around all other inner walls.
    inner: [(Vec2, Vec2); 2],
}

impl Boxes {
    pub(crate) fn new(walls: &[Wall]) -> Self {
        let (most, least) = (f32::INFINITY, f32::NEG_INFINITY);
        let mut boxes = Self {
            min_x: [most; MAX_WALLS],
            min_y: [most; MAX_WALLS],
            max_x: [least; MAX_WALLS],
            max_y: [least; MAX_WALLS],
            inner: [(Vec2::splat(most), Vec2::splat(least)); 2],
        };
        for (k, wall) in walls.iter().enumerate().take(MAX_WALLS) {
            boxes.min_x[k] = wall.min.x;
            boxes.min_y[k] = wall.min.y;
            boxes.max_x[k] = wall.max.x;
            boxes.max_y[k] = wall.max.y;
            if k >= BOUNDARY {
                // A wall's end point goes with the wall before it.
                let whole = &walls[k - (k - BOUNDARY) % 2];
                let size = whole.max - whole.min;
                let (min, max) = &mut boxes.inner[usize::from(size.x > size.y)];
                *min = min.min(wall.min);
                *max = max.max(wall.max);
            }
        }
        boxes
    }

    /// The walls whose boxes overlap a box, as keys of body 0.
    #[inline]
    pub(crate) fn near(&self, min: Vec2, max: Vec2) -> KeySet {
        let inside = arena::MIN + SKIN;
        let outside = arena::MAX - SKIN;
        let amid = min.x > inside.x && min.y > inside.y && max.x < outside.x && max.y < outside.y;
        let clear =
            |(low, high): (Vec2, Vec2)| low.x > max.x || low.y > max.y || high.x < min.x || high.y < min.y;
        if amid && clear(self.inner[0]) && clear(self.inner[1]) {
            return 0;
        }
        let mut near = 0;
        for wall in 0..MAX_WALLS {
            let overlaps = (self.min_x[wall] <= max.x)
                & (self.max_x[wall] >= min.x)
                & (self.min_y[wall] <= max.y)
                & (self.max_y[wall] >= min.y);
            near |= KeySet::from(overlaps) << wall_key(wall, 0);
        }
        near
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
    let mut count = BOUNDARY;
    for segment in inner.iter().take(MAX_INNER) {
        walls[count] = Wall::new(segment.a, segment.b);
        walls[count + 1] = Wall::new(segment.b, segment.b);
        count += 2;
    }
    (walls, count)
}

//! Walls and rooms of one's own, in an arena of any size.

use crate::{
    Disc, Mover,
    accuracy::{CLEARANCE_TOLERANCE, RING_GAP},
    graph::{Graph, Ground, waypoint},
    visibility::{Bend, ring},
};
use phase_model::{Segment, Vec2};
use thiserror::Error;

/// A rectangular arena with straight walls anywhere in it.
///
/// A [`Map`](crate::Map) knows the 22 layouts of PHASE; a floor knows only its walls. Rooms are [`Area`]s, as
/// many as one likes.
///
/// ```
/// use phase_model::{Segment, Vec2};
/// use phase_navigation::{Area, Floor, FloorField, Mover};
///
/// // A hall of 12 u by 6 u; a wall cuts off a room on the right, with a door of 1 u at its upper end.
/// let wall = Segment { a: Vec2::new(8.0, 0.0), b: Vec2::new(8.0, 5.0) };
/// let floor = Floor::new(Vec2::ZERO, Vec2::new(12.0, 6.0), vec![wall])?;
/// let room = Area { min: Vec2::new(8.0, 0.0), max: Vec2::new(12.0, 6.0) };
///
/// let field = FloorField::new(&floor, room, Mover { half_width: 0.4 });
/// let end = field.path(Vec2::new(2.0, 1.0)).ok_or("no way")?.last();
/// assert!(end.is_some_and(|end| end.y > 5.3)); // in the door
/// let wide = FloorField::new(&floor, room, Mover { half_width: 0.6 });
/// assert_eq!(wide.distance(Vec2::new(2.0, 1.0)), None); // it does not fit
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Floor {
    min: Vec2,
    max: Vec2,
    /// The four sides, and the walls.
    barriers: Vec<Segment>,
}

/// Number of sides of a floor.
const SIDES: usize = 4;

/// An invalid floor.
#[derive(Clone, Copy, PartialEq, Debug, Error)]
#[non_exhaustive]
pub enum FloorError {
    /// A corner is not finite, or the upper right one is not to the right of and above the lower left one.
    #[error("`min` {min} and `max` {max} must be finite, and `max` greater in both coordinates")]
    Size {
        /// The lower left corner (u).
        min: Vec2,
        /// The upper right corner (u).
        max: Vec2,
    },
    /// An end of a wall is not finite or outside the floor.
    #[error("wall {index} must be finite and inside the floor, not from {} to {}", wall.a, wall.b)]
    Wall {
        /// The wall's place in the list, from 0.
        index: usize,
        /// The wall (u).
        wall: Segment,
    },
}

impl Floor {
    /// A floor between two corners, lower left and upper right (u), with walls of no thickness. Walls may
    /// touch and cross each other and the sides.
    ///
    /// # Errors
    /// [`FloorError`].
    pub fn new(min: Vec2, max: Vec2, walls: Vec<Segment>) -> Result<Self, FloorError> {
        if !(min.is_finite() && max.is_finite() && min.cmplt(max).all()) {
            return Err(FloorError::Size { min, max });
        }
        let is_inside = |point: Vec2| min.cmple(point).all() && point.cmple(max).all();
        let outside = walls.iter().position(|wall| !(is_inside(wall.a) && is_inside(wall.b)));
        if let Some(index) = outside {
            return Err(FloorError::Wall { index, wall: walls[index] });
        }
        let corners = [min, Vec2::new(max.x, min.y), max, Vec2::new(min.x, max.y)];
        let side = |k: usize| Segment { a: corners[k], b: corners[(k + 1) % SIDES] };
        Ok(Self { min, max, barriers: (0..SIDES).map(side).chain(walls).collect() })
    }

    /// The lower left corner (u).
    #[must_use]
    pub const fn min(&self) -> Vec2 {
        self.min
    }

    /// The upper right corner (u).
    #[must_use]
    pub const fn max(&self) -> Vec2 {
        self.max
    }

    /// The walls, without the sides (u).
    #[must_use]
    pub fn walls(&self) -> &[Segment] {
        &self.barriers[SIDES..]
    }

    /// The points at which paths of a mover may bend: around the ends of walls, and in gaps that it hardly
    /// fits through.
    fn bends(&self, half_width: f32) -> Vec<Bend> {
        let mut bends: Vec<Bend> = Vec::new();
        let mut push = |position: Vec2| {
            if self.is_free(position, half_width) && !bends.iter().any(|bend| bend.position == position) {
                bends.push(Bend { position, is_closed: false });
            }
        };
        for (k, wall) in self.barriers.iter().enumerate().skip(SIDES) {
            for end in [wall.a, wall.b] {
                ring(Disc { centre: end, radius: half_width }).for_each(&mut push);
                for other in self.barriers.iter().enumerate().filter(|&(other, _)| other != k) {
                    let across = other.1.nearest(end) - end;
                    let width = across.length();
                    // Where rings of both sides overlap the other side, the middle is free.
                    if width > 0.0 && width < 2.0 * (half_width * GAP_RATIO + RING_GAP) {
                        let along = across.perp() / width * half_width.max(RING_GAP);
                        let middle = end + 0.5 * across;
                        [middle - along, middle, middle + along].into_iter().for_each(&mut push);
                    }
                }
            }
        }
        bends
    }

    /// Whether a point is inside and a mover there touches no wall.
    fn is_free(&self, point: Vec2, half_width: f32) -> bool {
        let is_inside = self.min.cmple(point).all() && point.cmple(self.max).all();
        is_inside
            && self
                .barriers
                .iter()
                .all(|wall| wall.distance(point) >= (half_width - CLEARANCE_TOLERANCE).max(0.0))
    }
}

/// Width of a gap relative to a mover's below which the gap's middle is a bend of its own.
const GAP_RATIO: f32 = 1.1;

/// A rectangle to go to, such as a room; a point if both corners are equal.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Area {
    /// Lower left corner (u).
    pub min: Vec2,
    /// Upper right corner (u).
    pub max: Vec2,
}

impl From<Vec2> for Area {
    fn from(point: Vec2) -> Self {
        Self { min: point, max: point }
    }
}

/// Travel distances of a round body to an area of a [`Floor`].
///
/// Paths are straight legs between points around the ends of walls, found by Dijkstra's algorithm on the
/// visibility graph, as in a [`Field`](crate::Field). No path brings the body's centre nearer to a
/// wall than its half width, less 0.001 u for rounding; a gap that is narrower is closed. A body that
/// begins too near to a wall may move away from it or along it, and a target that is too near to one for the
/// body has no path to it. The time to make a field grows with the cube of the number of walls.
#[derive(Clone, Debug)]
pub struct FloorField {
    graph: Graph<Walls>,
}

/// A floor as one mover meets it, and the target.
#[derive(Clone, Debug)]
struct Walls {
    floor: Floor,
    half_width: f32,
    target: Area,
}

impl Ground for Walls {
    fn goal(&self, from: Vec2) -> Vec2 {
        // Not `clamp`, which panics where corners are in the wrong order.
        from.max(self.target.min).min(self.target.max)
    }

    fn leg(&self, a: Vec2, b: Vec2) -> Option<f32> {
        let leg = Segment { a, b };
        let is_clear = |wall: &Segment| {
            let at_start = wall.distance(a);
            let ends = leg.distance(wall.a).min(leg.distance(wall.b));
            let nearest = at_start.min(wall.distance(b)).min(ends);
            let needed = self.half_width.min(at_start) - CLEARANCE_TOLERANCE;
            !wall.crosses(leg) && nearest >= needed && nearest > 0.0
        };
        let is_open = self.floor.is_free(a, 0.0) && self.floor.is_free(b, 0.0);
        (is_open && self.floor.barriers.iter().all(is_clear)).then(|| a.distance(b))
    }

    fn only_leg(&self, a: Vec2, b: Vec2) -> Option<f32> {
        self.leg(a, b)
    }
}

impl FloorField {
    /// The field of an area, or of a point, for a round body.
    ///
    /// The last leg leads to the point of the area that is nearest as the crow flies; where walls are in the
    /// area, to the nearest one that can be seen. A half width that is negative or no number counts as 0. To
    /// an area whose corners are exchanged there is no way.
    #[must_use]
    pub fn new(floor: &Floor, target: impl Into<Area>, mover: Mover) -> Self {
        let half_width = mover.half_width.max(0.0);
        let ground = Walls { floor: floor.clone(), half_width, target: target.into() };
        Self { graph: Graph::new(ground, 0.0, floor.bends(half_width)) }
    }

    /// Length of the shortest path from a point to the target (u); `None` if there is no path, and outside
    /// the floor. Around the end of a wall, 16 points stand for the circle on which the body's centre moves,
    /// so that the length there exceeds that of the arc by up to 2 %, and by 0.01 u.
    #[must_use]
    pub fn distance(&self, from: Vec2) -> Option<f32> {
        Some(self.graph.way(from).cost).filter(|cost| cost.is_finite())
    }

    /// The bends of the shortest path from a point, and its end (u); `None` where there is no path.
    pub fn path(&self, from: Vec2) -> Option<impl Iterator<Item = Vec2>> {
        let way = self.graph.way(from);
        way.cost.is_finite().then(|| self.graph.path(from, way))
    }

    /// The point on the shortest path at a length from its start (u), or its end; `None` where there is no
    /// path.
    #[must_use]
    pub fn waypoint(&self, from: Vec2, ahead: f32) -> Option<Vec2> {
        self.path(from).map(|path| waypoint(from, path, ahead))
    }
}

//! The space occupied by bodies at their present poses, in each lane; see [`crate::outline`].

use super::{
    motion::Motions,
    real::{LaneSet, Real, Vector, at_least, at_most, lanes, mask, splat},
};
use crate::{body::Shape, model::Model, polygon::Polygon, wall::MAX_WALLS};
use phase_model::{AGENT_COUNT, Vec2};

/// For each wall, a set of lanes.
pub(crate) type WallLanes = [LaneSet; MAX_WALLS];

/// An agent's corners and side normals in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polygons {
    pub(crate) corners: [Vector; 4],
    pub(crate) normals: [Vector; 4],
}

impl Polygons {
    pub(crate) const NONE: Self = Self { corners: [Vector::ZERO; 4], normals: [Vector::ZERO; 4] };

    /// The outline of an agent with its centre of mass and its right side at some place and direction.
    #[inline]
    pub(crate) fn new(shape: &Shape, centre: Vector, right: Vector) -> Self {
        let turn = |local: Vec2| right.rotate(Vector::splat(local));
        let ([a, b, c, d], [e, f, g, h]) = (shape.corners, shape.normals);
        Self {
            corners: [centre + turn(a), centre + turn(b), centre + turn(c), centre + turn(d)],
            normals: [turn(e), turn(f), turn(g), turn(h)],
        }
    }

    /// Corners of the box around it, without skin (u).
    #[inline]
    pub(crate) fn bounds(&self) -> Boxes {
        let [a, b, c, d] = self.corners;
        (a.smaller(b).smaller(c).smaller(d), a.larger(b).larger(c).larger(d))
    }

    /// Stores outlines in the lanes of a mask.
    fn put(&mut self, mask: Real, polygons: &Self) {
        for k in 0..4 {
            self.corners[k].put(mask, polygons.corners[k]);
            self.normals[k].put(mask, polygons.normals[k]);
        }
    }

    /// The outline in one lane.
    pub(crate) fn get(&self, lane: usize) -> Polygon {
        Polygon {
            corners: self.corners.map(|corner| corner.get(lane)),
            normals: self.normals.map(|normal| normal.get(lane)),
        }
    }
}

/// An axis-aligned box in each lane: lower left and upper right corner (u).
pub(crate) type Boxes = (Vector, Vector);

/// Outlines of the bodies at the poses at which they were last updated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outlines {
    pub(crate) polygons: [Polygons; AGENT_COUNT],
    /// Boxes around the bodies. Those of agents are without skin.
    pub(crate) boxes: [Boxes; 4],
    /// For each body, the lanes in which it has moved since.
    stale: [LaneSet; 4],
}

impl Outlines {
    pub(crate) const NONE: Self = Self {
        polygons: [Polygons::NONE; AGENT_COUNT],
        boxes: [(Vector::ZERO, Vector::ZERO); 4],
        stale: [!0; 4],
    };

    /// Updates the outline of a body, which must be up to date in the given lanes afterwards.
    #[inline]
    pub(crate) fn update(&mut self, body: usize, set: LaneSet, model: &Model, motions: &[Motions; 4]) {
        let stale = self.stale[body] & set;
        if stale == 0 {
            return;
        }
        // In the other lanes the body may have turned by less than changes its angle, which does not count as a movement.
        let mask = mask(stale);
        let (shape, motion) = (&model.shapes[body], &motions[body]);
        let (min, max) = if body < AGENT_COUNT {
            let polygons = Polygons::new(shape, motion.centre, motion.right);
            self.polygons[body].put(mask, &polygons);
            polygons.bounds()
        } else {
            let radius = Vector::splat(Vec2::splat(shape.radius));
            (motion.centre - radius, motion.centre + radius)
        };
        self.boxes[body].0.put(mask, min);
        self.boxes[body].1.put(mask, max);
        self.stale[body] &= !stale;
    }

    /// Records that a body's pose has changed in some lanes.
    #[inline]
    pub(crate) fn moved(&mut self, body: usize, set: LaneSet) {
        self.stale[body] |= set;
    }
}

/// For each wall, the lanes among the given ones in which its box, skin included, overlaps a body's.
#[inline]
pub(crate) fn walls_near(model: &Model, among: &WallLanes, (min, max): Boxes) -> WallLanes {
    let mut near = [0; MAX_WALLS];
    for (index, wall) in model.walls[..model.wall_count].iter().enumerate() {
        if among[index] != 0 {
            let overlap = at_most(splat(wall.min.x), max.x)
                & at_least(splat(wall.max.x), min.x)
                & at_most(splat(wall.min.y), max.y)
                & at_least(splat(wall.max.y), min.y);
            near[index] = among[index] & lanes(overlap);
        }
    }
    near
}

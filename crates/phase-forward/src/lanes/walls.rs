//! What happens at walls in a substep, in each lane: most bodies near a wall do not reach it, and those that do are moved one
//! by one by the scalar kernel.

use super::{
    motion::turned_lanes,
    outline::{Polygons, WallLanes},
    reach,
    real::{LaneSet, Real, Vector, at_least, at_most, each, equal, get, greater, lanes, less, mask, splat},
    worlds::Worlds,
};
use crate::{
    constants::BOUNDARY_MARGIN,
    key::{KeySet, bit, wall_key},
    time_of_impact,
    wall::Wall,
};
use core::iter::once;
use phase_model::arena;

impl Worlds<'_> {
    /// Resolves the impacts of a body on walls in a substep of the exact kernel, in the given lanes.
    pub(crate) fn impacts(&mut self, body: usize, set: LaneSet, seconds: &Real) {
        let walls = reach::walls_swept(self, body, set);
        self.impacts_on(body, set, &walls, seconds);
        self.contain(body, set, &walls);
    }

    /// The same on some walls, after which the body may be beyond a wall. Returns the lanes in which there were any impacts.
    pub(crate) fn impacts_on(
        &mut self,
        body: usize,
        set: LaneSet,
        walls: &WallLanes,
        seconds: &Real,
    ) -> LaneSet {
        let mut left = self.reached(body, set, walls);
        let mut hit = 0;
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            // What moves alike in several lanes is moved once: often only one agent does different things in them.
            let alike = left & self.alike(body, lane, seconds) & same_walls(walls, lane);
            let keys = keys(walls, body, lane);
            let scratch = self.extract(once(body), lane);
            scratch.seconds = get(seconds, lane);
            if scratch.impacts(body, keys).is_some() {
                hit |= alike;
            }
            for lane in each(alike) {
                self.insert(once(body), lane);
            }
            left &= !(alike | 1 << lane);
        }
        hit
    }

    /// The lanes among the given ones in which a body may reach one of the walls on its path: no axis separates it from that wall
    /// at both ends of the path.
    pub(crate) fn reached(&self, body: usize, set: LaneSet, walls: &WallLanes) -> LaneSet {
        let near = walls.iter().fold(0, |all, near| all | near) & set;
        if near == 0 {
            return 0;
        }
        let (shape, start, motion) = (&self.model.shapes[body], &self.starts[body], &self.motions[body]);
        let clear = splat(time_of_impact::clearance(shape));
        let centres = [start.centre, motion.centre];
        let polygons = (shape.origin > 0.0).then(|| {
            // As the path is walked: from its start, at its start and at its end.
            let by = motion.angle - start.angle;
            let right = turned_lanes(near, start.right, by * splat(1.0));
            let still = equal(by * splat(1.0), Real::ZERO);
            let right = Vector::pick(still, start.right, right);
            let (zero, one) = (splat(0.0), splat(1.0));
            let at_start = start.centre * one + motion.centre * zero;
            let at_end = start.centre * zero + motion.centre * one;
            [Polygons::new(shape, at_start, start.right), Polygons::new(shape, at_end, right)]
        });
        let mut reached = 0;
        for (wall, &near) in self.model.walls.iter().zip(walls) {
            let near = near & set & !reached;
            if near != 0 {
                reached |= near & !lanes(clear_of(wall, &centres, polygons.as_ref(), clear));
            }
        }
        reached
    }

    /// The lanes in which a body has moved in this substep as it has in a given lane.
    fn alike(&self, body: usize, lane: usize, seconds: &Real) -> LaneSet {
        let (start, motion) = (&self.starts[body], &self.motions[body]);
        let numbers = [
            &start.centre.x,
            &start.centre.y,
            &start.angle,
            &start.right.x,
            &start.right.y,
            &motion.centre.x,
            &motion.centre.y,
            &motion.velocity.x,
            &motion.velocity.y,
            &motion.right.x,
            &motion.right.y,
            &motion.angle,
            &motion.spin,
            seconds,
        ];
        let same = |number: &Real| {
            let bits = get(number, lane).to_bits();
            number
                .as_array()
                .iter()
                .enumerate()
                .fold(0, |set, (other, number)| set | LaneSet::from(number.to_bits() == bits) << other)
        };
        numbers
            .into_iter()
            .fold(!0, |set, number| if set.is_power_of_two() { set } else { set & same(number) })
    }

    /// Moves a body back where its centre of mass has left the arena or crossed one of the walls; see [`crate::contain`]. Returns
    /// the lanes in which it may have been moved.
    pub(crate) fn contain(&mut self, body: usize, set: LaneSet, walls: &WallLanes) -> LaneSet {
        if set == 0 {
            return 0;
        }
        let (start, motion) = (self.starts[body].centre, self.motions[body]);
        let (min, max) = (arena::MIN + BOUNDARY_MARGIN, arena::MAX - BOUNDARY_MARGIN);
        let inside = |at: Real, min: f32, max: f32| at_least(at, splat(min)) & at_most(at, splat(max));
        let numbers = motion.velocity.x + motion.velocity.y + motion.spin;
        let mut fine = inside(motion.centre.x, min.x, max.x)
            & inside(motion.centre.y, min.y, max.y)
            & less(numbers.abs(), splat(f32::INFINITY));
        for (wall, &near) in self.model.walls.iter().zip(walls) {
            if near & set == 0 || wall.is_point() {
                continue;
            }
            let (normal, a) = (Vector::splat(wall.normal), Vector::splat(wall.a));
            let (before, after) = (normal.dot(start - a), normal.dot(motion.centre - a));
            fine &= greater(before * after, Real::ZERO) | !mask(near);
        }
        let unsure = set & !lanes(fine);
        for lane in each(unsure) {
            self.extract(once(body), lane).contain(body, keys(walls, body, lane));
            self.insert(once(body), lane);
        }
        unsure
    }
}

/// The lanes in which the same walls are to be looked at as in a given lane.
fn same_walls(walls: &WallLanes, lane: usize) -> LaneSet {
    walls.iter().fold(!0, |set, &near| set & if near & 1 << lane != 0 { near } else { !near })
}

/// The keys of a body with the walls that have a lane.
pub(crate) fn keys(walls: &WallLanes, body: usize, lane: usize) -> KeySet {
    let mut keys = 0;
    for (wall, &near) in walls.iter().enumerate() {
        if near & 1 << lane != 0 {
            keys |= bit(wall_key(wall, body));
        }
    }
    keys
}

/// The lanes in which some axis separates body and wall at both ends of the path; see
/// [`crate::time_of_impact::SweepEnds::clear_of`].
#[inline]
fn clear_of(wall: &Wall, centres: &[Vector; 2], polygons: Option<&[Polygons; 2]>, clear: Real) -> Real {
    let (normal, a, b) = (Vector::splat(wall.normal), Vector::splat(wall.a), Vector::splat(wall.b));
    let sides = centres.map(|centre| normal.dot(centre - a));
    let same = greater(sides[0] * sides[1], Real::ZERO);
    let Some(polygons) = polygons else {
        return same & greater(sides[0].abs(), clear) & greater(sides[1].abs(), clear);
    };
    let facing = Vector::pick(greater(sides[0], Real::ZERO), normal, -normal);
    let limit = facing.dot(a) + clear;
    let mut free = same;
    for polygon in polygons {
        for corner in polygon.corners {
            free &= greater(facing.dot(corner), limit);
        }
    }
    if lanes(free) == !0 {
        return free;
    }
    for side in 0..4 {
        let mut separate = splat(f32::from_bits(u32::MAX));
        for polygon in polygons {
            let normal = polygon.normals[side];
            let limit = normal.dot(polygon.corners[side]) + clear;
            separate &= greater(normal.dot(a), limit) & greater(normal.dot(b), limit);
        }
        free |= separate;
    }
    free
}

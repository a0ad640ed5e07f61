//! Routes along straight legs through doors, by which plans are costed.
//!
//! Rooms are convex, so the shortest path between two points is a sequence of doors with a crossing point in
//! each. The ways between rooms give the possible sequences; a few passes of coordinate descent place the
//! crossings. A route takes less than a microsecond where a [`Field`](crate::Field) takes tens, and knows
//! nothing of corners and obstacles.

use crate::{
    Gaps, Map,
    accuracy::{CROSSING_PASSES, PARALLEL},
    gaps::point_in,
    ways::Crossing,
};
use phase_model::{
    SlotId, Vec2, arena,
    layout::{DOOR_CLEARANCE, SLOT_DIRECTIONS, room_of},
};

/// Longest sequence of doors that visits no room twice.
const MAX_DOORS: usize = 3;

/// A route from one point to another.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Route {
    /// Length through the doors (u).
    pub length: f32,
    /// Number of doors on the route that the body does not fit through, 0 to 3.
    pub impassable: u8,
    /// Length with the price of each door that the body does not fit through (u).
    pub cost: f32,
    doors: [(SlotId, Vec2); MAX_DOORS],
    door_count: u8,
}

impl Route {
    /// The route between two points of a room.
    fn straight(from: Vec2, to: Vec2) -> Self {
        let length = from.distance(to);
        Self { length, impassable: 0, cost: length, doors: NO_DOORS, door_count: 0 }
    }

    /// The doors on the route, by slot, with the point at which each is crossed (u).
    #[must_use]
    pub fn doors(&self) -> &[(SlotId, Vec2)] {
        &self.doors[..usize::from(self.door_count)]
    }

    /// The point of this route, which leads between two ends, at some distance along it (u); the second end
    /// if the route is shorter.
    #[must_use]
    pub fn at(&self, from: Vec2, to: Vec2, mut distance: f32) -> Vec2 {
        let mut start = from;
        for end in self.doors().iter().map(|&(_, crossing)| crossing).chain([to]) {
            let length = start.distance(end);
            if distance < length {
                return start + (end - start) * (distance / length);
            }
            distance -= length;
            start = end;
        }
        to
    }

    /// The point of this route, which leads between two ends, that is closest to some point (u).
    #[must_use]
    pub fn nearest(&self, from: Vec2, to: Vec2, point: Vec2) -> Vec2 {
        let mut nearest = from;
        let mut start = from;
        for end in self.doors().iter().map(|&(_, crossing)| crossing).chain([to]) {
            let leg = end - start;
            let share = (point - start).dot(leg) / leg.length_squared().max(f32::MIN_POSITIVE);
            let foot = start + leg * share.clamp(0.0, 1.0);
            if foot.distance(point) < nearest.distance(point) {
                nearest = foot;
            }
            start = end;
        }
        nearest
    }
}

const NO_DOORS: [(SlotId, Vec2); MAX_DOORS] = [(SlotId::UP, Vec2::ZERO); MAX_DOORS];

impl Map {
    /// The cheapest route for a body of some width (u) through doors with these gaps; `None` if walls
    /// separate the two points completely.
    ///
    /// A door that is narrower than the body costs `impassable` (u) on top of the length, for example
    /// [`IMPASSABLE_COST`](crate::IMPASSABLE_COST).
    #[must_use]
    pub fn route(&self, from: Vec2, to: Vec2, width: f32, gaps: &Gaps, impassable: f32) -> Option<Route> {
        let here = room_of(from);
        let there = room_of(to);
        if here == there {
            return Some(Route::straight(from, to));
        }
        let mut best: Option<Route> = None;
        for way in self.ways(here, there) {
            let least = || self.lower_bound(way, from, to, width, gaps, impassable);
            if best.is_some_and(|best| least() >= best.cost) {
                continue;
            }
            let route = self.along(way, from, to, width, gaps, impassable);
            if best.is_none_or(|best| route.cost < best.cost) {
                best = Some(route);
            }
        }
        best
    }

    /// Cost of the cheapest route (u), see [`route`](Self::route). Where walls separate the two points: the
    /// straight distance and the price of three doors, so that it is always finite.
    #[must_use]
    pub fn route_cost(&self, from: Vec2, to: Vec2, width: f32, gaps: &Gaps, impassable: f32) -> f32 {
        self.route(from, to, width, gaps, impassable)
            .map_or_else(|| from.distance(to) + impassable * MAX_DOORS as f32, |route| route.cost)
    }

    /// A lower bound on the cost of a route (u), cheap to compute; of one through a single door only its
    /// price.
    fn lower_bound(
        &self,
        way: &[Crossing],
        from: Vec2,
        to: Vec2,
        width: f32,
        gaps: &Gaps,
        price: f32,
    ) -> f32 {
        let opening = |door: &Crossing| self.gaps().0[door.slot].unwrap_or((0.0, 0.0));
        let near = |door: &Crossing, point: Vec2| {
            let (low, high) = opening(door);
            let along = (point - arena::CENTRE).dot(SLOT_DIRECTIONS[door.slot]);
            point.distance(point_in(door.slot, along.max(low).min(high)))
        };
        // Doors that follow one another are at right angles.
        let between = |doors: &[Crossing]| Vec2::new(opening(&doors[0]).0, opening(&doors[1]).0).length();
        let length = match way {
            [first, .., last] => {
                near(first, from) + way.windows(2).map(between).sum::<f32>() + near(last, to)
            }
            _ => 0.0,
        };
        let impassable = way.iter().filter(|step| gaps.width(step.slot) < width).count();
        length + price * impassable as f32
    }

    fn along(&self, way: &[Crossing], from: Vec2, to: Vec2, width: f32, gaps: &Gaps, price: f32) -> Route {
        let mut doors = NO_DOORS;
        let mut ranges = [(0.0, 0.0); MAX_DOORS];
        let mut impassable = 0;
        for (k, &Crossing { slot, .. }) in way.iter().enumerate().take(MAX_DOORS) {
            let whole = self.gaps().0[slot].unwrap_or((0.0, 0.0));
            let gap = gaps.0[slot].unwrap_or(whole);
            if gaps.width(slot) < width {
                impassable += 1;
            }
            let margin = (0.5 * width + DOOR_CLEARANCE).min(0.5 * (gap.1 - gap.0));
            ranges[k] = (gap.0 + margin, gap.1 - margin);
            doors[k].0 = slot;
        }
        let count = way.len().min(MAX_DOORS);
        place_crossings(&mut doors[..count], &ranges[..count], from, to);
        let mut length = 0.0;
        let mut last = from;
        for &(_, point) in &doors[..count] {
            length += last.distance(point);
            last = point;
        }
        length += last.distance(to);
        let cost = length + price * f32::from(impassable);
        Route { length, impassable, cost, doors, door_count: count as u8 }
    }
}

/// Places the crossing point in each door, within its range, so that the route becomes short.
fn place_crossings(doors: &mut [(SlotId, Vec2)], ranges: &[(f32, f32)], from: Vec2, to: Vec2) {
    let count = doors.len();
    if count > 1 {
        for (door, range) in doors.iter_mut().zip(ranges) {
            door.1 = point_in(door.0, 0.5 * (range.0 + range.1));
        }
    }
    let passes = if count > 1 { CROSSING_PASSES } else { 1 };
    for _ in 0..passes {
        for k in 0..count {
            let before = if k == 0 { from } else { doors[k - 1].1 };
            let after = if k + 1 == count { to } else { doors[k + 1].1 };
            let slot = doors[k].0;
            // Not `clamp`: rounding may leave the ends of an interval of zero width in the wrong order.
            let (low, high) = ranges[k];
            doors[k].1 = point_in(slot, crossing(slot, before, after).max(low).min(high));
        }
    }
}

/// The distance from the centre at which the line between two points crosses the line of a slot (u); where it
/// runs parallel to it, the mean of both.
fn crossing(slot: SlotId, a: Vec2, b: Vec2) -> f32 {
    let direction = SLOT_DIRECTIONS[slot];
    let a = a - arena::CENTRE;
    let b = b - arena::CENTRE;
    let along_a = direction.dot(a);
    let along_b = direction.dot(b);
    let across_a = direction.perp_dot(a);
    let span = across_a - direction.perp_dot(b);
    if span.abs() < PARALLEL {
        return 0.5 * (along_a + along_b);
    }
    along_a + (along_b - along_a) * (across_a / span).clamp(0.0, 1.0)
}

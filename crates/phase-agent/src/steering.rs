//! Steering along a planned path through doors: remaining path length and next waypoint.

use crate::assembly::{CarriedAssembly, DoorApproach};
use phase_model::{SlotId, Vec2, arena, layout::SLOT_DIRECTIONS};
use phase_planner::{Route, Routes};

/// A door with less clearance than this is entered perpendicularly (u).
const TIGHT_DOOR_CLEARANCE: f32 = 1.2;
/// Distance before a tight door at which a body aligns with it (u).
const ALIGNMENT_DISTANCE: f32 = 1.8;
/// Distance from a door, and to its side, at which an agent waits for it to be free (u).
const WAITING_DISTANCE: f32 = 1.5;
/// Distances that differ by less than this count as equal (u).
const TIE_TOLERANCE: f32 = 0.25;
/// A body closer to a door's crossing than this occupies the door (u).
const DOOR_OCCUPIED_DISTANCE: f32 = 2.5;
/// Closer to a crossing than this, the waypoint lies past it (u).
const CROSSING_DISTANCE: f32 = 0.6;
/// Path cost of a door that the body does not fit through (u). The planner's own cost of such a door would
/// dominate all differences that the search has to resolve.
pub const IMPASSABLE_DOOR_COST: f32 = 10.0;
/// Distance past a room's border at which a body counts as inside (u).
const ROOM_ENTRY_DEPTH: f32 = 1.5;

/// Next waypoint and remaining path length.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Steering {
    /// The point to head for now (u).
    pub waypoint: Vec2,
    /// Length of the whole path (u), with [`IMPASSABLE_DOOR_COST`] for doors that the body does not fit
    /// through.
    pub remaining: f32,
}

/// The cheapest path between two points for a body of a given width, computed once and shared by all queries.
#[derive(Clone, Copy, Debug)]
pub struct PlannedPath<'a> {
    routes: &'a Routes,
    from: Vec2,
    to: Vec2,
    width: f32,
    route: Option<Route>,
    assembly: Option<CarriedAssembly>,
}

impl<'a> PlannedPath<'a> {
    /// Finds the path for a width (u), through doors as the layout has them.
    #[must_use]
    pub fn find(routes: &'a Routes, from: Vec2, to: Vec2, width: f32) -> Self {
        Self { routes, from, to, width, route: routes.best(from, to, width, routes.gaps()), assembly: None }
    }

    /// The same path, travelled by an object and its holders.
    #[must_use]
    pub const fn with_assembly(self, assembly: CarriedAssembly) -> Self {
        Self { assembly: Some(assembly), ..self }
    }

    /// Whether the body fits through every door on the path.
    #[must_use]
    pub fn fits(&self) -> bool {
        self.route.is_some_and(|route| route.impassable == 0)
    }

    /// Where the path crosses its first door, if the body does not fit through that.
    #[must_use]
    pub fn impassable_crossing(&self) -> Option<Vec2> {
        let &(slot, crossing) = self.route?.doors().first()?;
        (self.routes.gaps().width(slot) < self.width).then_some(crossing)
    }

    /// The steering where no door leads there at all.
    fn straight_line(&self) -> Steering {
        let remaining = self.routes.cost(self.from, self.to, self.width, self.routes.gaps());
        Steering { waypoint: self.to, remaining }
    }
}

/// Where to wait before the first door of a path: beside the door, clear of traffic through it.
fn wait(slot: SlotId, crossing: Vec2, from: Vec2, width: f32) -> Vec2 {
    let along = SLOT_DIRECTIONS[slot];
    let side = along.perp() * along.perp_dot(from - crossing).signum();
    // Towards the arena's centre there is always a wall to wait at.
    crossing + side * (0.5 * width + WAITING_DISTANCE) - along * WAITING_DISTANCE
}

/// A point beside a door, far enough from it that a body coming through does not collide.
fn passing_point(slot: SlotId, (low, high): (f32, f32), from: Vec2, width: f32) -> Vec2 {
    let along = SLOT_DIRECTIONS[slot];
    let side = along.perp() * along.perp_dot(from - arena::CENTRE).signum();
    let room = 0.5 * width + WAITING_DISTANCE;
    // Where there is more of the wall.
    let beside = if low > 0.5 * arena::SIDE - high { low - 0.5 * width } else { high + 0.5 * width };
    arena::CENTRE + along * beside + side * room
}

/// Yields to another body: if the other occupies the first door on the path and is closer to it, the steering
/// leads to a point beside that door instead. If both are equally close, the one that is `yields_ties` waits.
#[must_use]
pub fn yield_to(way: &PlannedPath<'_>, other: Vec2, yields_ties: bool) -> Option<Steering> {
    let PlannedPath { routes, from, width, route, .. } = *way;
    let route = route?;
    let &(slot, crossing) = route.doors().first()?;
    let (mine, theirs) = (from.distance(crossing), other.distance(crossing));
    let is_taken = theirs < DOOR_OCCUPIED_DISTANCE
        && theirs < if yields_ties { mine + TIE_TOLERANCE } else { mine - TIE_TOLERANCE }
        && routes.gaps().width(slot) < 2.0 * width + TIGHT_DOOR_CLEARANCE;
    is_taken.then(|| {
        let place = passing_point(slot, routes.gaps().0[slot].unwrap_or_default(), from, width);
        // Measured via that point, so that every step towards it reduces the distance.
        let by_way = from.distance(place) + place.distance(crossing);
        Steering { waypoint: place, remaining: route.length - mine + by_way }
    })
}

/// Local obstacle avoidance: if the straight line to the waypoint intersects one of these discs (centre, radius;
/// u), the waypoint moves to the nearer side of the disc, or to the other side if that one lies outside the
/// arena.
#[must_use]
pub fn avoid_discs(steering: Steering, from: Vec2, discs: impl Iterator<Item = (Vec2, f32)>) -> Steering {
    let way = steering.waypoint - from;
    let length = way.length();
    let Some(direction) = way.try_normalize() else { return steering };
    let mut nearest: Option<(f32, Vec2, f32)> = None;
    for (centre, radius) in discs {
        let offset = centre - from;
        let along = offset.dot(direction);
        // A body that touches the disc already must not be sent back through it.
        let hits = along > 0.0 && along < length && direction.perp_dot(offset).abs() < radius;
        if hits && nearest.is_none_or(|(first, ..)| along < first) {
            nearest = Some((along, centre, radius));
        }
    }
    let Some((along, centre, radius)) = nearest else { return steering };
    let left = direction.perp();
    let side = if left.dot(centre - from) > 0.0 { -1.0 } else { 1.0 };
    let inside = |point: Vec2| arena::contains(point - Vec2::ONE) && arena::contains(point + Vec2::ONE);
    let past = |side: f32| from + direction * along + left * (side * radius + left.dot(centre - from));
    let corner = if inside(past(side)) { past(side) } else { past(-side) };
    let detour = from.distance(corner) + corner.distance(steering.waypoint) - length;
    Steering { waypoint: corner, remaining: steering.remaining + detour }
}

/// The steering along a route to its end.
#[must_use]
pub fn to_point(way: &PlannedPath<'_>) -> Steering {
    let PlannedPath { routes, from, to, width, route, .. } = *way;
    let gaps = routes.gaps();
    let Some(route) = route else { return way.straight_line() };
    let Some(&(slot, crossing)) = route.doors().first() else {
        return Steering { waypoint: to, remaining: left(&route) };
    };
    if gaps.width(slot) < width {
        // The body does not fit, so it waits before the door instead of getting stuck in it.
        let place = wait(slot, crossing, from, width);
        return Steering { waypoint: place, remaining: IMPASSABLE_DOOR_COST + from.distance(place) };
    }
    let (waypoint, detour) = through(way, slot, crossing);
    Steering { waypoint, remaining: left(&route) + detour }
}

/// The steering along a route to a room's centre, but only just past the room's border.
#[must_use]
pub fn into_room(way: &PlannedPath<'_>) -> Steering {
    let PlannedPath { routes, from, to: centre, width, route, .. } = *way;
    let gaps = routes.gaps();
    let Some(route) = route else { return way.straight_line() };
    let (Some(&(slot, crossing)), Some(&(_, last))) = (route.doors().first(), route.doors().last()) else {
        return Steering { waypoint: from, remaining: 0.0 };
    };
    if gaps.width(slot) < width {
        let place = wait(slot, crossing, from, width);
        return Steering { waypoint: place, remaining: IMPASSABLE_DOOR_COST + from.distance(place) };
    }
    let (mut waypoint, detour) = through(way, slot, crossing);
    if route.doors().len() == 1 && waypoint == crossing {
        waypoint += (crossing - from).normalize_or_zero() * ROOM_ENTRY_DEPTH;
    }
    let remaining = (left(&route) - last.distance(centre) + detour).max(0.0) + ROOM_ENTRY_DEPTH;
    Steering { waypoint, remaining }
}

/// Remaining length of a route (u).
fn left(route: &Route) -> f32 {
    route.length + IMPASSABLE_DOOR_COST * f32::from(route.impassable)
}

/// The point to head for before a door, and the additional length compared with the straight line to the
/// crossing (u).
fn through(way: &PlannedPath<'_>, slot: SlotId, crossing: Vec2) -> (Vec2, f32) {
    let PlannedPath { routes, from, width, assembly, .. } = *way;
    let gaps = routes.gaps();
    let door_approach =
        assembly.zip(gaps.0[slot]).and_then(|(assembly, gap)| assembly.door_approach(slot, gap));
    if let Some(DoorApproach { waypoint, remaining }) = door_approach {
        return (waypoint, remaining - from.distance(crossing));
    }
    let along = SLOT_DIRECTIONS[slot];
    let offset = from - crossing;
    let lateral = along.dot(offset).abs();
    let across = along.perp_dot(offset);
    let straight = offset.length();
    if gaps.width(slot) > width + TIGHT_DOOR_CLEARANCE {
        // At the crossing itself the direction is undefined, so the waypoint lies past it.
        let on = crossing - along.perp() * across.signum();
        return (if straight < CROSSING_DISTANCE { on } else { crossing }, 0.0);
    }
    if across.abs() <= ALIGNMENT_DISTANCE {
        // Beside the door, correct the lateral offset first; directly before it, proceed through.
        let on = crossing - along.perp() * across.signum();
        return (if lateral < 0.5 { on } else { crossing }, lateral + across.abs() - straight);
    }
    let line_up = crossing + along.perp() * ALIGNMENT_DISTANCE * across.signum();
    (line_up, from.distance(line_up) + ALIGNMENT_DISTANCE - straight)
}

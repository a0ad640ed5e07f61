//! From a point to another through doors: how far it still is, and which way to move now.

use crate::convoy::{Convoy, Entrance};
use phase_model::{SlotId, Vec2, arena, layout::SLOT_DIRECTIONS};
use phase_planner::{Route, Routes};

/// A door with less room to spare than this is entered straight on (u).
const TIGHT: f32 = 1.2;
/// Distance before a tight door at which a body lines up with it (u).
const LINE_UP: f32 = 1.8;
/// Distance from a door, and to its side, at which one waits for it to be free (u).
const WAITING_ROOM: f32 = 1.5;
/// Two that are this much nearer or farther count as equally near (u).
const AS_NEAR: f32 = 0.25;
/// A body nearer to a door's crossing than this takes the door (u).
const DOORWAY: f32 = 2.5;
/// Nearer to a crossing than this one heads for what lies past it (u).
const AT_CROSSING: f32 = 0.6;
/// What a door that the body does not fit through adds to a way (u): that it is there cannot be helped, and the
/// planner's cost of it would drown all that a search can tell apart.
pub const BARRED: f32 = 10.0;
/// How far beyond a room's border counts as being in it (u).
const INSIDE: f32 = 1.5;

/// What is left of a way, and where to head.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Course {
    /// The point to head for now (u).
    pub heading_for: Vec2,
    /// Length of the whole way (u), with [`BARRED`] for doors that the body does not fit through.
    pub remaining: f32,
}

/// The best way between two points for a body of some width: found once, for all that asks about it.
#[derive(Clone, Copy, Debug)]
pub struct Way<'a> {
    routes: &'a Routes,
    from: Vec2,
    to: Vec2,
    width: f32,
    route: Option<Route>,
    convoy: Option<Convoy>,
}

impl<'a> Way<'a> {
    /// Finds the way for a width (u), through doors as the layout has them.
    #[must_use]
    pub fn find(routes: &'a Routes, from: Vec2, to: Vec2, width: f32) -> Self {
        Self { routes, from, to, width, route: routes.best(from, to, width, routes.gaps()), convoy: None }
    }

    /// The same way, gone by an object and its holders.
    #[must_use]
    pub const fn with_convoy(self, convoy: Convoy) -> Self {
        Self { convoy: Some(convoy), ..self }
    }

    /// Whether the body fits through every door on the way.
    #[must_use]
    pub fn fits(&self) -> bool {
        self.route.is_some_and(|route| route.impassable == 0)
    }

    /// Where the way crosses its first door, if the body does not fit through that.
    #[must_use]
    pub fn barred(&self) -> Option<Vec2> {
        let &(slot, crossing) = self.route?.doors().first()?;
        (self.routes.gaps().width(slot) < self.width).then_some(crossing)
    }

    /// The course where no door leads there at all.
    fn blind(&self) -> Course {
        let remaining = self.routes.cost(self.from, self.to, self.width, self.routes.gaps());
        Course { heading_for: self.to, remaining }
    }
}

/// What is left of a way when one has to wait before its first door: a place beside the door, out of the way of
/// who comes through.
fn wait(slot: SlotId, crossing: Vec2, from: Vec2, width: f32) -> Vec2 {
    let along = SLOT_DIRECTIONS[slot];
    let side = along.perp() * along.perp_dot(from - crossing).signum();
    // Towards the arena's centre there is always a wall to wait at.
    crossing + side * (0.5 * width + WAITING_ROOM) - along * WAITING_ROOM
}

/// A place before the wall beside a door, so far from it that who comes through need not push one aside.
fn let_by(slot: SlotId, (low, high): (f32, f32), from: Vec2, width: f32) -> Vec2 {
    let along = SLOT_DIRECTIONS[slot];
    let side = along.perp() * along.perp_dot(from - arena::CENTRE).signum();
    let room = 0.5 * width + WAITING_ROOM;
    // Where there is more of the wall.
    let beside = if low > 0.5 * arena::SIDE - high { low - 0.5 * width } else { high + 0.5 * width };
    arena::CENTRE + along * beside + side * room
}

/// Lets another body through first: if the other is in the first door on the way, and nearer to it, the course
/// leads to a place beside that door instead. Of two that are as near, the one that is `polite` waits.
#[must_use]
pub fn give_way(way: &Way<'_>, other: Vec2, polite: bool) -> Option<Course> {
    let Way { routes, from, width, route, .. } = *way;
    let route = route?;
    let &(slot, crossing) = route.doors().first()?;
    let (mine, theirs) = (from.distance(crossing), other.distance(crossing));
    let is_taken = theirs < DOORWAY
        && theirs < if polite { mine + AS_NEAR } else { mine - AS_NEAR }
        && routes.gaps().width(slot) < 2.0 * width + TIGHT;
    is_taken.then(|| {
        let place = let_by(slot, routes.gaps().0[slot].unwrap_or_default(), from, width);
        // By way of that place, so that every step towards it gains.
        let by_way = from.distance(place) + place.distance(crossing);
        Course { heading_for: place, remaining: route.length - mine + by_way }
    })
}

/// Goes round bodies in the way: if the straight line to the point that a course heads for passes through one of
/// these discs (centre, radius; u), the course is bent past the disc's nearer side, or the other if that side
/// is outside the arena.
#[must_use]
pub fn around(course: Course, from: Vec2, discs: impl Iterator<Item = (Vec2, f32)>) -> Course {
    let way = course.heading_for - from;
    let length = way.length();
    let Some(direction) = way.try_normalize() else { return course };
    let mut nearest: Option<(f32, Vec2, f32)> = None;
    for (centre, radius) in discs {
        let offset = centre - from;
        let along = offset.dot(direction);
        // Whoever touches the disc already must not be sent back through it.
        let hits = along > 0.0 && along < length && direction.perp_dot(offset).abs() < radius;
        if hits && nearest.is_none_or(|(first, ..)| along < first) {
            nearest = Some((along, centre, radius));
        }
    }
    let Some((along, centre, radius)) = nearest else { return course };
    let left = direction.perp();
    let side = if left.dot(centre - from) > 0.0 { -1.0 } else { 1.0 };
    let inside = |point: Vec2| arena::contains(point - Vec2::ONE) && arena::contains(point + Vec2::ONE);
    let past = |side: f32| from + direction * along + left * (side * radius + left.dot(centre - from));
    let corner = if inside(past(side)) { past(side) } else { past(-side) };
    let detour = from.distance(corner) + corner.distance(course.heading_for) - length;
    Course { heading_for: corner, remaining: course.remaining + detour }
}

/// The course along a way to its end.
#[must_use]
pub fn to_point(way: &Way<'_>) -> Course {
    let Way { routes, from, to, width, route, .. } = *way;
    let gaps = routes.gaps();
    let Some(route) = route else { return way.blind() };
    let Some(&(slot, crossing)) = route.doors().first() else {
        return Course { heading_for: to, remaining: left(&route) };
    };
    if gaps.width(slot) < width {
        // It does not fit: it waits before the door instead of getting stuck in it.
        let place = wait(slot, crossing, from, width);
        return Course { heading_for: place, remaining: BARRED + from.distance(place) };
    }
    let (heading_for, detour) = through(way, slot, crossing);
    Course { heading_for, remaining: left(&route) + detour }
}

/// The course along a way to a room's centre, but only just past the room's border.
#[must_use]
pub fn into_room(way: &Way<'_>) -> Course {
    let Way { routes, from, to: centre, width, route, .. } = *way;
    let gaps = routes.gaps();
    let Some(route) = route else { return way.blind() };
    let (Some(&(slot, crossing)), Some(&(_, last))) = (route.doors().first(), route.doors().last()) else {
        return Course { heading_for: from, remaining: 0.0 };
    };
    if gaps.width(slot) < width {
        let place = wait(slot, crossing, from, width);
        return Course { heading_for: place, remaining: BARRED + from.distance(place) };
    }
    let (mut heading_for, detour) = through(way, slot, crossing);
    if route.doors().len() == 1 && heading_for == crossing {
        heading_for += (crossing - from).normalize_or_zero() * INSIDE;
    }
    let remaining = (left(&route) - last.distance(centre) + detour).max(0.0) + INSIDE;
    Course { heading_for, remaining }
}

/// What is left of a route (u).
fn left(route: &Route) -> f32 {
    route.length + BARRED * f32::from(route.impassable)
}

/// The point to head for before a door, and how much longer than the straight way to the crossing that is (u).
fn through(way: &Way<'_>, slot: SlotId, crossing: Vec2) -> (Vec2, f32) {
    let Way { routes, from, width, convoy, .. } = *way;
    let gaps = routes.gaps();
    let entrance = convoy.zip(gaps.0[slot]).and_then(|(convoy, gap)| convoy.entrance(slot, gap));
    if let Some(Entrance { heading_for, remaining }) = entrance {
        return (heading_for, remaining - from.distance(crossing));
    }
    let along = SLOT_DIRECTIONS[slot];
    let offset = from - crossing;
    let lateral = along.dot(offset).abs();
    let across = along.perp_dot(offset);
    let straight = offset.length();
    if gaps.width(slot) > width + TIGHT {
        // At the crossing itself there is no direction any more: on, and past it.
        let on = crossing - along.perp() * across.signum();
        return (if straight < AT_CROSSING { on } else { crossing }, 0.0);
    }
    if across.abs() <= LINE_UP {
        // Beside the door already: sideways first, then on; just before it, on and through.
        let on = crossing - along.perp() * across.signum();
        return (if lateral < 0.5 { on } else { crossing }, lateral + across.abs() - straight);
    }
    let line_up = crossing + along.perp() * LINE_UP * across.signum();
    (line_up, from.distance(line_up) + LINE_UP - straight)
}

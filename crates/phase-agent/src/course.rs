//! From a point to another through doors: how far it still is, and which way to move now.

use phase_model::{Vec2, arena, layout::SLOT_DIRECTIONS};
use phase_planner::{Gaps, Routes, routes::IMPASSABLE_COST};

/// A door with less room to spare than this is entered straight on (u).
const TIGHT: f32 = 1.2;
/// Distance before a tight door at which a body lines up with it (u).
const LINE_UP: f32 = 1.8;
/// Distance from a door, and to its side, at which one waits for it to be free (u).
const WAITING_ROOM: f32 = 1.5;
/// A body nearer to a door's crossing than this takes the door (u).
const DOORWAY: f32 = 2.5;
/// How far beyond a room's border counts as being in it (u).
const INSIDE: f32 = 1.5;

/// What is left of a way, and where to head.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Course {
    /// The point to head for now (u).
    pub heading_for: Vec2,
    /// Length of the whole way (u), with penalties for doors that the body does not fit through.
    pub remaining: f32,
}

/// What is left of a way when one has to wait before its first door: a place beside the door, out of the way of
/// who comes through.
fn wait(slot: usize, crossing: Vec2, from: Vec2, width: f32) -> Vec2 {
    let along = SLOT_DIRECTIONS[slot];
    let side = along.perp() * along.perp_dot(from - crossing).signum();
    // Towards the arena's centre there is always a wall to wait at.
    crossing + side * (0.5 * width + WAITING_ROOM) - along * WAITING_ROOM
}

/// Lets another body through first: if the other is in the first door on the way, and nearer to it, the course
/// leads to a place beside that door instead.
#[must_use]
pub fn give_way(routes: &Routes, from: Vec2, to: Vec2, width: f32, other: Vec2) -> Option<Course> {
    let route = routes.best(from, to, width, routes.gaps())?;
    let &(slot, crossing) = route.doors().first()?;
    let slot = usize::from(slot);
    let (mine, theirs) = (from.distance(crossing), other.distance(crossing));
    let is_taken = theirs < DOORWAY
        && theirs < mine
        && mine < 2.0 * DOORWAY
        && routes.gaps().width(slot) < 2.0 * width + TIGHT;
    is_taken.then(|| {
        let place = wait(slot, crossing, from, width);
        Course { heading_for: place, remaining: route.length + from.distance(place) }
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

/// The way to a point for a body of some width (u).
#[must_use]
pub fn to_point(routes: &Routes, from: Vec2, to: Vec2, width: f32) -> Course {
    let gaps = routes.gaps();
    let Some(route) = routes.best(from, to, width, gaps) else {
        return Course { heading_for: to, remaining: routes.cost(from, to, width, gaps) };
    };
    let Some(&(slot, crossing)) = route.doors().first() else {
        return Course { heading_for: to, remaining: route.cost() };
    };
    if gaps.width(usize::from(slot)) < width {
        // It does not fit: it waits before the door instead of getting stuck in it.
        let place = wait(usize::from(slot), crossing, from, width);
        return Course { heading_for: place, remaining: IMPASSABLE_COST + from.distance(place) };
    }
    let (heading_for, detour) = through(gaps, usize::from(slot), crossing, from, width);
    Course { heading_for, remaining: route.cost() + detour }
}

/// The way into a room, just past its border.
#[must_use]
pub fn into_room(routes: &Routes, from: Vec2, room: usize, width: f32) -> Course {
    let centre = arena::LANDMARKS[room];
    let gaps = routes.gaps();
    let Some(route) = routes.best(from, centre, width, gaps) else {
        return Course { heading_for: centre, remaining: routes.cost(from, centre, width, gaps) };
    };
    let (Some(&(slot, crossing)), Some(&(_, last))) = (route.doors().first(), route.doors().last()) else {
        return Course { heading_for: from, remaining: 0.0 };
    };
    if gaps.width(usize::from(slot)) < width {
        let place = wait(usize::from(slot), crossing, from, width);
        return Course { heading_for: place, remaining: IMPASSABLE_COST + from.distance(place) };
    }
    let (mut heading_for, detour) = through(gaps, usize::from(slot), crossing, from, width);
    if route.doors().len() == 1 && heading_for == crossing {
        heading_for += (crossing - from).normalize_or_zero() * INSIDE;
    }
    let remaining = (route.cost() - last.distance(centre) + detour).max(0.0) + INSIDE;
    Course { heading_for, remaining }
}

/// The point to head for before a door, and how much longer than the straight way to the crossing that is (u).
fn through(gaps: &Gaps, slot: usize, crossing: Vec2, from: Vec2, width: f32) -> (Vec2, f32) {
    if gaps.width(slot) > width + TIGHT {
        return (crossing, 0.0);
    }
    let along = SLOT_DIRECTIONS[slot];
    let offset = from - crossing;
    let lateral = along.dot(offset).abs();
    let across = along.perp_dot(offset);
    let straight = offset.length();
    if across.abs() <= LINE_UP {
        // Beside the door already: sideways first, then on; just before it, on and through.
        let on = crossing - along.perp() * across.signum();
        return (if lateral < 0.5 { on } else { crossing }, lateral + across.abs() - straight);
    }
    let line_up = crossing + along.perp() * LINE_UP * across.signum();
    (line_up, from.distance(line_up) + LINE_UP - straight)
}

//! Contacts of two shapes of each kind, in each lane; see [`crate::collide`].

use super::{
    manifold::Manifolds,
    motion::Motions,
    outline::Polygons,
    real::{
        LaneSet, Real, Vector, at_least, at_most, each, equal, greater, lanes, less, pick, smaller, splat,
    },
    worlds::Worlds,
};
use crate::{
    body::{STATIC, Shape},
    collide::{self, REFERENCE_BIAS, TIE_TOLERANCE},
    constants::SKIN,
    key::PAIRS,
    wall::Wall,
};
use phase_model::AGENT_COUNT;

impl Worlds<'_> {
    /// The contact of a wall and a body, in the given lanes.
    #[inline]
    pub(crate) fn collide_wall(&self, wall: usize, body: usize, set: LaneSet) -> Manifolds {
        let (wall, shapes) = (&self.model.walls[wall], &self.model.shapes);
        if body < AGENT_COUNT {
            wall_agent(wall, &self.motions[body], &self.outlines.polygons[body], set)
        } else {
            wall_disc(wall, &self.motions[body], shapes[STATIC].skin + shapes[body].skin, set)
        }
    }

    /// The contact of a pair of bodies, in the given lanes.
    pub(crate) fn collide_pair(&self, pair: usize, set: LaneSet) -> Manifolds {
        let (a, b) = PAIRS[pair];
        let (motions, shapes) = (&self.motions, &self.model.shapes);
        let skins = shapes[a].skin + shapes[b].skin;
        if b < AGENT_COUNT {
            // Rare, and full of decisions.
            let mut manifolds = Manifolds::NONE;
            for lane in each(set) {
                let polygons = [0, 1].map(|agent| self.outlines.polygons[agent].get(lane));
                let motions = [0, 1].map(|agent| self.motions[agent].get(lane));
                let manifold = collide::agents((&motions[0], &polygons[0]), (&motions[1], &polygons[1]));
                manifolds.set(lane, &manifold);
            }
            manifolds
        } else if a < AGENT_COUNT {
            let skins = splat(skins) - self.tolerated_overlap(pair);
            agent_disc(&shapes[a], &motions[a], &motions[b], skins, set)
        } else {
            let distance = motions[a].centre.distance_squared(motions[b].centre);
            let live = set & !lanes(greater(distance, splat(skins * skins)));
            Manifolds { live, points_only: live, ..Manifolds::NONE }
        }
    }
}

/// Contact of an agent (first) and a disc (second).
fn agent_disc(shape: &Shape, agent: &Motions, disc: &Motions, skins: Real, set: LaneSet) -> Manifolds {
    let centre = agent.local_vector(disc.centre - agent.centre);
    let mut apart = Real::ZERO;
    let mut gap = splat(f32::MIN);
    let (mut normal, mut from, mut to) = (Vector::ZERO, Vector::ZERO, Vector::ZERO);
    for k in 0..4 {
        let corner = Vector::splat(shape.corners[k]);
        let facing = Vector::splat(shape.normals[k]);
        let along = facing.dot(centre - corner);
        apart |= greater(along, skins);
        let nearer = greater(along, gap + splat(TIE_TOLERANCE));
        gap = pick(nearer, along, gap);
        normal.put(nearer, facing);
        from.put(nearer, corner);
        to.put(nearer, Vector::splat(shape.corners[(k + 1) % 4]));
    }
    let mut live = set & !lanes(apart);
    if live == 0 {
        return Manifolds::NONE;
    }
    let mut anchor = (from + to) * splat(0.5);
    let outside = !less(gap, splat(f32::EPSILON));
    let at_from = outside & at_most((centre - from).dot(to - from), Real::ZERO);
    let at_to = outside & !at_from & at_most((centre - to).dot(from - to), Real::ZERO);
    let at_corner = at_from | at_to;
    if lanes(at_corner) & live != 0 {
        let corner = Vector::pick(at_from, from, to);
        let far = at_corner & greater(centre.distance_squared(corner), skins * skins);
        live &= !lanes(far);
        normal.put(at_corner, (centre - corner).normalize_or(Vector::ZERO));
        anchor.put(at_corner, corner);
    }
    Manifolds { live, normal, anchor, ..Manifolds::NONE }
}

/// Contact of a wall (first) and a disc (second).
fn wall_disc(wall: &Wall, disc: &Motions, skins: f32, set: LaneSet) -> Manifolds {
    let (a, b) = (Vector::splat(wall.a), Vector::splat(wall.b));
    let along = Vector::splat(wall.b - wall.a);
    let (to_b, from_a) = (along.dot(b - disc.centre), along.dot(disc.centre - a));
    let at_a = at_most(from_a, Real::ZERO);
    let at_b = !at_a & at_most(to_b, Real::ZERO);
    let at_end = at_a | at_b;
    let end = Vector::pick(at_b, b, a);
    let far = greater(disc.centre.distance_squared(end), splat(skins * skins));
    let face = Vector::splat(wall.normal);
    let away = face.dot(disc.centre - a);
    let beyond = greater(away.abs(), splat(skins));
    let mut behind = less(away, Real::ZERO);
    if wall.normal.x > 0.0 {
        behind |= equal(away, Real::ZERO);
    }
    let live = set & !lanes(pick(at_end, far, beyond));
    let points_only = live & lanes(at_end);
    let normal = Vector::pick(at_end, Vector::ZERO, Vector::pick(behind, -face, face));
    Manifolds { live, points_only, normal, anchor: end, ..Manifolds::NONE }
}

/// Contact of a wall (first) and an agent (second).
#[inline]
fn wall_agent(wall: &Wall, agent: &Motions, polygon: &Polygons, set: LaneSet) -> Manifolds {
    const SKINS: f32 = 2.0 * SKIN;
    let (a, b) = (Vector::splat(wall.a), Vector::splat(wall.b));
    let forward = Vector::splat(wall.normal);
    let front = at_least(forward.dot(agent.centre - a), Real::ZERO);
    let wall_normal = Vector::pick(front, forward, -forward);
    let reach = wall_normal.dot(a);
    let mut gap = splat(f32::MAX);
    for corner in polygon.corners {
        gap = smaller(gap, wall_normal.dot(corner) - reach);
    }
    let mut apart = greater(gap, splat(SKINS));
    if set & !lanes(apart) == 0 {
        return Manifolds::NONE;
    }
    let (mut side, mut side_gap) = (Real::ZERO, splat(f32::MIN));
    let (mut side_normal, mut from, mut to) = (Vector::ZERO, Vector::ZERO, Vector::ZERO);
    for k in 0..4 {
        let (normal, corner) = (polygon.normals[k], polygon.corners[k]);
        let separation = smaller(normal.dot(a - corner), normal.dot(b - corner));
        apart |= greater(separation, splat(SKINS));
        let wider = greater(separation, side_gap);
        side_gap = pick(wider, separation, side_gap);
        side = pick(wider, splat(k as f32), side);
        side_normal.put(wider, normal);
        from.put(wider, corner);
        to.put(wider, polygon.corners[(k + 1) % 4]);
    }
    let live = set & !lanes(apart);
    if live == 0 {
        return Manifolds::NONE;
    }
    let by_side = greater(side_gap, splat(REFERENCE_BIAS.0) * gap + splat(REFERENCE_BIAS.1));
    // The agent's side that faces the wall most directly, where the wall is the reference.
    let (mut facing, mut least) = (Real::ZERO, splat(f32::MAX));
    let (mut near, mut next) = (Vector::ZERO, Vector::ZERO);
    for k in 0..4 {
        let along = polygon.normals[k].dot(wall_normal);
        let lower = less(along, least);
        least = pick(lower, along, least);
        facing = pick(lower, splat(k as f32), facing);
        near.put(lower, polygon.corners[k]);
        next.put(lower, polygon.corners[(k + 1) % 4]);
    }
    let normal = Vector::pick(by_side, side_normal, wall_normal);
    let number = |k: Real| pick(less(k, splat(3.0)), k + splat(1.0), Real::ZERO);
    let face = [
        End {
            corner: Vector::pick(by_side, from, Vector::pick(front, a, b)),
            number: pick(by_side, side, pick(front, Real::ZERO, splat(1.0))),
        },
        End {
            corner: Vector::pick(by_side, to, Vector::pick(front, b, a)),
            number: pick(by_side, number(side), pick(front, splat(1.0), Real::ZERO)),
        },
    ];
    // See [`crate::clip::name`]: the first shape's side, and the second's corner.
    let first = pick(by_side, side * splat(2.0), Real::ZERO);
    let line = [
        Named {
            point: Vector::pick(by_side, a, near),
            first,
            number: pick(by_side, Real::ZERO, facing),
            corner: splat(1.0),
        },
        Named {
            point: Vector::pick(by_side, b, next),
            first,
            number: pick(by_side, splat(1.0), number(facing)),
            corner: splat(1.0),
        },
    ];
    // The side planes lie at the ends of the face itself: parts beyond its ends do not count.
    let tangent = normal.perp();
    let (once, gone) = clip_at(line, -tangent, face[0]);
    let (clipped, gone_again) = clip_at(once, tangent, face[1]);
    let live = live & !lanes(gone | gone_again);
    if live == 0 {
        return Manifolds::NONE;
    }
    let touches = clipped.map(|named| at_most(normal.dot(named.point - face[0].corner), splat(SKINS)));
    let placed = clipped
        .map(|named| Vector::pick(by_side, named.point, agent.local_vector(named.point - agent.centre)));
    let names = clipped.map(|named| named.name(by_side));
    let local_normal = agent.local_vector(normal);
    let local_anchor = agent.local_vector(face[0].corner - agent.centre);
    Manifolds {
        live: live & lanes(touches[0] | touches[1]),
        two: live & lanes(touches[0] & touches[1]),
        points_only: 0,
        second: live & lanes(by_side),
        normal: Vector::pick(by_side, local_normal, normal),
        anchor: Vector::pick(by_side, local_anchor, face[0].corner),
        points: [Vector::pick(touches[0], placed[0], placed[1]), placed[1]],
        names: [pick(touches[0], names[0], names[1]), names[1]],
    }
}

/// An end of a face, at which lines are clipped.
#[derive(Clone, Copy)]
struct End {
    corner: Vector,
    number: Real,
}

/// A point of a line with its name, in parts: the first shape's half; number and kind of the second's.
#[derive(Clone, Copy)]
struct Named {
    point: Vector,
    first: Real,
    number: Real,
    corner: Real,
}

impl Named {
    fn pick(mask: Real, a: Self, b: Self) -> Self {
        Self {
            point: Vector::pick(mask, a.point, b.point),
            first: pick(mask, a.first, b.first),
            number: pick(mask, a.number, b.number),
            corner: pick(mask, a.corner, b.corner),
        }
    }

    /// The name as a number, with the two shapes exchanged where the mask says so.
    fn name(self, swapped: Real) -> Real {
        let second = self.number * splat(2.0) + self.corner;
        let high = pick(swapped, second, self.first);
        let low = pick(swapped, self.first, second);
        high * splat(256.0) + low
    }
}

/// Keeps the part behind the plane through a corner. Also returns the lanes in which nothing remains.
#[inline]
fn clip_at(line: [Named; 2], outward: Vector, end: End) -> ([Named; 2], Real) {
    let limit = outward.dot(end.corner) + splat(0.0);
    let beyond = line.map(|named| outward.dot(named.point) - limit);
    let stays = beyond.map(|beyond| at_most(beyond, Real::ZERO));
    let whole = stays[0] & stays[1];
    if lanes(whole) == !0 {
        return (line, Real::ZERO);
    }
    let share = beyond[0] / (beyond[0] - beyond[1]);
    let cut = Named {
        point: line[0].point + (line[1].point - line[0].point) * share,
        // See [`crate::clip::name`]: a corner of the face, and a side of the line.
        first: end.number * splat(2.0) + splat(1.0),
        number: line[0].number,
        corner: Real::ZERO,
    };
    // The point that is kept comes first, whichever it was.
    let kept = Named::pick(stays[0], line[0], line[1]);
    let clipped = [Named::pick(whole, line[0], kept), Named::pick(whole, line[1], cut)];
    (clipped, !(stays[0] | stays[1]))
}

//! The points at which two shapes touch.

use super::{
    ANGULAR_SLOP, SKIN,
    math::{Transform, normalised, right_of},
    shape::{Outline, Shape},
};
use phase_model::Vec2;

/// The shape whose side gives the normal.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Reference {
    Points,
    First,
    Second,
}

/// Points of contact, in the frames of both shapes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Manifold {
    pub(super) reference: Reference,
    pub(super) normal: Vec2,
    pub(super) anchor: Vec2,
    pub(super) points: [Vec2; 2],
    pub(super) names: [u32; 2],
    pub(super) count: usize,
}

impl Manifold {
    pub(super) const NONE: Self = Self {
        reference: Reference::Points,
        normal: Vec2::ZERO,
        anchor: Vec2::ZERO,
        points: [Vec2::ZERO; 2],
        names: [0; 2],
        count: 0,
    };

    /// A contact with the centre of a disc.
    const fn single(reference: Reference, normal: Vec2, anchor: Vec2, name: u32) -> Self {
        Self { reference, normal, anchor, names: [name, 0], count: 1, ..Self::NONE }
    }
}

/// The contact of two shapes, of which the second is not a wall and not more angular than the first.
pub(super) fn collide(a: &Shape, pose_a: &Transform, b: &Shape, pose_b: &Transform) -> Manifold {
    match (&a.outline, &b.outline) {
        (Outline::Disc, Outline::Disc) => discs(a.radius + b.radius, pose_a, pose_b),
        (Outline::Polygon { .. }, Outline::Disc) => polygon_disc(a, pose_a, b, pose_b),
        (Outline::Polygon { .. }, Outline::Polygon { .. }) => polygons(a, pose_a, b, pose_b),
        (Outline::Edge(from, to), Outline::Disc) => {
            edge_disc(*from, *to, a.radius + b.radius, pose_a.undo(pose_b.place))
        }
        (Outline::Edge(from, to), Outline::Polygon { .. }) => edge_polygon(*from, *to, pose_a, b, pose_b),
        _ => Manifold::NONE,
    }
}

fn discs(radius: f32, pose_a: &Transform, pose_b: &Transform) -> Manifold {
    let between = pose_b.place - pose_a.place;
    if between.dot(between) > radius * radius {
        return Manifold::NONE;
    }
    Manifold::single(Reference::Points, Vec2::ZERO, Vec2::ZERO, 0)
}

fn polygon_disc(a: &Shape, pose_a: &Transform, b: &Shape, pose_b: &Transform) -> Manifold {
    let Outline::Polygon { corners, normals, .. } = &a.outline else { return Manifold::NONE };
    let centre = pose_a.undo(pose_b.place);
    let radius = a.radius + b.radius;
    let mut side = 0;
    let mut gap = -f32::MAX;
    for k in 0..4 {
        let along = normals[k].dot(centre - corners[k]);
        if along > radius {
            return Manifold::NONE;
        }
        if along > gap {
            (side, gap) = (k, along);
        }
    }
    let from = corners[side];
    let to = corners[(side + 1) % 4];
    let middle = 0.5 * (from + to);
    let face = Manifold::single(Reference::First, normals[side], middle, 0);
    if gap < f32::EPSILON {
        return face;
    }
    let corner = if (centre - from).dot(to - from) <= 0.0 {
        from
    } else if (centre - to).dot(from - to) <= 0.0 {
        to
    } else {
        return if (centre - middle).dot(normals[side]) > radius { Manifold::NONE } else { face };
    };
    let away = centre - corner;
    if away.dot(away) > radius * radius {
        return Manifold::NONE;
    }
    Manifold::single(Reference::First, normalised(away).0, corner, 0)
}

fn edge_disc(from: Vec2, to: Vec2, radius: f32, centre: Vec2) -> Manifold {
    let along = to - from;
    let left = along.dot(to - centre);
    let done = along.dot(centre - from);
    let far = |at: Vec2| (centre - at).dot(centre - at) > radius * radius;
    for (past, end, name) in [(done <= 0.0, from, 0), (left <= 0.0, to, 1)] {
        if past {
            if far(end) {
                return Manifold::NONE;
            }
            return Manifold::single(Reference::Points, Vec2::ZERO, end, name);
        }
    }
    let nearest = (1.0 / along.dot(along)) * (left * from + done * to);
    if far(nearest) {
        return Manifold::NONE;
    }
    let normal = -right_of(along);
    let normal = if normal.dot(centre - from) < 0.0 { -normal } else { normal };
    Manifold::single(Reference::First, normalised(normal).0, from, FACE)
}

/// Marks a side, in a name; corners have none.
const FACE: u32 = 1 << 16;

/// A point with a name: which corners or sides of both shapes meet there.
#[derive(Clone, Copy)]
struct Named {
    at: Vec2,
    /// Number in the first and in the second shape, and whether it is a side.
    first: (usize, bool),
    second: (usize, bool),
}

impl Named {
    fn name(self, flipped: bool) -> u32 {
        let (a, b) = if flipped { (self.second, self.first) } else { (self.first, self.second) };
        let side = |is: bool| u32::from(is);
        a.0 as u32 | (b.0 as u32) << 8 | side(a.1) << 16 | side(b.1) << 24
    }
}

/// The part of a line behind a plane, if that has two ends.
fn clip(line: [Named; 2], normal: Vec2, offset: f32, number: usize) -> Option<[Named; 2]> {
    let gaps = [normal.dot(line[0].at) - offset, normal.dot(line[1].at) - offset];
    let kept = [gaps[0] <= 0.0, gaps[1] <= 0.0];
    if gaps[0] * gaps[1] < 0.0 {
        let share = gaps[0] / (gaps[0] - gaps[1]);
        let cut = Named {
            at: line[0].at + share * (line[1].at - line[0].at),
            first: (number, false),
            second: (line[0].second.0, true),
        };
        return Some([if kept[0] { line[0] } else { line[1] }, cut]);
    }
    (kept[0] && kept[1]).then_some(line)
}

/// The distance of a polygon beyond one side of another.
fn side_gap(side: usize, a: &Polygon<'_>, b: &Polygon<'_>) -> f32 {
    let normal = a.pose.rotation.turn(a.normals[side]);
    let local = b.pose.rotation.turn_back(normal);
    let mut index = 0;
    let mut least = f32::MAX;
    for (k, corner) in b.corners.iter().enumerate() {
        let along = corner.dot(local);
        if along < least {
            (index, least) = (k, along);
        }
    }
    (b.pose.apply(b.corners[index]) - a.pose.apply(a.corners[side])).dot(normal)
}

#[derive(Clone, Copy)]
struct Polygon<'a> {
    corners: &'a [Vec2; 4],
    normals: &'a [Vec2; 4],
    centre: Vec2,
    pose: &'a Transform,
}

/// The side with the greatest distance to another polygon, found by climbing from the side that faces it.
fn greatest_gap(a: &Polygon<'_>, b: &Polygon<'_>) -> (usize, f32) {
    let towards = a.pose.rotation.turn_back(b.pose.apply(b.centre) - a.pose.apply(a.centre));
    let mut side = 0;
    let mut most = -f32::MAX;
    for (k, normal) in a.normals.iter().enumerate() {
        let along = normal.dot(towards);
        if along > most {
            (side, most) = (k, along);
        }
    }
    let gap = side_gap(side, a, b);
    let previous = (side + 3) % 4;
    let next = (side + 1) % 4;
    let gap_before = side_gap(previous, a, b);
    let gap_after = side_gap(next, a, b);
    let (mut best, step) = if gap_before > gap && gap_before > gap_after {
        ((previous, gap_before), 3)
    } else if gap_after > gap {
        ((next, gap_after), 1)
    } else {
        return (side, gap);
    };
    loop {
        let side = (best.0 + step) % 4;
        let gap = side_gap(side, a, b);
        if gap > best.1 {
            best = (side, gap);
        } else {
            return best;
        }
    }
}

/// Share and margin by which the second shape's gap must exceed the first's to give the normal.
const BIAS: (f32, f32) = (0.98, 0.001);

fn polygons(a: &Shape, pose_a: &Transform, b: &Shape, pose_b: &Transform) -> Manifold {
    let radius = a.radius + b.radius;
    let (
        Outline::Polygon { corners, normals, centre },
        Outline::Polygon { corners: corners_b, normals: normals_b, centre: centre_b },
    ) = (&a.outline, &b.outline)
    else {
        return Manifold::NONE;
    };
    let a = Polygon { corners, normals, centre: *centre, pose: pose_a };
    let b = Polygon { corners: corners_b, normals: normals_b, centre: *centre_b, pose: pose_b };
    let (side_a, gap_a) = greatest_gap(&a, &b);
    if gap_a > radius {
        return Manifold::NONE;
    }
    let (side_b, gap_b) = greatest_gap(&b, &a);
    if gap_b > radius {
        return Manifold::NONE;
    }
    let flipped = gap_b > BIAS.0 * gap_a + BIAS.1;
    let (a, b, side) = if flipped { (b, a, side_b) } else { (a, b, side_a) };
    let facing = b.pose.rotation.turn_back(a.pose.rotation.turn(a.normals[side]));
    let met = most_opposed(facing, b.normals);
    let end = |k: usize| Named { at: b.pose.apply(b.corners[k]), first: (side, true), second: (k, false) };
    let next = (side + 1) % 4;
    let from = a.corners[side];
    let to = a.corners[next];
    let tangent_here = normalised(to - from).0;
    let tangent = a.pose.rotation.turn(tangent_here);
    let normal = right_of(tangent);
    let start = a.pose.apply(from);
    let finish = a.pose.apply(to);
    let front = normal.dot(start);
    let once = clip([end(met), end((met + 1) % 4)], -tangent, -tangent.dot(start) + radius, side);
    let Some(line) = once.and_then(|once| clip(once, tangent, tangent.dot(finish) + radius, next)) else {
        return Manifold::NONE;
    };
    let mut manifold = Manifold {
        reference: if flipped { Reference::Second } else { Reference::First },
        normal: right_of(tangent_here),
        anchor: 0.5 * (from + to),
        ..Manifold::NONE
    };
    for named in line {
        if normal.dot(named.at) - front <= radius {
            manifold.points[manifold.count] = b.pose.undo(named.at);
            manifold.names[manifold.count] = named.name(flipped);
            manifold.count += 1;
        }
    }
    manifold
}

/// The first of the normals that are most opposed to a direction.
fn most_opposed(direction: Vec2, normals: &[Vec2; 4]) -> usize {
    let mut best = (0, f32::MAX);
    for (k, normal) in normals.iter().enumerate() {
        let along = direction.dot(*normal);
        if along < best.1 {
            best = (k, along);
        }
    }
    best.0
}

/// The side of a polygon with the greatest distance to an edge, or none that counts. `Err` if they are apart.
fn polygon_side(
    corners: &[Vec2; 4],
    normals: &[Vec2; 4],
    from: Vec2,
    to: Vec2,
    normal: Vec2,
) -> Result<Option<(usize, f32)>, ()> {
    let radius = 2.0 * SKIN;
    let mut best: Option<(usize, f32)> = None;
    for k in 0..4 {
        let side = -normals[k];
        let gap = side.dot(corners[k] - from).min(side.dot(corners[k] - to));
        if gap > radius {
            return Err(());
        }
        // Both limits of the normals that count are the opposite of the edge's own.
        if (side + normal).dot(normal) < -ANGULAR_SLOP {
            continue;
        }
        if gap > best.map_or(-f32::MAX, |(_, most)| most) {
            best = Some((k, gap));
        }
    }
    Ok(best)
}

fn edge_polygon(from: Vec2, to: Vec2, pose_a: &Transform, b: &Shape, pose_b: &Transform) -> Manifold {
    let Outline::Polygon { corners, normals, centre } = &b.outline else { return Manifold::NONE };
    let radius = 2.0 * SKIN;
    let pose = pose_a.relative(pose_b);
    let across = right_of(normalised(to - from).0);
    let front = across.dot(pose.apply(*centre) - from) >= 0.0;
    let normal = if front { across } else { -across };
    let placed = corners.map(|corner| pose.apply(corner));
    let turned = normals.map(|normal| pose.rotation.turn(normal));
    let edge_gap = placed.iter().fold(f32::MAX, |least, corner| least.min(normal.dot(*corner - from)));
    if edge_gap > radius {
        return Manifold::NONE;
    }
    let Ok(by_polygon) = polygon_side(&placed, &turned, from, to, normal) else { return Manifold::NONE };
    let by_side = by_polygon.filter(|&(_, gap)| gap > BIAS.0 * edge_gap + BIAS.1).map(|(side, _)| side);
    let (line, ends, facing) = if let Some(side) = by_side {
        let end = |at, k| Named { at, first: (k, false), second: (side, true) };
        let next = (side + 1) % 4;
        // The number of the side stands in both halves of the first end's name, as in the original.
        let line = [Named { first: (0, false), ..end(from, 0) }, Named { first: (0, false), ..end(to, 0) }];
        (line, [(placed[side], side), (placed[next], next)], turned[side])
    } else {
        let met = most_opposed(normal, &turned);
        let end = |k: usize| Named { at: placed[k], first: (0, true), second: (k, false) };
        let ends = if front { [(from, 0), (to, 1)] } else { [(to, 1), (from, 0)] };
        ([end(met), end((met + 1) % 4)], ends, normal)
    };
    let side_normal = right_of(facing);
    let once = clip(line, side_normal, side_normal.dot(ends[0].0), ends[0].1);
    let twice = once.and_then(|once| clip(once, -side_normal, (-side_normal).dot(ends[1].0), ends[1].1));
    let Some(clipped) = twice else { return Manifold::NONE };
    let mut manifold = match by_side {
        Some(side) => Manifold {
            reference: Reference::Second,
            normal: normals[side],
            anchor: corners[side],
            ..Manifold::NONE
        },
        None => Manifold { reference: Reference::First, normal: facing, anchor: ends[0].0, ..Manifold::NONE },
    };
    for named in clipped {
        if facing.dot(named.at - ends[0].0) <= radius {
            manifold.points[manifold.count] = if by_side.is_some() { named.at } else { pose.undo(named.at) };
            manifold.names[manifold.count] = named.name(by_side.is_some());
            manifold.count += 1;
        }
    }
    manifold
}

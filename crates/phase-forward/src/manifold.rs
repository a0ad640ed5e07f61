//! Where two shapes touch: one normal and up to two points, in the frames of the two bodies.

use crate::{
    body::{Motion, Shape},
    tuning::SKIN,
    wall::Wall,
};
use phase_model::Vec2;

/// Sides whose gaps differ by less than this tie, and the first wins (u). Bodies that start in the same place
/// are such ties, and rounding must not decide where they go.
const TIE: f32 = 1e-5;

/// The first shape's side is the reference unless the second's gap exceeds this share of the first's and
/// this much on top (u).
const PREFERENCE: (f32, f32) = (0.98, 0.001);

/// Which shape the normal belongs to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Reference {
    /// Neither: the normal leads from the one point of the first shape to the one point of the second.
    Points,
    /// A face of the first shape.
    First,
    /// A face of the second shape.
    Second,
}

/// A contact of two shapes, in local frames so that it stays valid while the position solver moves them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Manifold {
    pub(crate) reference: Reference,
    /// Number of points, 0 to 2.
    pub(crate) count: usize,
    /// Normal of the reference face, in the frame of its body.
    pub(crate) normal: Vec2,
    /// A point of the reference face (or the first shape's point), in the frame of its body.
    pub(crate) anchor: Vec2,
    /// The touching points of the other shape, in the frame of its body.
    pub(crate) points: [Vec2; 2],
    /// Names of the features that made the points, by which impulses find them again.
    pub(crate) names: [u16; 2],
}

impl Manifold {
    pub(crate) const NONE: Self = Self {
        reference: Reference::Points,
        count: 0,
        normal: Vec2::ZERO,
        anchor: Vec2::ZERO,
        points: [Vec2::ZERO; 2],
        names: [0; 2],
    };

    fn single(reference: Reference, normal: Vec2, anchor: Vec2, point: Vec2) -> Self {
        Self { reference, count: 1, normal, anchor, points: [point; 2], names: [0; 2] }
    }

    /// The normal (from the first shape to the second) and, for one of the points, where it lies and how far
    /// the shapes with their skins are apart there, for bodies at the given poses.
    #[inline]
    pub(crate) fn gap(&self, a: &Motion, b: &Motion, skins: f32, point: usize) -> (Vec2, Vec2, f32) {
        match self.reference {
            Reference::Points => {
                let (from, to) = (a.place(self.anchor), b.place(self.points[0]));
                let normal = (to - from).normalize_or_zero();
                (normal, (from + to) * 0.5, (to - from).dot(normal) - skins)
            }
            Reference::First => {
                let normal = a.turn(self.normal);
                let touching = b.place(self.points[point]);
                (normal, touching, (touching - a.place(self.anchor)).dot(normal) - skins)
            }
            Reference::Second => {
                let normal = b.turn(self.normal);
                let touching = a.place(self.points[point]);
                (-normal, touching, (touching - b.place(self.anchor)).dot(normal) - skins)
            }
        }
    }

    /// [`Manifold::gap`] where the first shape is a wall.
    #[inline]
    pub(crate) fn gap_to_wall(&self, body: &Motion, skins: f32, point: usize) -> (Vec2, Vec2, f32) {
        match self.reference {
            Reference::Points => {
                let to = body.place(self.points[0]);
                let normal = (to - self.anchor).normalize_or_zero();
                (normal, (self.anchor + to) * 0.5, (to - self.anchor).dot(normal) - skins)
            }
            Reference::First => {
                let touching = body.place(self.points[point]);
                (self.normal, touching, (touching - self.anchor).dot(self.normal) - skins)
            }
            Reference::Second => {
                let normal = body.turn(self.normal);
                let touching = self.points[point];
                (-normal, touching, (touching - body.place(self.anchor)).dot(normal) - skins)
            }
        }
    }

    /// The normal and the middles of the overlaps, where impulses act.
    #[inline]
    pub(crate) fn middles(&self, a: &Motion, b: &Motion, skin_a: f32, skin_b: f32) -> (Vec2, [Vec2; 2]) {
        let mut middles = [Vec2::ZERO; 2];
        match self.reference {
            Reference::Points => {
                let (from, to) = (a.place(self.anchor), b.place(self.points[0]));
                let normal = (to - from).try_normalize().unwrap_or(Vec2::X);
                middles[0] = (from + normal * skin_a + to - normal * skin_b) * 0.5;
                (normal, middles)
            }
            Reference::First => {
                let normal = a.turn(self.normal);
                let plane = a.place(self.anchor);
                for (middle, point) in middles.iter_mut().zip(self.points).take(self.count) {
                    let clip = b.place(point);
                    *middle = clip + normal * (0.5 * (skin_a - (clip - plane).dot(normal) - skin_b));
                }
                (normal, middles)
            }
            Reference::Second => {
                let normal = b.turn(self.normal);
                let plane = b.place(self.anchor);
                for (middle, point) in middles.iter_mut().zip(self.points).take(self.count) {
                    let clip = a.place(point);
                    *middle = clip + normal * (0.5 * (skin_b - (clip - plane).dot(normal) - skin_a));
                }
                (-normal, middles)
            }
        }
    }
}

/// An agent's corners and side normals in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polygon {
    pub(crate) corners: [Vec2; 4],
    pub(crate) normals: [Vec2; 4],
}

impl Polygon {
    pub(crate) const NONE: Self = Self { corners: [Vec2::ZERO; 4], normals: [Vec2::ZERO; 4] };

    #[inline]
    pub(crate) fn new(shape: &Shape, motion: &Motion) -> Self {
        // Written out because `map` on arrays does not unroll here.
        let [a, b, c, d] = &shape.corners;
        let [e, f, g, h] = &shape.normals;
        Self {
            corners: [motion.place(*a), motion.place(*b), motion.place(*c), motion.place(*d)],
            normals: [motion.turn(*e), motion.turn(*f), motion.turn(*g), motion.turn(*h)],
        }
    }

    /// Corners of the box around it, without skin (u).
    #[inline]
    pub(crate) fn bounds(&self) -> (Vec2, Vec2) {
        let [a, b, c, d] = self.corners;
        (a.min(b).min(c).min(d), a.max(b).max(c).max(d))
    }

    /// The side whose normal separates the other polygon most, and by how much. Found by climbing from the
    /// side that looks most towards the other's centre of mass, which matters where polygons overlap deeply.
    #[inline]
    fn widest_gap(&self, other: &Self, towards: Vec2) -> (usize, f32) {
        let side = self.side_against(-towards);
        let gap = self.gap(side, other);
        let (previous, next) = ((side + 3) % 4, (side + 1) % 4);
        let (gap_previous, gap_next) = (self.gap(previous, other), self.gap(next, other));
        let (mut best, step) = if gap_previous > gap && gap_previous > gap_next {
            ((previous, gap_previous), 3)
        } else if gap_next > gap {
            ((next, gap_next), 1)
        } else {
            return (side, gap);
        };
        loop {
            let side = (best.0 + step) % 4;
            let gap = self.gap(side, other);
            if gap <= best.1 {
                return best;
            }
            best = (side, gap);
        }
    }

    /// How far the other polygon is beyond a side; negative if it reaches behind it.
    #[inline]
    fn gap(&self, side: usize, other: &Self) -> f32 {
        let normal = self.normals[side];
        let nearest = other.corners.iter().fold(f32::MAX, |least, corner| least.min(normal.dot(*corner)));
        nearest - normal.dot(self.corners[side])
    }

    /// The side that looks most against a direction.
    #[inline]
    fn side_against(&self, direction: Vec2) -> usize {
        let mut best = (0, f32::MAX);
        for (side, normal) in self.normals.iter().enumerate() {
            let along = normal.dot(direction);
            if along < best.1 {
                best = (side, along);
            }
        }
        best.0
    }
}

/// Contact of two discs.
pub(crate) fn discs(a: &Motion, b: &Motion, skins: f32) -> Manifold {
    if a.centre.distance_squared(b.centre) > skins * skins {
        return Manifold::NONE;
    }
    Manifold::single(Reference::Points, Vec2::ZERO, Vec2::ZERO, Vec2::ZERO)
}

/// Contact of an agent (first) and a disc (second).
pub(crate) fn agent_disc(shape: &Shape, agent: &Motion, disc: &Motion, skins: f32) -> Manifold {
    let centre = agent.turn_back(disc.centre - agent.centre);
    let (mut side, mut gap) = (0, f32::MIN);
    for k in 0..4 {
        let along = shape.normals[k].dot(centre - shape.corners[k]);
        if along > skins {
            return Manifold::NONE;
        }
        if along > gap + TIE {
            (side, gap) = (k, along);
        }
    }
    let (from, to) = (shape.corners[side], shape.corners[(side + 1) % 4]);
    let face = (shape.normals[side], (from + to) * 0.5);
    let (normal, anchor) = if gap < f32::EPSILON {
        face
    } else {
        let corner = if (centre - from).dot(to - from) <= 0.0 {
            Some(from)
        } else if (centre - to).dot(from - to) <= 0.0 {
            Some(to)
        } else {
            None
        };
        match corner {
            Some(corner) if centre.distance_squared(corner) > skins * skins => return Manifold::NONE,
            Some(corner) => ((centre - corner).normalize_or_zero(), corner),
            None => face,
        }
    };
    Manifold::single(Reference::First, normal, anchor, Vec2::ZERO)
}

/// Contact of a wall (first) and a disc (second).
pub(crate) fn wall_disc(wall: &Wall, disc: &Motion, skins: f32) -> Manifold {
    let along = wall.b - wall.a;
    let (to_b, from_a) = (along.dot(wall.b - disc.centre), along.dot(disc.centre - wall.a));
    let end = if from_a <= 0.0 {
        Some(wall.a)
    } else if to_b <= 0.0 {
        Some(wall.b)
    } else {
        None
    };
    if let Some(end) = end {
        if disc.centre.distance_squared(end) > skins * skins {
            return Manifold::NONE;
        }
        return Manifold::single(Reference::Points, Vec2::ZERO, end, Vec2::ZERO);
    }
    let away = wall.normal.dot(disc.centre - wall.a);
    if away.abs() > skins {
        return Manifold::NONE;
    }
    let normal = if away < 0.0 || (away == 0.0 && wall.normal.x > 0.0) { -wall.normal } else { wall.normal };
    Manifold::single(Reference::First, normal, wall.a, Vec2::ZERO)
}

/// Contact of two agents.
pub(crate) fn agents(first: (&Motion, &Polygon), second: (&Motion, &Polygon)) -> Manifold {
    const SKINS: f32 = 2.0 * SKIN;
    let towards = second.0.centre - first.0.centre;
    let (side_a, gap_a) = first.1.widest_gap(second.1, towards);
    if gap_a > SKINS {
        return Manifold::NONE;
    }
    let (side_b, gap_b) = second.1.widest_gap(first.1, -towards);
    if gap_b > SKINS {
        return Manifold::NONE;
    }
    let flipped = gap_b > PREFERENCE.0 * gap_a + PREFERENCE.1;
    let (reference, incident, side) = if flipped { (second, first, side_b) } else { (first, second, side_a) };
    let normal = reference.1.normals[side];
    let next = (side + 1) % 4;
    let other_side = incident.1.side_against(normal);
    let tangent = normal.perp();
    let face = [reference.1.corners[side], reference.1.corners[next]];
    let Some(clipped) = clip(
        [other_side, (other_side + 1) % 4].map(|k| (incident.1.corners[k], name(false, side, true, k))),
        tangent,
        [(face[0], SKINS, side), (face[1], SKINS, next)],
    ) else {
        return Manifold::NONE;
    };
    let mut manifold = Manifold {
        reference: if flipped { Reference::Second } else { Reference::First },
        normal: reference.0.turn_back(normal),
        anchor: reference.0.turn_back((face[0] + face[1]) * 0.5 - reference.0.centre),
        ..Manifold::NONE
    };
    for (point, name) in clipped {
        if normal.dot(point - face[0]) <= SKINS {
            manifold.points[manifold.count] = incident.0.turn_back(point - incident.0.centre);
            manifold.names[manifold.count] = if flipped { name.swap_bytes() } else { name };
            manifold.count += 1;
        }
    }
    manifold
}

/// Contact of a wall (first) and an agent (second).
pub(crate) fn wall_agent(wall: &Wall, agent: &Motion, polygon: &Polygon) -> Manifold {
    const SKINS: f32 = 2.0 * SKIN;
    let front = wall.normal.dot(agent.centre - wall.a) >= 0.0;
    let wall_normal = if front { wall.normal } else { -wall.normal };
    let reach = wall_normal.dot(wall.a);
    let gap =
        polygon.corners.iter().fold(f32::MAX, |least, corner| least.min(wall_normal.dot(*corner) - reach));
    if gap > SKINS {
        return Manifold::NONE;
    }
    let (mut side, mut side_gap) = (0, f32::MIN);
    for k in 0..4 {
        let (normal, corner) = (polygon.normals[k], polygon.corners[k]);
        let separation = normal.dot(wall.a - corner).min(normal.dot(wall.b - corner));
        if separation > SKINS {
            return Manifold::NONE;
        }
        if separation > side_gap {
            (side, side_gap) = (k, separation);
        }
    }
    let by_side = side_gap > PREFERENCE.0 * gap + PREFERENCE.1;
    let (normal, face, incident) = if by_side {
        let next = (side + 1) % 4;
        (
            polygon.normals[side],
            [(polygon.corners[side], 0.0, side), (polygon.corners[next], 0.0, next)],
            [(wall.a, name(false, side, true, 0)), (wall.b, name(false, side, true, 1))],
        )
    } else {
        let face =
            if front { [(wall.a, 0.0, 0), (wall.b, 0.0, 1)] } else { [(wall.b, 0.0, 1), (wall.a, 0.0, 0)] };
        let facing = polygon.side_against(wall_normal);
        let named = |k: usize| (polygon.corners[k], name(false, 0, true, k));
        let incident = [named(facing), named((facing + 1) % 4)];
        (wall_normal, face, incident)
    };
    // The side planes stand on the face itself: what sticks out beyond its ends does not count.
    let Some(clipped) = clip(incident, normal.perp(), face) else {
        return Manifold::NONE;
    };
    let mut manifold = Manifold::NONE;
    if by_side {
        manifold.reference = Reference::Second;
        manifold.normal = agent.turn_back(normal);
        manifold.anchor = agent.turn_back(face[0].0 - agent.centre);
    } else {
        manifold.reference = Reference::First;
        manifold.normal = normal;
        manifold.anchor = face[0].0;
    }
    for (point, name) in clipped {
        if normal.dot(point - face[0].0) <= SKINS {
            manifold.points[manifold.count] =
                if by_side { point } else { agent.turn_back(point - agent.centre) };
            manifold.names[manifold.count] = if by_side { name.swap_bytes() } else { name };
            manifold.count += 1;
        }
    }
    manifold
}

/// The name of a contact point: for each of two shapes a corner or a side, and its number.
const fn name(first_is_corner: bool, first: usize, second_is_corner: bool, second: usize) -> u16 {
    const fn half(is_corner: bool, number: usize) -> u16 {
        (number as u16) << 1 | is_corner as u16
    }
    half(first_is_corner, first) << 8 | half(second_is_corner, second)
}

/// Cuts a line of two named points off at the two ends of a face, given as (corner, leeway, number).
/// `tangent` leads from the first end to the second. `None` if nothing is left.
#[inline]
fn clip(line: [(Vec2, u16); 2], tangent: Vec2, ends: [(Vec2, f32, usize); 2]) -> Option<[(Vec2, u16); 2]> {
    let once = clip_at(line, -tangent, ends[0])?;
    clip_at(once, tangent, ends[1])
}

/// Keeps what lies behind the plane through a corner.
#[inline]
fn clip_at(
    line: [(Vec2, u16); 2],
    outward: Vec2,
    (corner, leeway, number): (Vec2, f32, usize),
) -> Option<[(Vec2, u16); 2]> {
    let limit = outward.dot(corner) + leeway;
    let beyond = [outward.dot(line[0].0) - limit, outward.dot(line[1].0) - limit];
    match (beyond[0] <= 0.0, beyond[1] <= 0.0) {
        (true, true) => Some(line),
        (false, false) => None,
        (first_stays, _) => {
            let share = beyond[0] / (beyond[0] - beyond[1]);
            let cut = line[0].0 + (line[1].0 - line[0].0) * share;
            // The cut point lies where a corner of the face meets a side of the line.
            let named = (cut, name(true, number, false, usize::from((line[0].1 & 0xff) >> 1)));
            // The point that stays comes first, whichever it was.
            Some(if first_stays { [line[0], named] } else { [line[1], named] })
        }
    }
}

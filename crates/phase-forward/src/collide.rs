//! Contacts of two shapes of each kind: disc, agent, wall.

use crate::{
    body::{BodyMotion, Shape},
    clip::{clip, name},
    constants::SKIN,
    manifold::{Manifold, Reference},
    polygon::Polygon,
    wall::Wall,
};
use phase_model::Vec2;

/// Sides whose gaps differ by less than this tie, and the first wins (u). Bodies that start at the same point
/// are such ties, and rounding must not decide their direction.
const TIE_TOLERANCE: f32 = 1e-5;

/// Cosine of the angle to a wall's normal below which a push leads across the wall rather than along it. An
/// agent that lies across a wall gets off it on the side of its centre of mass, even if it lies mostly on the
/// other: there is no way through a wall.
const ACROSS: f32 = 0.1;

/// The first shape's side is the reference unless the second's gap exceeds this share of the first's plus
/// this margin (u).
const REFERENCE_BIAS: (f32, f32) = (0.98, 0.001);

/// Contact of two discs.
pub(crate) fn discs(a: &BodyMotion, b: &BodyMotion, skins: f32) -> Manifold {
    if a.centre.distance_squared(b.centre) > skins * skins {
        return Manifold::NONE;
    }
    Manifold::single(Reference::Points, Vec2::ZERO, Vec2::ZERO, Vec2::ZERO)
}

/// Contact of an agent (first) and a disc (second).
pub(crate) fn agent_disc(shape: &Shape, agent: &BodyMotion, disc: &BodyMotion, skins: f32) -> Manifold {
    let centre = agent.local_vector(disc.centre - agent.centre);
    let mut side = 0;
    let mut gap = f32::MIN;
    for k in 0..4 {
        let along = shape.normals[k].dot(centre - shape.corners[k]);
        if along > skins {
            return Manifold::NONE;
        }
        if along > gap + TIE_TOLERANCE {
            (side, gap) = (k, along);
        }
    }
    let from = shape.corners[side];
    let to = shape.corners[(side + 1) % 4];
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
pub(crate) fn wall_disc(wall: &Wall, disc: &BodyMotion, skins: f32) -> Manifold {
    let along = wall.b - wall.a;
    let to_b = along.dot(wall.b - disc.centre);
    let from_a = along.dot(disc.centre - wall.a);
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
pub(crate) fn agents(first: (&BodyMotion, &Polygon), second: (&BodyMotion, &Polygon)) -> Manifold {
    const SKINS: f32 = 2.0 * SKIN;
    let towards = second.0.centre - first.0.centre;
    let (side_a, gap_a) = first.1.max_separation(second.1, towards);
    if gap_a > SKINS {
        return Manifold::NONE;
    }
    let (side_b, gap_b) = second.1.max_separation(first.1, -towards);
    if gap_b > SKINS {
        return Manifold::NONE;
    }
    let flipped = gap_b > REFERENCE_BIAS.0 * gap_a + REFERENCE_BIAS.1;
    let (reference, incident, side) = if flipped { (second, first, side_b) } else { (first, second, side_a) };
    let normal = reference.1.normals[side];
    let next = (side + 1) % 4;
    let other_side = incident.1.incident_side(normal);
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
        normal: reference.0.local_vector(normal),
        anchor: reference.0.local_vector((face[0] + face[1]) * 0.5 - reference.0.centre),
        ..Manifold::NONE
    };
    for (point, name) in clipped {
        if normal.dot(point - face[0]) <= SKINS {
            manifold.points[manifold.count] = incident.0.local_vector(point - incident.0.centre);
            manifold.names[manifold.count] = if flipped { name.swap_bytes() } else { name };
            manifold.count += 1;
        }
    }
    manifold
}

/// Contact of a wall (first) and an agent (second).
pub(crate) fn wall_agent(wall: &Wall, agent: &BodyMotion, polygon: &Polygon) -> Manifold {
    const SKINS: f32 = 2.0 * SKIN;
    let front = wall.normal.dot(agent.centre - wall.a) >= 0.0;
    let wall_normal = if front { wall.normal } else { -wall.normal };
    let reach = wall_normal.dot(wall.a);
    let gap =
        polygon.corners.iter().fold(f32::MAX, |least, corner| least.min(wall_normal.dot(*corner) - reach));
    if gap > SKINS {
        return Manifold::NONE;
    }
    let mut side = 0;
    let mut side_gap = f32::MIN;
    for k in 0..4 {
        let normal = polygon.normals[k];
        let corner = polygon.corners[k];
        let separation = normal.dot(wall.a - corner).min(normal.dot(wall.b - corner));
        if separation > SKINS {
            return Manifold::NONE;
        }
        if separation > side_gap {
            (side, side_gap) = (k, separation);
        }
    }
    let by_side = side_gap > REFERENCE_BIAS.0 * gap + REFERENCE_BIAS.1
        && !(polygon.normals[side].dot(wall_normal) > ACROSS && wall.is_beside(agent.centre));
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
        let facing = polygon.incident_side(wall_normal);
        let named = |k: usize| (polygon.corners[k], name(false, 0, true, k));
        let incident = [named(facing), named((facing + 1) % 4)];
        (wall_normal, face, incident)
    };
    // The side planes lie at the ends of the face itself: parts beyond its ends do not count.
    let Some(clipped) = clip(incident, normal.perp(), face) else {
        return Manifold::NONE;
    };
    let mut manifold = Manifold::NONE;
    if by_side {
        manifold.reference = Reference::Second;
        manifold.normal = agent.local_vector(normal);
        manifold.anchor = agent.local_vector(face[0].0 - agent.centre);
    } else {
        manifold.reference = Reference::First;
        manifold.normal = normal;
        manifold.anchor = face[0].0;
    }
    for (point, name) in clipped {
        if normal.dot(point - face[0].0) <= SKINS {
            manifold.points[manifold.count] =
                if by_side { point } else { agent.local_vector(point - agent.centre) };
            manifold.names[manifold.count] = if by_side { name.swap_bytes() } else { name };
            manifold.count += 1;
        }
    }
    manifold
}

#[cfg(test)]
mod tests;

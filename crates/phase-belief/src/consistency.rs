//! Contradictions between a particle and the observation.

use phase_model::{
    Body, BodySet, Entity, PhysicsConfig, State, Vec2,
    geometry::{FARTHEST_CORNER, Outline, trapezoid},
};
use phase_perception::{CellSet, footprint::any_cell};

/// Overlap with walls and other bodies beyond which a particle counts as impossible (u). Solvers let resting
/// contacts penetrate slightly, and a belief must not lose a body for leaning on a wall.
pub(crate) const PENETRATION_TOLERANCE: f32 = 0.05;

/// Maximum penetration of an object into an agent, relative to its radius: 1 − 2/√5. This is the depth at
/// which an object held by a flank lies in the slanting side; most of it remains when it is released.
const SIDE_GRIP_PENETRATION: f32 = 0.105_573;

/// The unobserved entities whose bodies cannot be where a particle has them. Of two that overlap, the later
/// by index is chosen.
pub(crate) fn contradicted(
    physics: &PhysicsConfig,
    particle: &State,
    observed: BodySet,
    visible: &CellSet,
) -> BodySet {
    let mut impossible = BodySet::EMPTY;
    let mut settled = observed;
    for entity in physics.entities().filter(|&entity| !observed.contains(entity)) {
        let body = particle.body(entity);
        let possible = body.is_finite()
            && is_clear_of_walls(physics, &shrunk_outline(physics, entity, body, PENETRATION_TOLERANCE))
            && settled.iter().all(|other| {
                holding(particle, entity, other)
                    || !overlap_beyond_tolerance(physics, (entity, body), (other, particle.body(other)))
            })
            && !any_cell(&Outline::of(physics, entity, body), |cell| visible.contains(cell));
        if possible {
            settled.insert(entity);
        } else {
            impossible.insert(entity);
        }
    }
    impossible
}

/// Whether an outline lies inside the arena and no inner wall passes through it.
pub(crate) fn is_clear_of_walls(physics: &PhysicsConfig, outline: &Outline) -> bool {
    outline.inside_arena() && !physics.walls.iter().any(|&wall| outline.overlaps_wall(wall))
}

/// The outline of an entity with its radius reduced by a number (u).
pub(crate) fn shrunk_outline(physics: &PhysicsConfig, entity: Entity, body: &Body, by: f32) -> Outline {
    let radius = physics.radius(entity) - by;
    match entity {
        Entity::Agent(_) => {
            let rotation = Vec2::from_angle(body.angle);
            Outline::Trapezoid(trapezoid(radius).map(|corner| body.position + rotation.rotate(corner)))
        }
        Entity::Object(_) => Outline::Disc { centre: body.position, radius },
    }
}

/// Whether two bodies overlap by more than solvers and releases account for.
pub(crate) fn overlap_beyond_tolerance(
    physics: &PhysicsConfig,
    (a, body_a): (Entity, &Body),
    (b, body_b): (Entity, &Body),
) -> bool {
    let reach = farthest(physics, a) + farthest(physics, b);
    // Written so that NaN reaches the exact test, which returns false.
    if body_a.position.distance_squared(body_b.position) > reach * reach {
        return false;
    }
    let by = |entity: Entity, other: Entity| match (entity, other) {
        (Entity::Object(_), Entity::Agent(_)) => {
            PENETRATION_TOLERANCE + SIDE_GRIP_PENETRATION * physics.radius(entity)
        }
        (Entity::Agent(_), Entity::Object(_)) => 0.0,
        _ => PENETRATION_TOLERANCE / 2.0,
    };
    shrunk_outline(physics, a, body_a, by(a, b)).overlaps(&shrunk_outline(physics, b, body_b, by(b, a)))
}

/// Distance of the farthest point of an outline from its origin, rounded up (u).
fn farthest(physics: &PhysicsConfig, entity: Entity) -> f32 {
    physics.radius(entity)
        * match entity {
            Entity::Agent(_) => FARTHEST_CORNER,
            Entity::Object(_) => 1.0,
        }
}

/// Whether one of two entities holds the other.
fn holding(particle: &State, a: Entity, b: Entity) -> bool {
    let holds = |agent: Entity, object: Entity| match (agent, object) {
        (Entity::Agent(agent), Entity::Object(object)) => particle.holds(agent, object),
        _ => false,
    };
    holds(a, b) || holds(b, a)
}

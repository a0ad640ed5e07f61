//! The bodies and walls in rapier's terms.

use crate::contact;
use phase_model::{Body, Entity, PhysicsConfig, Segment, Vec2, arena, geometry, physics};
use rapier2d::prelude::*;

/// Thickness of the skin around agents; objects have no skin (u).
const AGENT_SKIN: f32 = 0.01;
/// Thickness of the skin around walls (u). With the tolerated penetration of skins subtracted, an agent rests
/// 0.015 u from a wall and an object 0.005 u.
const WALL_SKIN: f32 = 0.01;
/// Half the thickness of the arena's boundary (u). No body penetrates deeply enough to be pushed out on the
/// far side.
const BOUNDARY_HALF_THICKNESS: f32 = 10.0;

/// The rotation by an angle (rad), the same on every platform.
#[must_use]
pub(crate) fn rotation(angle: f32) -> Rotation {
    let (sin, cos) = libm::sincosf(angle);
    Rotation::from_cos_sin_unchecked(cos, sin)
}

/// The pose at a position (u) and an angle (rad).
#[must_use]
pub(crate) fn pose(position: Vec2, angle: f32) -> Pose {
    Pose::from_parts(position, rotation(angle))
}

/// Distance from a wall at which a body is put that was centred on it, or outside of the arena (u). The
/// engine has no direction in which it could push a disc off a surface on which its centre lies.
const MARGIN: f32 = 1e-3;

/// A point of the arena that is not on its boundary: the point itself, or the closest one.
#[must_use]
pub(crate) fn inside(point: Vec2) -> Vec2 {
    if point.cmpgt(arena::MIN).all() && point.cmplt(arena::MAX).all() {
        point
    } else {
        point.clamp(arena::MIN + MARGIN, arena::MAX - MARGIN)
    }
}

/// A point that lies on no wall: the point itself, or one beside the walls that it lies on.
fn beside(point: Vec2, walls: &[Segment]) -> Vec2 {
    let under = walls.iter().filter(|wall| wall.nearest(point) == point);
    under.fold(point, |place, wall| place + (wall.b - wall.a).perp().normalize_or(Vec2::X) * MARGIN)
}

/// The closest valid start: finite, inside the arena, on no wall, below the maximum speeds.
#[must_use]
pub(crate) fn sanitized(body: &Body, walls: &[Segment]) -> Body {
    let or = |vector: Vec2, default| if vector.is_finite() { vector } else { default };
    let or_zero = |number: f32| if number.is_finite() { number } else { 0.0 };
    Body {
        position: inside(beside(or(body.position, arena::CENTRE), walls)),
        velocity: or(body.velocity.clamp_length_max(physics::MAX_SPEED), Vec2::ZERO),
        angle: physics::valid_angle(body.angle),
        angular_velocity: or_zero(body.angular_velocity).clamp(-physics::MAX_SPIN, physics::MAX_SPIN),
    }
}

/// Adds the fixed body that carries the arena's boundary and the inner walls, and to which ground friction is
/// anchored.
pub(crate) fn insert_ground(engine: &mut PhysicsWorld, walls: &[Segment]) -> RigidBodyHandle {
    let ground = engine.insert_body(RigidBodyBuilder::fixed());
    let half_side = arena::SIDE / 2.0;
    for outward in [Vec2::X, Vec2::Y, Vec2::NEG_X, Vec2::NEG_Y] {
        let half_extents = outward.abs() * BOUNDARY_HALF_THICKNESS
            + outward.perp().abs() * (half_side + 2.0 * BOUNDARY_HALF_THICKNESS);
        let slab = ColliderBuilder::cuboid(half_extents.x, half_extents.y)
            .translation(arena::CENTRE + outward * (half_side + BOUNDARY_HALF_THICKNESS));
        engine.insert_collider(frictionless(slab).contact_skin(WALL_SKIN), Some(ground));
    }
    for wall in walls.iter().filter(|wall| wall.a.is_finite() && wall.b.is_finite()) {
        let segment = ColliderBuilder::segment(wall.a, wall.b);
        engine.insert_collider(frictionless(segment).contact_skin(WALL_SKIN), Some(ground));
    }
    ground
}

/// Adds an entity's body, with the mass, the inertia and the centre of mass that its radius implies.
pub(crate) fn insert_body(
    engine: &mut PhysicsWorld,
    physics: &PhysicsConfig,
    entity: Entity,
    start: &Body,
) -> (RigidBodyHandle, ColliderHandle) {
    let radius = physics.radius(entity);
    let collider = match entity {
        Entity::Agent(agent) => {
            let agent = &physics.agents[agent];
            let centre_of_mass = Vec2::new(0.0, -agent.centre_of_mass_offset());
            ColliderBuilder::convex_polyline(geometry::trapezoid(radius).to_vec())
                // Only an invalid radius yields no hull.
                .unwrap_or_else(|| ColliderBuilder::ball(radius))
                .contact_skin(AGENT_SKIN)
                .mass_properties(MassProperties::new(centre_of_mass, agent.mass(), agent.inertia()))
        }
        Entity::Object(_) => ColliderBuilder::ball(radius).mass_properties(MassProperties::new(
            Vec2::ZERO,
            physics::object_mass(radius),
            physics::object_inertia(radius),
        )),
    };
    let rigid_body = RigidBodyBuilder::dynamic()
        .pose(pose(start.position, start.angle))
        .linvel(start.velocity)
        .angvel(start.angular_velocity)
        .can_sleep(false)
        .allow_fast_rotation(true);
    let collider = frictionless(collider)
        .active_hooks(ActiveHooks::MODIFY_SOLVER_CONTACTS)
        .user_data(contact::tag(entity));
    engine.insert(rigid_body, collider)
}

/// Surfaces slide along each other without friction and do not bounce.
fn frictionless(builder: ColliderBuilder) -> ColliderBuilder {
    builder.friction(0.0).restitution(0.0)
}

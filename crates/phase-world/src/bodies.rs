//! The bodies and walls as rapier sees them.

use phase_model::{Body, Entity, Physique, Segment, Vec2, arena, geometry, physique};
use rapier2d::prelude::*;

/// Thickness of the skin around agents and walls; objects have none (u).
pub const SKIN: f32 = 0.01;
/// Farthest motion in one substep that is foreseen for contacts with walls (u).
const FORESEEN_MOTION: f32 = 2.0;
/// Half the thickness of the arena's boundary (u); nothing can be pushed out on the far side.
const BOUNDARY_HALF_THICKNESS: f32 = 10.0;

/// The pose of a body (u, rad).
#[must_use]
pub fn pose(position: Vec2, angle: f32) -> Pose {
    Pose::from_parts(position, rotation(angle))
}

/// The rotation by an angle (rad), computed in one way on every platform.
#[must_use]
pub fn rotation(angle: f32) -> Rotation {
    let (sin, cos) = libm::sincosf(angle);
    Rotation::from_cos_sin_unchecked(cos, sin)
}

/// Adds the fixed body that bears the arena's boundary and the inner walls, and to which ground friction is
/// anchored.
pub fn insert_ground(engine: &mut PhysicsWorld, walls: &[Segment]) -> RigidBodyHandle {
    let ground = engine.insert_body(RigidBodyBuilder::fixed());
    let half = arena::SIDE / 2.0;
    let thick = BOUNDARY_HALF_THICKNESS;
    let offset = half + thick;
    for direction in [Vec2::X, Vec2::Y, Vec2::NEG_X, Vec2::NEG_Y] {
        let along = direction.abs() * thick + direction.perp().abs() * (half + 2.0 * thick);
        let slab = ColliderBuilder::cuboid(along.x, along.y)
            .translation(arena::CENTRE + direction * offset);
        engine.insert_collider(static_collider(slab), Some(ground));
    }
    for wall in walls {
        if wall.a.is_finite() && wall.b.is_finite() {
            engine.insert_collider(static_collider(ColliderBuilder::segment(wall.a, wall.b)), Some(ground));
        }
    }
    ground
}

/// Adds an entity's body, with the mass, the inertia and the centre of mass that its radius implies.
pub fn insert_body(
    engine: &mut PhysicsWorld,
    physique: &Physique,
    entity: Entity,
    body: &Body,
) -> (RigidBodyHandle, ColliderHandle) {
    let radius = physique.radius(entity);
    let collider = match entity {
        Entity::Agent(agent) => {
            let agent = &physique.agents[usize::from(agent)];
            let centre_of_mass = Vec2::new(0.0, -agent.centre_of_mass_offset());
            ColliderBuilder::convex_polyline(geometry::trapezoid(radius).to_vec())
                .unwrap_or_else(|| ColliderBuilder::ball(radius))
                .contact_skin(crate::settings::env("SKINA", SKIN))
                .mass_properties(MassProperties::new(centre_of_mass, agent.mass(), agent.inertia()))
        }
        Entity::Object(_) => ColliderBuilder::ball(radius).mass_properties(MassProperties::new(
            Vec2::ZERO,
            physique::object_mass(radius),
            physique::object_inertia(radius),
        )),
    };
    let rigid_body = RigidBodyBuilder::dynamic()
        .pose(pose(body.position, body.angle))
        .linvel(body.velocity)
        .angvel(body.angular_velocity)
        .can_sleep(false)
        .allow_fast_rotation(true)
        .soft_ccd_prediction(FORESEEN_MOTION);
    let collider = smooth(collider)
        .active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS | ActiveHooks::MODIFY_SOLVER_CONTACTS)
        .user_data(crate::contact::tag(entity));
    engine.insert(rigid_body, collider)
}

fn static_collider(builder: ColliderBuilder) -> ColliderBuilder {
    smooth(builder).contact_skin(crate::settings::env("SKINW", 0.007))
}

/// Bodies slide along each other and along walls without friction and do not bounce.
fn smooth(builder: ColliderBuilder) -> ColliderBuilder {
    builder.friction(0.0).restitution(0.0)
}

//! Contact rules: the engine's hooks, and the contacts that are reported.

use crate::dynamic_body::DynamicBody;
use phase_model::{
    Entity, MAX_ENTITIES, Vec2,
    physics::{RELEASED_OVERLAP, release_distance},
};
use rapier2d::{
    parry::{
        bounding_volume::{Aabb, BoundingVolume},
        query,
    },
    prelude::*,
};

/// Penetration of skins that is not corrected, so that bodies at rest keep touching (u).
const SLOP: f32 = 0.005;
/// Maximum distance between two surfaces that counts as touching (u); more than all skins together.
const TOUCHING_DISTANCE: f32 = 0.02;

/// The user data of an entity's collider; walls have 0.
#[must_use]
pub(crate) fn tag(entity: Entity) -> u128 {
    entity.index() as u128 + 1
}

/// The index of the entity that a collider's user data encodes, or `None` for a wall.
fn tagged(colliders: &ColliderSet, handle: ColliderHandle) -> Option<usize> {
    let tag = colliders.get(handle)?.user_data;
    (1..=MAX_ENTITIES as u128).contains(&tag).then(|| tag as usize - 1)
}

/// The contact rules: bodies that touch at the start of a substep collide, and a released object may overlap
/// the agent that held it by up to [`RELEASED_OVERLAP`] until one of them has moved away from where it then
/// was.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactRules {
    /// For every released pair, where the first of the two may overlap the second.
    released: [[Option<Aabb>; MAX_ENTITIES]; MAX_ENTITIES],
}

impl ContactRules {
    /// Lets a pair overlap slightly until one of them has left its present place.
    pub(crate) fn release(&mut self, engine: &PhysicsWorld, a: &DynamicBody, b: &DynamicBody) {
        for (one, other) in [(a, b), (b, a)] {
            let body = &engine.bodies[one.body];
            let room = release_distance(body.linvel().length());
            let place = Aabb::from_half_extents(body.center_of_mass(), Vec2::splat(room));
            self.released[one.entity.index()][other.entity.index()] = Some(place);
        }
    }

    /// Ends the tolerance of released pairs once one of them has left its place.
    pub(crate) fn restore_clear(&mut self, engine: &PhysicsWorld, dynamic_bodies: &[DynamicBody]) {
        for dynamic_body in dynamic_bodies {
            let this = dynamic_body.entity.index();
            let centre = engine.bodies[dynamic_body.body].center_of_mass();
            for other in 0..MAX_ENTITIES {
                if self.released[this][other].is_some_and(|place| !place.contains_local_point(centre)) {
                    self.released[this][other] = None;
                    self.released[other][this] = None;
                }
            }
        }
    }
}

impl ContactRules {
    /// The overlap that contacts of a pair of colliders do not resist (u).
    fn tolerated_overlap(&self, colliders: &ColliderSet, pair: [ColliderHandle; 2]) -> f32 {
        match pair.map(|collider| tagged(colliders, collider)) {
            [Some(a), Some(b)] if self.released[a][b].is_some() => RELEASED_OVERLAP,
            _ => 0.0,
        }
    }
}

impl PhysicsHooks for ContactRules {
    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let tolerated = self.tolerated_overlap(context.colliders, [context.collider1, context.collider2]);
        let Some(manifold) = context.rigid_mut() else { return };
        manifold.solver_contacts.retain(|contact| contact.dist + tolerated <= 0.0);
        for contact in manifold.solver_contacts.iter_mut() {
            contact.dist = (contact.dist + tolerated + SLOP).min(0.0);
        }
    }
}

/// Whether two bodies touch at their present poses, by the engine's own contact query.
pub(crate) fn touching(engine: &PhysicsWorld, a: &DynamicBody, b: &DynamicBody) -> bool {
    let placed = |dynamic_body: &DynamicBody| {
        let shape = engine.colliders.get(dynamic_body.collider)?.shape();
        Some((engine.bodies.get(dynamic_body.body)?.position(), shape))
    };
    let (Some((pose1, shape1)), Some((pose2, shape2))) = (placed(a), placed(b)) else { return false };
    let near = shape1.compute_aabb(pose1).loosened(TOUCHING_DISTANCE).intersects(&shape2.compute_aabb(pose2));
    near && matches!(query::contact(pose1, shape1, pose2, shape2, TOUCHING_DISTANCE), Ok(Some(_)))
}

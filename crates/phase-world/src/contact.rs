//! Which contacts count: the rules the engine asks for, and the contacts it reports.

use phase_model::{Entity, MAX_ENTITIES};
use rapier2d::prelude::*;

/// Penetration that is left alone so that resting contacts persist (u).
const SLOP: f32 = 0.005;
/// Greatest distance between two surfaces, skins included, that counts as touching (u).
const TOUCHING_DISTANCE: f32 = 0.02;

/// The mark of an entity's collider; walls bear 0.
#[must_use]
pub fn tag(entity: Entity) -> u128 {
    entity.index() as u128 + 1
}

/// The entity whose mark a collider bears, or `None` for a wall.
fn tagged(colliders: &ColliderSet, handle: ColliderHandle) -> Option<usize> {
    let tag = colliders.get(handle)?.user_data;
    (1..=MAX_ENTITIES as u128).contains(&tag).then(|| tag as usize - 1)
}

/// Pairs of bodies that pass through each other: held ones, and those let go that still overlap.
#[derive(Clone, Copy, Debug, Default)]
pub struct ContactRules {
    released: [[bool; MAX_ENTITIES]; MAX_ENTITIES],
}

impl ContactRules {
    /// Lets a pair overlap until it has moved clear.
    pub fn release(&mut self, a: Entity, b: Entity) {
        self.set(a.index(), b.index(), true);
    }

    /// Restores the contact of every released pair that has moved clear.
    pub fn restore_clear(&mut self, engine: &PhysicsWorld, colliders: &[ColliderHandle]) {
        for a in 0..colliders.len() {
            for b in 0..a {
                if self.released[a][b]
                    && distance(engine, colliders[a], colliders[b]).is_none_or(|distance| distance > 0.0)
                {
                    self.set(a, b, false);
                }
            }
        }
    }

    fn set(&mut self, a: usize, b: usize, value: bool) {
        self.released[a][b] = value;
        self.released[b][a] = value;
    }
}

impl PhysicsHooks for ContactRules {
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        let pair = (
            tagged(context.colliders, context.collider1),
            tagged(context.colliders, context.collider2),
        );
        match pair {
            (Some(a), Some(b)) if self.released[a][b] => Some(SolverFlags::empty()),
            _ => Some(SolverFlags::COMPUTE_RIGID_IMPULSES),
        }
    }

    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let between_bodies = tagged(context.colliders, context.collider1).is_some()
            && tagged(context.colliders, context.collider2).is_some();
        let Some(manifold) = context.rigid_mut() else { return };
        if between_bodies {
            // Bodies collide once they touch; only walls, which are thin, are foreseen.
            manifold.solver_contacts.retain(|contact| contact.dist <= 0.0);
        }
        for contact in manifold.solver_contacts.iter_mut() {
            if contact.dist <= 0.0 {
                let slop = if between_bodies { crate::settings::env("SLOPB", SLOP) } else { crate::settings::env("SLOPW", 0.002) }; contact.dist = (contact.dist + slop).min(0.0);
            }
        }
    }
}

/// Whether two bodies touch at their present poses.
#[must_use]
pub fn touching(engine: &PhysicsWorld, a: ColliderHandle, b: ColliderHandle) -> bool {
    distance(engine, a, b).is_some_and(|distance| distance <= TOUCHING_DISTANCE)
}

/// Distance between two surfaces at the bodies' present poses, from the contact points that the engine's
/// narrow phase last found (u; negative for overlap), or `None` if it found none.
fn distance(engine: &PhysicsWorld, a: ColliderHandle, b: ColliderHandle) -> Option<f32> {
    let pair = engine.narrow_phase.contact_pair(a, b)?;
    let pose1 = body_pose(engine, pair.collider1)?;
    let pose2 = body_pose(engine, pair.collider2)?;
    pair.manifolds()
        .iter()
        .flat_map(|manifold| {
            let normal = pose1.rotation * manifold.local_n1;
            manifold
                .points
                .iter()
                .map(move |point| (pose2 * point.local_p2 - pose1 * point.local_p1).dot(normal))
        })
        .reduce(f32::min)
}

/// The present pose of the body that bears a collider. The collider's own pose lags behind a corrected body.
fn body_pose(engine: &PhysicsWorld, collider: ColliderHandle) -> Option<Pose> {
    let body = engine.colliders.get(collider)?.parent()?;
    engine.bodies.get(body).map(|body| *body.position())
}

/// Whether a body was stopped by a wall that it did not touch before the last substep.
#[must_use]
pub fn struck_wall(engine: &PhysicsWorld, collider: ColliderHandle) -> bool {
    engine.narrow_phase.contact_pairs_with(collider).any(|pair| {
        let other = if pair.collider1 == collider { pair.collider2 } else { pair.collider1 };
        let skins: f32 = [pair.collider1, pair.collider2].iter().filter_map(|&c| engine.colliders.get(c)).map(|c| c.contact_skin()).sum();
        tagged(&engine.colliders, other).is_none()
            && pair.manifolds().iter().flat_map(|manifold| &manifold.points).any(|point| point.dist > skins + crate::settings::env("STRUCK", 0.07) && point.data.impulse > 0.0)
    })
}

//! One substep of the engine, with ground friction along the direction in which bodies slide.

use crate::{
    contact::ContactRules,
    dynamic_body::{DynamicBody, PoseAndVelocity},
    friction::FrictionDirection,
    impact::Impacts,
};
use rapier2d::prelude::*;

/// Maximum number of iterations of a substep. Free bodies need one, bodies in contact mostly two or three.
const MAX_ITERATIONS: usize = 3;

/// Advances all bodies by one substep of 1/60 s, their forces being set.
///
/// The direction of friction depends on the motion it acts on. So the substep is computed with the direction
/// predicted from each body's own push, and if contacts or welds made a body slide in another direction, it
/// is repeated from the same start with the direction found. Impacts on walls are resolved last, body by
/// body.
pub(crate) fn advance(
    engine: &mut PhysicsWorld,
    impacts: Impacts,
    dynamic_bodies: &mut [DynamicBody],
    rules: &ContactRules,
) {
    let before: Vec<_> = dynamic_bodies.iter().map(|dynamic_body| dynamic_body.motion(engine)).collect();
    let mut directions: Vec<FrictionDirection> = dynamic_bodies
        .iter()
        .map(|dynamic_body| FrictionDirection::predicted(&engine.bodies[dynamic_body.body]))
        .collect();
    for take in 1..=MAX_ITERATIONS {
        for (dynamic_body, direction) in dynamic_bodies.iter().zip(&directions) {
            direction.apply(engine, dynamic_body.friction);
        }
        engine.step_with_events(rules, &());
        if take == MAX_ITERATIONS || !update_directions(&mut directions, engine, dynamic_bodies, &before) {
            break;
        }
        for (dynamic_body, &motion) in dynamic_bodies.iter().zip(&before) {
            dynamic_body.restore(engine, motion);
        }
    }
    for (dynamic_body, motion) in dynamic_bodies.iter_mut().zip(&before) {
        let angle = dynamic_body.angle;
        dynamic_body.correct_turn(engine, motion);
        impacts.resolve(engine, dynamic_body, motion, angle);
        dynamic_body.clamp_to_arena(engine);
    }
}

/// Replaces the friction directions by those that follow from the motion found; returns whether any differs.
fn update_directions(
    directions: &mut [FrictionDirection],
    engine: &PhysicsWorld,
    dynamic_bodies: &[DynamicBody],
    before: &[PoseAndVelocity],
) -> bool {
    let mut improved = false;
    for ((direction, dynamic_body), motion) in directions.iter_mut().zip(dynamic_bodies).zip(before) {
        let better = dynamic_body.corrected_direction(engine, motion);
        improved |= !better.is_close_to(direction);
        *direction = better;
    }
    improved
}

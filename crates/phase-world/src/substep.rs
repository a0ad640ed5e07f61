//! One substep of the engine, with ground friction aimed where the bodies slide.

use crate::{
    contact::ContactRules,
    dynamic_body::{DynamicBody, PoseAndVelocity},
    friction::FrictionDirection,
    impact::Impacts,
};
use rapier2d::prelude::*;

/// How often a substep is taken at most. Free bodies need one take, bodies in contact mostly two or three.
const MAX_ITERATIONS: usize = 3;

/// Advances all bodies by one substep of 1/60 s, their forces being set.
///
/// The direction of friction follows from the motion it acts on. So the substep is taken with the direction
/// foreseen from each body's own push, and if contacts or welds made a body slide another way, it is taken
/// again from the same start with the direction found. Impacts on walls are played out last, body by body.
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

/// Replaces the aims by those that the motion found calls for; tells whether any differs.
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

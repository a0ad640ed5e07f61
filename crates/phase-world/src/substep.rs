//! One substep of the engine, with ground friction aimed where the bodies slide.

use crate::{
    contact,
    contact::ContactRules,
    friction::Aim,
    mover::{Motion, Mover},
};
use rapier2d::prelude::*;

/// How often a substep is taken at most. Free bodies need one take, bodies in contact mostly two or three.
const MAX_TAKES: usize = 3;

/// Advances all bodies by one substep of 1/60 s, their forces being set.
///
/// The direction of friction follows from the motion it acts on. So the substep is taken with the direction
/// foreseen from each body's own push, and if contacts or welds made a body slide another way, it is taken
/// again from the same start with the direction found.
pub(crate) fn advance(engine: &mut PhysicsWorld, movers: &mut [Mover], rules: &ContactRules) {
    let before: Vec<_> = movers.iter().map(|mover| mover.motion(engine)).collect();
    let mut aims: Vec<Aim> = movers.iter().map(|mover| Aim::foreseen(&engine.bodies[mover.body])).collect();
    for take in 1..=MAX_TAKES {
        for (mover, aim) in movers.iter().zip(&aims) {
            aim.apply(engine, mover.friction);
        }
        engine.step_with_events(rules, &());
        if take == MAX_TAKES || !improve(&mut aims, engine, movers, &before) {
            break;
        }
        for (mover, &motion) in movers.iter().zip(&before) {
            mover.restore(engine, motion);
        }
    }
    for (mover, motion) in movers.iter_mut().zip(&before) {
        mover.correct_turn(engine, motion);
    }
}

/// Replaces the aims by those that the motion found calls for; tells whether any differs.
fn improve(aims: &mut [Aim], engine: &PhysicsWorld, movers: &[Mover], before: &[Motion]) -> bool {
    let mut improved = false;
    for ((aim, mover), motion) in aims.iter_mut().zip(movers).zip(before) {
        // A wall that stops a body in mid-flight takes its velocity at once, friction or not: until then the
        // body slid as foreseen.
        if !contact::hit_wall(engine, mover.collider) {
            let better = mover.better_aim(engine, motion);
            improved |= !better.agrees_with(aim);
            *aim = better;
        }
    }
    improved
}

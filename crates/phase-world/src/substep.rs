//! One substep of the engine, with ground friction aimed where the bodies slide.

use crate::{
    contact::ContactRules,
    friction::Aim,
    impact::Impacts,
    mover::{Motion, Mover},
};
use rapier2d::prelude::*;

/// How often a substep is taken at most. Free bodies need one take, bodies in contact mostly two or three.
const MAX_TAKES: usize = 3;

/// Advances all bodies by one substep of 1/60 s, their forces being set.
///
/// The direction of friction follows from the motion it acts on. So the substep is taken with the direction
/// foreseen from each body's own push, and if contacts or welds made a body slide another way, it is taken
/// again from the same start with the direction found. Impacts on walls are played out last, body by body.
pub(crate) fn advance(
    engine: &mut PhysicsWorld,
    impacts: Impacts,
    movers: &mut [Mover],
    rules: &ContactRules,
) {
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
        let angle = mover.angle;
        mover.correct_turn(engine, motion);
        impacts.play_out(engine, mover, motion, angle);
        mover.stay_inside(engine);
    }
}

/// Replaces the aims by those that the motion found calls for; tells whether any differs.
fn improve(aims: &mut [Aim], engine: &PhysicsWorld, movers: &[Mover], before: &[Motion]) -> bool {
    let mut improved = false;
    for ((aim, mover), motion) in aims.iter_mut().zip(movers).zip(before) {
        let better = mover.better_aim(engine, motion);
        improved |= !better.agrees_with(aim);
        *aim = better;
    }
    improved
}

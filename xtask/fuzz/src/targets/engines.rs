//! Both engines in valid scenes with extreme starts, under any actions.

use crate::{
    draw::{Bytes, Draw},
    engines::{Kind, Running},
    scenes::{Doing, Start, actions, energy, physique, start},
};
use phase_forward::Forward;
use phase_model::{Body, PhysicsConfig, State, Vec2, arena};

/// Steps of a scene.
const STEPS: usize = 8;
/// Greatest distance of an origin outside the arena in the kernel, which keeps centres of mass inside (u).
const OUTSIDE: f32 = 0.3;
/// A scene, and a start with any numbers in it.
fn scene(bytes: &mut Bytes<'_>) -> (PhysicsConfig, State) {
    let physics = physique(bytes);
    let kind = bytes.pick(&Start::ALL);
    let extreme = bytes.below(2) == 0;
    let state = start(&physics, kind, bytes);
    // Bodies that found no room are put anywhere.
    let mut state = state.unwrap_or_else(|| State::new([Body::at_rest(arena::CENTRE, 0.0); 4]));
    if extreme {
        for body in &mut state.bodies {
            match bytes.below(4) {
                0 => body.velocity = Vec2::new(bytes.any_float(), bytes.any_float()),
                1 => body.angular_velocity = bytes.any_float(),
                2 => body.angle = bytes.any_float(),
                _ => {}
            }
        }
    }
    (physics, state)
}

/// Nothing that is no number, and nothing outside. There is no bound of speeds: an impact turns the spin of a
/// body, which may begin with any, into speed of another.
fn check(physics: &PhysicsConfig, after: &State, outside: f32) {
    assert!(after.is_finite(physics), "not finite: {after:?}");
    for entity in physics.entities() {
        let place = after.position(entity);
        let out = place.distance(place.clamp(arena::MIN, arena::MAX));
        assert!(out <= outside, "{entity:?} is {out} u outside: {after:?}");
    }
    assert!(energy(physics, after).is_finite());
}

/// The reference world.
pub(super) fn world(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let (physics, state) = scene(&mut bytes);
    let mut engine = Running::new(Kind::World, &physics, &state);
    for actions in actions(Doing::Anything, STEPS, &mut bytes) {
        for after in engine.step(actions) {
            check(&physics, &after, 0.0);
        }
    }
}

/// The kernel, with its cache and without, exact and coarse.
pub(super) fn kernel(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let (physics, state) = scene(&mut bytes);
    let actions = actions(Doing::Anything, STEPS, &mut bytes);
    for kind in [Kind::Kernel, Kind::KernelWithCache] {
        let mut engine = Running::new(kind, &physics, &state);
        for &actions in &actions {
            for after in engine.step(actions) {
                check(&physics, &after, OUTSIDE);
            }
        }
    }
    let forward = Forward::new(&physics);
    let mut coarse = state;
    for &actions in &actions {
        forward.step_coarse(&mut coarse, actions);
        check(&physics, &coarse, OUTSIDE);
    }
}

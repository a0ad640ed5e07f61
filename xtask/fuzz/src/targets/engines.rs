//! Both engines in valid scenes with extreme starts, under any actions.

use crate::{
    draw::{Bytes, Draw},
    engines::{Kind, Running},
    scenes::{Doing, Start, actions, energy, physique, start},
};
use phase_forward::{Exertion, Forward};
use phase_model::{
    AGENT_COUNT, Action, Body, Dynamics, PhysicsConfig, State, Strength, Vec2, arena, arena::SUBSTEPS,
};

/// Steps of a scene.
const STEPS: usize = 8;
/// Worlds in lanes.
const WORLDS: usize = 11;
/// How far an origin may be outside the arena in the kernel, which keeps centres of mass inside (u).
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

/// Nothing that is no number, and nothing outside. There is no bound of speeds: an impact turns the spin of a body, which may begin with any,
/// into speed of another.
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

/// Worlds in lanes beside each of them alone, bit for bit.
pub(super) fn lanes(data: &[u8]) {
    type All = fn(&Forward, &mut [State], &[[Action; AGENT_COUNT]]);
    type One = fn(&Forward, &mut State, [Action; AGENT_COUNT]);
    let mut bytes = Bytes::new(data);
    let (physics, first) = scene(&mut bytes);
    let worlds = 1 + bytes.below(WORLDS);
    let same = bytes.below(2) == 0;
    let mut states = vec![first; worlds];
    if !same {
        for state in states.iter_mut().skip(1) {
            let kind = bytes.pick(&Start::ALL);
            if let Some(other) = start(&physics, kind, &mut bytes) {
                *state = other;
            }
        }
    }
    let forward = match bytes.below(3) {
        0 => Forward::new(&physics).without_collisions(),
        1 => Forward::imagined(&physics),
        _ => Forward::new(&physics),
    };
    let ways: [(All, One); 2] = [
        (Forward::step_batch, |forward, state, actions| forward.step(state, actions)),
        (Forward::step_approximate_batch, Forward::step_coarse),
    ];
    for (all, one) in ways {
        let mut together = states.clone();
        for _ in 0..4 {
            let both: Vec<_> =
                (0..worlds).map(|_| [(); AGENT_COUNT].map(|()| bytes.pick(&Action::ALL))).collect();
            let mut alone = together.clone();
            all(&forward, &mut together, &both);
            for (state, &actions) in alone.iter_mut().zip(&both) {
                one(&forward, state, actions);
            }
            for (a, b) in together.iter().zip(&alone) {
                assert_eq!(bits(&physics, a), bits(&physics, b), "lanes differ: {a:?} {b:?}");
            }
        }
    }
    lanes_with_caches(&forward, &physics, states, &mut bytes);
}

/// The same with caches, by agents of any strength.
fn lanes_with_caches(
    forward: &Forward,
    physics: &PhysicsConfig,
    mut states: Vec<State>,
    bytes: &mut Bytes<'_>,
) {
    let mut caches: Vec<_> = states.iter().map(|state| forward.fresh_cache(state)).collect();
    let mut substeps: Vec<_> = states.iter().map(|state| [*state; SUBSTEPS]).collect();
    for _ in 0..4 {
        let mut exertion = || Exertion {
            actions: [(); AGENT_COUNT].map(|()| bytes.pick(&Action::ALL)),
            max_forces: [(); AGENT_COUNT].map(|()| bytes.pick(&Strength::ALL).max_force()),
        };
        let exertions: Vec<_> = states.iter().map(|_| exertion()).collect();
        let mut alone: Vec<_> = states.iter().copied().zip(caches.iter().copied()).collect();
        forward.step_warm_batch(&mut states, &mut caches, &exertions, &mut substeps);
        for (world, (state, cache)) in alone.iter_mut().enumerate() {
            let expected = forward.step_warm_with(state, cache, &exertions[world]);
            for (a, b) in substeps[world].iter().zip(&expected) {
                assert_eq!(bits(physics, a), bits(physics, b), "lanes differ: {a:?} {b:?}");
            }
            assert_eq!(bits(physics, &states[world]), bits(physics, state), "lanes differ");
            assert_eq!(format!("{:?}", caches[world]), format!("{cache:?}"), "caches differ");
        }
    }
}

fn bits(physics: &PhysicsConfig, state: &State) -> (Vec<[u32; 6]>, String) {
    let numbers = |body: &Body| {
        let Body { position, velocity, angle, angular_velocity } = *body;
        [position.x, position.y, velocity.x, velocity.y, angle, angular_velocity].map(f32::to_bits)
    };
    let bodies = state.bodies[..physics.entity_count()].iter().map(numbers).collect();
    (bodies, format!("{:?} {:?}", state.grips, state.contacts))
}

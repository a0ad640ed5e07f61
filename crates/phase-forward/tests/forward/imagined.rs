//! The published planner's idea of the dynamics: a held object hangs on a spring that keeps its distance and
//! no more.

use phase_forward::{Forward, Imagined, OriginalWorld};
use phase_model::{
    Action, AgentBody, AgentId, Body, Dynamics, Entity, Grip, ObjectId, PhysicsConfig, Side, State, Vec2,
    arena::SUBSTEPS,
};

const ME: Entity = Entity::Agent(AgentId::ZERO);
const BALL: Entity = Entity::Object(ObjectId::ZERO);
const RADIUS: f32 = 0.8;
/// Distance of an object that is not held from where it would be (u).
const WITHIN_REACH: f32 = 0.4;
/// Stretch of the fastest swing in a step, in which the spring is straight only at its start (u).
const MAX_STRETCH: f32 = 0.1;

fn physics() -> PhysicsConfig {
    let body = AgentBody { radius: RADIUS, max_force: 450.0 };
    PhysicsConfig { walls: Vec::new(), agents: [body; 2], object_radii: [RADIUS; 2], object_count: 1 }
}

/// An agent that faces +y with an object in front of its head, a little further if it is not held; another
/// far away.
fn holding(held: bool) -> State {
    let places =
        [Vec2::new(10.0, 8.0), Vec2::new(22.0, 18.0), Vec2::new(10.0, 8.0 + 2.0 * RADIUS), Vec2::ZERO];
    let mut state = State::new(places.map(|place| Body::at_rest(place, 0.0)));
    if held {
        state.grips[0] = Some(Grip { object: ObjectId::ZERO, side: Side::Head, relative_angle: 0.0 });
    } else {
        state.body_mut(BALL).position.y += WITHIN_REACH;
    }
    state
}

fn step(forward: &dyn Dynamics, mut state: State, action: Action) -> State {
    forward.step(&mut state, [action, Action::NoForce]);
    state
}

/// Displacement from rest in a step: (F − 200 N) · 15 / (3600 (m + m')).
#[test]
fn pushed_straight_both_models_carry_alike() {
    let mass = 4.0 * RADIUS * RADIUS + core::f32::consts::PI * RADIUS * RADIUS;
    let expected = (450.0 - 200.0) * 15.0 / (3600.0 * mass);
    let models: [&dyn Dynamics; 2] = [&Forward::new(&physics()), &Imagined::new(&physics())];
    for forward in models {
        let after = step(forward, holding(true), Action::Up);
        for (entity, start) in [(ME, 8.0), (BALL, 8.0 + 2.0 * RADIUS)] {
            let moved = after.position(entity).y - start;
            assert!((moved - expected).abs() < 0.01, "{entity}: {moved} instead of {expected}");
        }
    }
}

/// On a spring an agent turns as if its hands were free, and the object stays; welded it has to swing it
/// along.
#[test]
fn turning_leaves_the_object_where_it_is() {
    let imagined = Imagined::new(&physics());
    let free = step(&imagined, holding(false), Action::TurnLeft).body(ME).angle;
    let after = step(&imagined, holding(true), Action::TurnLeft);
    assert!((free - 1.0172).abs() < 1e-3, "{free}");
    assert!((after.body(ME).angle - free).abs() < 0.05);
    assert!(after.position(BALL).distance(holding(true).position(BALL)) < 0.1);
    let welded = step(&Forward::new(&physics()), holding(true), Action::TurnLeft).body(ME).angle;
    assert!((welded - 0.112).abs() < 0.01, "{welded}");
}

/// Whatever the agent does, the distance of the two origins stays.
#[test]
fn the_distance_stays() {
    let imagined = Imagined::new(&physics());
    let mut state = holding(true);
    for action in Action::ALL.into_iter().filter(|&action| action != Action::Detach) {
        for _ in 0..3 {
            let before = state.position(ME).distance(state.position(BALL));
            state = step(&imagined, state, action);
            let after = state.position(ME).distance(state.position(BALL));
            assert!((after - before).abs() < MAX_STRETCH, "{action:?}: {before} to {after}");
        }
    }
}

/// A push to the side acts at the origin, R/6 ahead of the centre of mass, instead of R/12 behind that.
#[test]
fn lateral_pushes_turn_twice_as_much() {
    let turn = |forward: &dyn Dynamics| step(forward, holding(false), Action::Left).body(ME).angle;
    let (real, imagined) = (turn(&Forward::new(&physics())), turn(&Imagined::new(&physics())));
    assert!(real * imagined > 0.0 && imagined.abs() > real.abs(), "{real}, {imagined}");
}

/// What is grabbed in the step itself is welded, in both models.
#[test]
fn a_fresh_grip_is_a_weld() {
    let apart = holding(false);
    let real = step(&Forward::new(&physics()), apart, Action::Attach);
    let imagined = step(&Imagined::new(&physics()), apart, Action::Attach);
    assert_eq!(real.grips[0].map(|grip| grip.side), Some(Side::Head));
    assert!((imagined.position(BALL) - real.position(BALL)).length() < 1e-5);
}

/// An object is in reach if its stated place is, and is then pulled from its own place.
#[test]
fn reach_is_measured_to_stated_places() {
    let imagined = Imagined::new(&physics());
    let mut state = holding(false);
    let near = state.position(BALL);
    state.body_mut(BALL).position.y += 3.0;
    let attach = [Action::Attach, Action::NoForce];
    let mut out_of_reach = state;
    imagined.step(&mut out_of_reach, attach);
    assert_eq!(out_of_reach.grips[0], None);
    let far = state.position(BALL);
    imagined.step_reaching(AgentId::ZERO, &mut state, attach, [near, Vec2::ZERO]);
    assert!(state.grips[0].is_some() && state.position(BALL).distance(far) > 1.0);
}

/// `stop` has no effect on the strongest where the recorder had none.
#[test]
fn the_strongest_coast() {
    let mut strong = physics();
    strong.agents[0].max_force = 600.0;
    for (physics, coasts) in [(physics(), false), (strong, true)] {
        let mut state = holding(false);
        state.body_mut(BALL).position.x += 8.0;
        state.body_mut(ME).velocity.y = 20.0;
        let after = step(&Imagined::new(&physics).with_coasting_strongest(), state, Action::Stop);
        assert_eq!(after.body(ME).velocity.y > 0.0, coasts);
    }
}

/// From rest, n substeps of a push take an agent (F − 100 N) n (n + 1) / (7200 m) far, if speed carries over.
#[test]
fn speed_lasts_in_the_original_world() {
    const STEPS: usize = 3;
    let mut world = OriginalWorld::new(&physics(), &holding(false));
    for _ in 0..STEPS {
        world.step([Action::Down, Action::NoForce]);
    }
    let substeps = (STEPS * SUBSTEPS) as f32;
    let expected = (450.0 - 100.0) * substeps * (substeps + 1.0) / (7200.0 * physics().agents[0].mass());
    let moved = 8.0 - world.state().position(ME).y;
    assert!((moved - expected).abs() < 1e-3, "{moved} instead of {expected}");
}

/// A grip pulls the object to the hand, and both turn together.
#[test]
fn grips_of_the_original_world_are_rigid() {
    const TWIST: f32 = 0.04;
    let mut world = OriginalWorld::new(&physics(), &holding(false));
    world.step([Action::Attach, Action::NoForce]);
    for _ in 0..4 {
        world.step([Action::TurnLeft, Action::NoForce]);
    }
    let state = world.state();
    let turned = state.body(ME).angle;
    assert!(turned > 0.2, "{turned}");
    assert!((state.body(BALL).angle - turned).abs() < TWIST, "{}", state.body(BALL).angle);
    let distance = state.position(ME).distance(state.position(BALL));
    assert!((distance - 2.0 * RADIUS).abs() < 0.02, "{distance}");
}

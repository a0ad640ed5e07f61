//! Dynamics without collisions between bodies.

use phase_forward::Forward;
use phase_model::{
    Action, AgentBody, AgentId, Body, Dynamics, Entity, ObjectId, PhysicsConfig, Segment, State, Vec2,
};

const ME: Entity = Entity::Agent(AgentId::ZERO);
const OTHER: Entity = Entity::Agent(AgentId::ONE);
const BALL: Entity = Entity::Object(ObjectId::ZERO);
const RADIUS: f32 = 0.8;
/// Where nothing is in reach of the others (u).
const FAR: Vec2 = Vec2::new(24.0, 19.0);
/// Speed of a body on a collision course (u/s), enough to pass through the other in [`STEPS`] whatever the
/// ground takes.
const SPEED: f32 = 20.0;
const STEPS: usize = 12;

/// Both kinds of steps.
const STEPPERS: [fn(&Forward, &mut State); 2] = [
    |forward, state| forward.step(state, [Action::NoForce; 2]),
    |forward, state| forward.step_coarse(state, [Action::NoForce; 2]),
];

fn physics(walls: Vec<Segment>) -> PhysicsConfig {
    let body = AgentBody { radius: RADIUS, max_force: 450.0 };
    PhysicsConfig { walls, agents: [body; 2], object_radii: [RADIUS; 2], object_count: 1 }
}

/// An agent that moves to the right at the given speed (u/s), and nobody in its way.
fn moving(speed: f32) -> State {
    let places = [Vec2::new(8.0, 10.0), FAR, Vec2::new(8.0, 18.0), Vec2::ZERO];
    let mut state = State::new(places.map(|place| Body::at_rest(place, 0.0)));
    state.body_mut(ME).velocity = Vec2::new(speed, 0.0);
    state
}

/// The same with this entity in its way.
fn in_the_way(entity: Entity) -> State {
    let mut state = moving(SPEED);
    state.body_mut(entity).position = Vec2::new(11.0, 10.0);
    state
}

/// What remains of the agent after some steps.
fn after(forward: &Forward, mut state: State, step: fn(&Forward, &mut State)) -> State {
    for _ in 0..STEPS {
        step(forward, &mut state);
    }
    state
}

#[test]
fn bodies_on_a_collision_course_pass_through_each_other() {
    let points = Forward::new(&physics(Vec::new())).without_collisions();
    for step in STEPPERS {
        let alone = after(&points, moving(SPEED), step);
        assert!(alone.position(ME).x > 11.0 + 2.0 * RADIUS, "{}", alone.position(ME));
        for entity in [OTHER, BALL] {
            let met = after(&points, in_the_way(entity), step);
            assert_eq!(met.body(ME), alone.body(ME), "it keeps its speed");
            assert_eq!(met.body(entity), in_the_way(entity).body(entity), "the other is not moved");
        }
    }
}

#[test]
fn with_collisions_they_do_not() {
    let solid = Forward::new(&physics(Vec::new()));
    for step in STEPPERS {
        for entity in [OTHER, BALL] {
            let met = after(&solid, in_the_way(entity), step);
            assert!(met.position(ME).x < met.position(entity).x, "{entity}");
            assert!(met.position(entity).x > 11.1, "{entity}");
        }
    }
}

#[test]
fn warm_steps_have_no_collisions_either() {
    let points = Forward::new(&physics(Vec::new())).without_collisions();
    let run = |mut state: State| {
        let mut cache = points.fresh_cache(&state);
        for _ in 0..STEPS {
            points.step_warm(&mut state, &mut cache, [Action::NoForce; 2]);
        }
        *state.body(ME)
    };
    assert_eq!(run(in_the_way(BALL)), run(moving(SPEED)));
}

#[test]
fn walls_stop_bodies_as_before() {
    let wall = Segment { a: Vec2::new(11.0, 5.0), b: Vec2::new(11.0, 15.0) };
    let solid = Forward::new(&physics(vec![wall]));
    let points = solid.clone().without_collisions();
    for step in STEPPERS {
        let stopped = after(&points, moving(SPEED), step);
        assert!(stopped.position(ME).x < 11.0, "{}", stopped.position(ME));
        assert_eq!(stopped, after(&solid, moving(SPEED), step));
    }
}

#[test]
fn objects_are_grabbed_and_carried_as_before() {
    let solid = Forward::new(&physics(Vec::new()));
    let points = solid.clone().without_collisions();
    let mut start = moving(0.0);
    start.body_mut(BALL).position = Vec2::new(8.0, 10.0 + 2.0 * RADIUS + 0.2);
    let carried = |forward: &Forward| {
        let mut state = start;
        for action in [Action::Attach, Action::Up, Action::Up] {
            forward.step(&mut state, [action, Action::NoForce]);
        }
        state
    };
    assert_eq!(carried(&points).held_object(AgentId::ZERO), Some(ObjectId::ZERO));
    assert!(carried(&points).position(BALL).y > start.position(BALL).y);
    assert_eq!(carried(&points), carried(&solid));
}

#[test]
fn overlapping_bodies_count_as_touching() {
    let points = Forward::new(&physics(Vec::new())).without_collisions();
    for step in STEPPERS {
        let mut state = in_the_way(OTHER);
        state.body_mut(ME).position = state.position(OTHER);
        state.body_mut(ME).velocity = Vec2::ZERO;
        step(&points, &mut state);
        assert!(state.contacts.touching(ME, OTHER));
        assert_eq!(state.position(ME), state.position(OTHER));
    }
}

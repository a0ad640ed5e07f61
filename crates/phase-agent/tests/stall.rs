//! Which agents back off after a stall, and where to.

use phase_agent::{objective::Objective, stall::StallDetector};
use phase_model::{
    AgentId, Body, Entity, Grip, LandmarkId, Layout, Literal, ObjectId, PhysicsConfig, Predicate, Side,
    State, Subgoal, Vec2,
    physics::AgentBody,
    random::{Purpose, stream},
};
use phase_planner::Routes;

/// Layout 4, with a narrow door (x 6 to 8.5, y 12); agent 0 of some force; a small object.
fn place_to_go_to(force: f32, state: &State, literal: Literal, moves: f32) -> Option<Vec2> {
    let layout = Layout::new(4, None).expect("layout 4");
    let physics = PhysicsConfig {
        walls: layout.walls(),
        agents: [AgentBody { radius: 0.8, max_force: force }; 2],
        object_radii: [0.8, 0.0],
        object_count: 1,
    };
    let routes = Routes::new(layout);
    let objective = Objective {
        physics: &physics,
        routes: &routes,
        agent: AgentId::ZERO,
        subgoal: Subgoal::Achieve(literal),
        backoff: None,
    };
    let (mut stall, mut random) = (StallDetector::default(), stream(1, Purpose::Search, 0));
    let mut state = *state;
    (0..40).find_map(|_| {
        state.body_mut(Entity::Agent(AgentId::ZERO)).position.x += moves;
        stall.update(&objective, &state, &mut random)
    })
}

/// Agent 0 at a position, the object before it, held or not; the other far away.
fn state(at: Vec2, held: bool) -> State {
    let mut state = State::new([
        Body::at_rest(at, 0.0),
        Body::at_rest(Vec2::new(24.0, 20.0), 0.0),
        Body::at_rest(at + Vec2::new(0.0, 1.6), 0.0),
        Body::default(),
    ]);
    state.grips[0] = held.then_some(Grip { object: ObjectId::ZERO, side: Side::Head, relative_angle: 0.0 });
    state
}

#[test]
fn who_does_not_get_on_goes_back() {
    let to_landmark = Literal::is(Predicate::On(Entity::Agent(AgentId::ZERO), LandmarkId::BOTTOM_RIGHT));
    let at = Vec2::new(18.0, 7.0);
    let stuck = place_to_go_to(300.0, &state(at, false), to_landmark, 0.0);
    let desired_direction = (Vec2::new(23.5, 4.5) - at).normalize();
    let backoff_point = stuck.expect("patience is lost some time") - at;
    assert!(backoff_point.dot(desired_direction) < -1.0, "{backoff_point}");
    // With a wall behind, to the side: from below the wall at y 12 straight down.
    let below = Vec2::new(12.0, 11.0);
    let down = Literal::is(Predicate::On(Entity::Agent(AgentId::ZERO), LandmarkId::BOTTOM_LEFT));
    let place = place_to_go_to(300.0, &state(below, false), down, 0.0).expect("lost as well");
    assert!(place.y < 12.0, "not through the wall: {place}");
}

#[test]
fn who_gets_on_or_cannot_or_need_not_stays() {
    let to_landmark = Literal::is(Predicate::On(Entity::Agent(AgentId::ZERO), LandmarkId::BOTTOM_RIGHT));
    let bring = Literal::is(Predicate::On(Entity::Object(ObjectId::ZERO), LandmarkId::BOTTOM_RIGHT));
    let at = Vec2::new(8.0, 4.0);
    let there = Vec2::new(23.4, 4.5);
    for (what, force, state, literal, moves) in [
        ("walking", 300.0, state(at, false), to_landmark, 0.3),
        ("pulling at what is too heavy", 150.0, state(at, true), bring, 0.0),
        ("arrived", 300.0, state(there, false), to_landmark, 0.0),
        (
            "guarding",
            300.0,
            state(at, false),
            Literal::not(Predicate::On(Entity::Agent(AgentId::ONE), LandmarkId::BOTTOM_RIGHT)),
            0.0,
        ),
    ] {
        assert_eq!(place_to_go_to(force, &state, literal, moves), None, "{what}");
    }
    assert!(place_to_go_to(300.0, &state(at, true), bring, 0.0).is_some(), "a load that it can move");
}

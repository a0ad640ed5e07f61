//! Objectives in hand-made states: heading, carrying, releasing, yielding.

use phase_agent::{PhaseParameters, objective::Objective};
use phase_model::{
    AgentId, Body, Entity, Grip, LandmarkId, Layout, Literal, ObjectId, PhysicsConfig, Predicate,
    PredicateTarget, Side, Size, State, Strength, Subgoal, Vec2, arena, physics::AgentBody,
};
use phase_navigation::Navigator;

/// A narrow door (x 6 to 8.5, y 12) between rooms 0 (above) and 3; agent 0 of some size, a small agent 1, a
/// small object.
fn physics(size: Size) -> PhysicsConfig {
    PhysicsConfig {
        walls: layout().walls(),
        agents: [size, Size::Small]
            .map(|size| AgentBody { radius: size.radius(), max_force: Strength::Strong.max_force() }),
        object_radii: [Size::Small.radius(), 0.0],
        object_count: 1,
    }
}

fn layout() -> Layout {
    Layout::new(4, None).expect("layout 4")
}

/// Both agents and the object at rest, with agent 0's heading.
fn state(agent: Vec2, angle: f32, other: Vec2, object: Vec2) -> State {
    State::new([
        Body::at_rest(agent, angle),
        Body::at_rest(other, 0.0),
        Body::at_rest(object, 0.0),
        Body::default(),
    ])
}

/// Distance and waypoint of agent 0.
fn evaluate(size: Size, state: &State, literal: Literal) -> (f32, Vec2) {
    let physics = physics(size);
    let parameters = PhaseParameters::default();
    let costs = parameters.navigation();
    let mut navigator = Navigator::new(layout(), costs);
    let subgoal = Subgoal::Achieve(literal);
    let objective = Objective::new(&physics, &mut navigator, state, AgentId::ZERO, subgoal, &parameters);
    (objective.distance(state), objective.motion(state).waypoint)
}

const AWAY: Vec2 = Vec2::new(24.0, 4.0);
/// Distance between the centres of a small agent and a small object that it holds (u).
const ARM: f32 = 1.6;
const DOWN: f32 = core::f32::consts::PI;

#[test]
fn who_does_not_fit_through_a_door_faces_it() {
    let to_room = Literal::is(Predicate::Close(
        Entity::Agent(AgentId::ZERO),
        PredicateTarget::Landmark(LandmarkId::BOTTOM_LEFT),
    ));
    let at = Vec2::new(10.0, 14.0);
    let facing = |angle| evaluate(Size::Large, &state(at, angle, AWAY, AWAY), to_room).0;
    assert!(facing(DOWN) < facing(0.0) - 0.5);
    // An agent that fits need not do so.
    let facing = |angle| evaluate(Size::Small, &state(at, angle, AWAY, AWAY), to_room).0;
    assert!((facing(DOWN) - facing(0.0)).abs() < 1e-3);
}

#[test]
fn a_load_goes_first_where_its_carrier_cannot_follow() {
    let bring = Literal::is(Predicate::Close(
        Entity::Object(ObjectId::ZERO),
        PredicateTarget::Landmark(LandmarkId::BOTTOM_LEFT),
    ));
    // The load at the same place, its carrier below or above it.
    let load = Vec2::new(10.0, 17.0);
    let holding = |size: Size, below: bool| {
        let arm = size.radius() + Size::Small.radius();
        let towards = if below { Vec2::Y } else { Vec2::NEG_Y };
        evaluate(size, &carrying(load - towards * arm, towards, arm), bring).0
    };
    let turn = holding(Size::Huge, true) - holding(Size::Huge, false);
    assert!(turn > 1.0, "it has to turn round first: {turn}");
    // A carrier that fits may pass before its load.
    let turn = holding(Size::Small, true) - holding(Size::Small, false);
    assert!(turn < 1.0, "{turn}");
}

/// Agent 0 holding an object, by its head, at a distance (u) in some direction from it.
fn carrying(agent: Vec2, towards: Vec2, arm: f32) -> State {
    let heading = libm::atan2f(-towards.x, towards.y);
    let mut state = state(agent, heading, AWAY, agent + towards.normalize() * arm);
    state.body_mut(Entity::Object(ObjectId::ZERO)).angle = heading;
    state.grips[0] = Some(Grip { object: ObjectId::ZERO, side: Side::Head, relative_angle: 0.0 });
    state
}

#[test]
fn a_load_and_its_carrier_get_in_line_before_a_narrow_door() {
    let bring = Literal::is(Predicate::On(Entity::Object(ObjectId::ZERO), LandmarkId::BOTTOM_LEFT));
    // Beside the door across its passage, in line with it, in the door, through it.
    let way = [
        carrying(Vec2::new(11.7, 14.0), Vec2::NEG_X, ARM),
        carrying(Vec2::new(7.25, 15.6), Vec2::NEG_Y, ARM),
        carrying(Vec2::new(7.25, 13.7), Vec2::NEG_Y, ARM),
        carrying(Vec2::new(7.25, 12.3), Vec2::NEG_Y, ARM),
    ];
    let left = way.map(|state| evaluate(Size::Small, &state, bring).0);
    assert!(left.is_sorted_by(|earlier, later| earlier > later), "{left:?}");
    // With the load in the same place before the door, across the passage is farther than in line.
    let across = evaluate(Size::Small, &carrying(Vec2::new(8.85, 13.5), Vec2::NEG_X, ARM), bring).0;
    let in_line = evaluate(Size::Small, &carrying(Vec2::new(7.25, 15.1), Vec2::NEG_Y, ARM), bring).0;
    assert!(across > in_line + 0.5, "{across} {in_line}");
    // From where there is enough clearance the assembly proceeds straight on, side by side or not.
    for towards in [Vec2::NEG_X, Vec2::NEG_Y] {
        let state = carrying(Vec2::new(20.0, 8.0), towards, ARM);
        let load = state.position(Entity::Object(ObjectId::ZERO));
        let bring = Literal::is(Predicate::On(Entity::Object(ObjectId::ZERO), LandmarkId::BOTTOM_RIGHT));
        let waypoint = evaluate(Size::Small, &state, bring).1;
        let off = (waypoint - load).angle_to(arena::LANDMARKS[2] - load).abs();
        assert!(off < 0.4, "{waypoint}");
    }
}

#[test]
fn with_a_wall_between_them_carrier_and_load_slide_to_the_door() {
    let bring = Literal::is(Predicate::On(Entity::Object(ObjectId::ZERO), LandmarkId::TOP_LEFT));
    let left = [10.5, 9.5, 8.5, 8.0].map(|x| {
        let state = carrying(Vec2::new(x, 11.2), Vec2::Y, ARM);
        evaluate(Size::Small, &state, bring).0
    });
    assert!(left.is_sorted_by(|earlier, later| earlier > later), "{left:?}");
}

#[test]
fn a_load_is_not_pulled_to_its_place_from_where_there_is_no_room() {
    let bring = Literal::is(Predicate::On(Entity::Object(ObjectId::ZERO), LandmarkId::BOTTOM_RIGHT));
    // Landmark 2 is 2.5 u from the walls: a huge agent, 1.6 u, has no room beyond a load of 0.8 u.
    let arm = Size::Huge.radius() + Size::Small.radius();
    let holding = |towards: Vec2| {
        let load = arena::LANDMARKS[2] - Vec2::new(3.0, -3.0);
        evaluate(Size::Huge, &carrying(load - towards * arm, towards, arm), bring).0
    };
    let before = holding(Vec2::NEG_Y);
    let beyond = holding(Vec2::Y);
    assert!(beyond > before + 0.5, "from below the load cannot come near enough: {before} {beyond}");
}

#[test]
fn what_is_let_go_of_is_to_stay_there() {
    let release = Literal::not(Predicate::Attach(AgentId::ZERO, ObjectId::ZERO));
    let mut held = state(Vec2::new(20.0, 8.0), 0.0, AWAY, Vec2::new(20.0, 9.6));
    held.grips[0] = Some(Grip { object: ObjectId::ZERO, side: Side::Head, relative_angle: 0.0 });
    let mut thrown = held;
    thrown.grips[0] = None;
    thrown.body_mut(Entity::Object(ObjectId::ZERO)).velocity = Vec2::new(0.0, 10.0);
    let distance = |state: &State| evaluate(Size::Small, state, release).0;
    // Mass 2.01 kg at 10 u/s against 100 N: 1.005 u.
    assert!((distance(&thrown) - 1.005).abs() < 0.01, "{}", distance(&thrown));
    assert!(distance(&held) < distance(&thrown));
    thrown.body_mut(Entity::Object(ObjectId::ZERO)).velocity = Vec2::ZERO;
    assert!(distance(&thrown).abs() < 1e-6);
}

#[test]
fn one_does_not_turn_off_in_a_door() {
    let desired_direction = Literal::is(Predicate::On(Entity::Agent(AgentId::ZERO), LandmarkId::TOP_LEFT));
    let in_the_door = Vec2::new(7.25, 12.2);
    let open = evaluate(Size::Small, &state(in_the_door, 0.0, AWAY, AWAY), desired_direction).1;
    let obstructed =
        evaluate(Size::Small, &state(in_the_door, 0.0, AWAY, Vec2::new(7.7, 13.8)), desired_direction).1;
    let turned = (obstructed - in_the_door).angle_to(open - in_the_door).abs();
    assert!(turned < 0.2, "{obstructed} {open}");
    let past_it = Vec2::new(8.4, 15.0);
    let bent = evaluate(Size::Small, &state(past_it, 0.0, AWAY, Vec2::new(8.5, 17.5)), desired_direction).1;
    assert!((bent.x - 8.5).abs() > 1.0, "{bent}");
}

#[test]
fn aside_is_beside_the_others_way() {
    let aside = Literal::not(Predicate::On(Entity::Agent(AgentId::ZERO), LandmarkId::TOP_LEFT));
    let other = Vec2::new(7.25, 13.5);
    let distance = |at: Vec2| evaluate(Size::Small, &state(at, 0.0, other, AWAY), aside).0;
    assert!(distance(Vec2::new(9.0, 17.0)) > 1.0);
    assert!(distance(Vec2::new(10.0, 17.0)) < distance(Vec2::new(9.0, 17.0)));
    assert!(distance(Vec2::new(13.0, 17.0)).abs() < 1e-6);
}

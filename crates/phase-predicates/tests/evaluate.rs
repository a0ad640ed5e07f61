//! Every predicate just below and just above its threshold.

use phase_model::{
    AgentBody, AgentId, Body, Entity, Goal, Grip, LandmarkId, Literal, ObjectId, PhysicsConfig, Predicate,
    PredicateTarget, Side, Sign, State, Vec2, arena,
};
use phase_predicates::{SymbolicState, achieved, holds, threshold};

fn physics() -> PhysicsConfig {
    PhysicsConfig {
        walls: vec![],
        agents: [AgentBody { radius: 0.8, max_force: 300.0 }, AgentBody { radius: 1.2, max_force: 300.0 }],
        object_radii: [1.6, 0.0],
        object_count: 1,
    }
}

/// Agent 0, agent 1 and object 0 at rest.
fn state(positions: [Vec2; 3]) -> State {
    let mut bodies = [Body::default(); 4];
    for (body, position) in bodies.iter_mut().zip(positions) {
        *body = Body::at_rest(position, 0.3);
    }
    State::new(bodies)
}

/// Three positions well apart, none near a landmark.
const APART: [Vec2; 3] = [Vec2::new(15.0, 13.0), Vec2::new(17.5, 6.0), Vec2::new(20.0, 15.0)];

#[test]
fn on() {
    let centre = arena::LANDMARKS[2];
    for (index, entity, limit) in [
        (0, Entity::Agent(AgentId::ZERO), threshold::ON_AGENT),
        (1, Entity::Agent(AgentId::ONE), threshold::ON_AGENT),
        (2, Entity::Object(ObjectId::ZERO), threshold::ON_OBJECT),
    ] {
        for (distance, expected) in [(0.0, true), (limit - 0.01, true), (limit + 0.01, false), (5.0, false)] {
            let mut positions = APART;
            positions[index] = centre + Vec2::from_angle(1.0) * distance;
            let state = state(positions);
            assert_eq!(
                holds(&physics(), &state, Predicate::On(entity, LandmarkId::BOTTOM_RIGHT)),
                expected,
                "{entity:?} {distance}"
            );
            assert!(!holds(&physics(), &state, Predicate::On(entity, LandmarkId::TOP_LEFT)));
        }
    }
}

#[test]
fn close() {
    // Radii 0.8 and 1.6: close below 0.8 + 1.6 + 1.5.
    for (distance, expected) in [(2.5, true), (3.89, true), (3.91, false)] {
        let mut positions = APART;
        positions[2] = positions[0] + Vec2::new(distance, 0.0);
        let agent = Entity::Agent(AgentId::ZERO);
        let object = Entity::Object(ObjectId::ZERO);
        for predicate in [
            Predicate::Close(agent, PredicateTarget::Entity(object)),
            Predicate::Close(object, PredicateTarget::Entity(agent)),
        ] {
            assert_eq!(holds(&physics(), &state(positions), predicate), expected, "{distance}");
        }
    }
    for (position, room) in [
        (Vec2::new(15.9, 12.1), 0),
        (Vec2::new(16.1, 12.1), 1),
        (Vec2::new(16.1, 11.9), 2),
        (Vec2::new(15.9, 11.9), 3),
    ] {
        let state = state([position, APART[1], APART[2]]);
        for landmark in 0..4 {
            let predicate = Predicate::Close(
                Entity::Agent(AgentId::ZERO),
                PredicateTarget::Landmark(LandmarkId::ALL[landmark]),
            );
            assert_eq!(holds(&physics(), &state, predicate), landmark == room);
        }
    }
}

#[test]
fn touch_and_attach() {
    let mut state = state(APART);
    let touch = |who, what| Predicate::Touch(who, what);
    assert!(!holds(&physics(), &state, touch(AgentId::ZERO, Entity::Agent(AgentId::ONE))));
    state.contacts.insert(Entity::Agent(AgentId::ONE), Entity::Agent(AgentId::ZERO));
    assert!(holds(&physics(), &state, touch(AgentId::ZERO, Entity::Agent(AgentId::ONE))));
    assert!(holds(&physics(), &state, touch(AgentId::ONE, Entity::Agent(AgentId::ZERO))));
    assert!(!holds(&physics(), &state, touch(AgentId::ZERO, Entity::Object(ObjectId::ZERO))));
    state.grips[1] = Some(Grip { object: ObjectId::ZERO, side: Side::Tail, relative_angle: 0.0 });
    assert!(holds(&physics(), &state, Predicate::Attach(AgentId::ONE, ObjectId::ZERO)));
    assert!(!holds(&physics(), &state, Predicate::Attach(AgentId::ZERO, ObjectId::ZERO)));
    // Attached objects are felt.
    assert!(holds(&physics(), &state, touch(AgentId::ONE, Entity::Object(ObjectId::ZERO))));
}

#[test]
fn the_absent_satisfies_nothing() {
    let state = state(APART);
    let absent = Entity::Object(ObjectId::ONE);
    for predicate in [
        Predicate::On(absent, LandmarkId::TOP_LEFT),
        Predicate::Touch(AgentId::ZERO, absent),
        Predicate::Close(absent, PredicateTarget::Landmark(LandmarkId::BOTTOM_LEFT)),
        Predicate::Close(Entity::Agent(AgentId::ZERO), PredicateTarget::Entity(absent)),
    ] {
        assert!(!holds(&physics(), &state, predicate), "{predicate}");
    }
}

#[test]
fn goals_are_literals() {
    let goal = Goal::AgentOnLandmark {
        agent: AgentId::ZERO,
        landmark: LandmarkId::BOTTOM_RIGHT,
        sign: Sign::Positive,
    };
    let on = state([arena::LANDMARKS[2], APART[1], APART[2]]);
    assert!(achieved(&physics(), &on, goal) && !achieved(&physics(), &on, goal.negated()));
    assert!(
        !achieved(&physics(), &state(APART), goal) && achieved(&physics(), &state(APART), goal.negated())
    );
    assert_eq!(Literal::from(goal.negated()).to_string(), "not On(agent 0, landmark 2)");
}

#[test]
fn symbolic_states_hold_exactly_what_is_true() {
    let mut physical = state([arena::LANDMARKS[0], Vec2::new(9.5, 17.0), APART[2]]);
    physical.grips[0] = Some(Grip { object: ObjectId::ZERO, side: Side::Head, relative_angle: 0.0 });
    physical.contacts.insert(Entity::Agent(AgentId::ZERO), Entity::Agent(AgentId::ONE));
    let symbolic = SymbolicState::of(&physics(), &physical);
    let mut count = 0;
    for predicate in SymbolicState::predicates() {
        assert_eq!(symbolic.holds(predicate), holds(&physics(), &physical, predicate), "{predicate}");
        let mut only = SymbolicState::default();
        only.set(predicate, true);
        assert_eq!(only.iter().filter(|&other| other == predicate).count(), 1, "{predicate}");
        count += 1;
    }
    // 16 On, 16 Close to landmarks, 6 Touch, 4 Attach, 6 Close pairs.
    assert_eq!(count, 48);
    let words: Vec<String> = symbolic.iter().map(|predicate| predicate.to_string()).collect();
    assert!(words.contains(&"On(agent 0, landmark 0)".to_owned()), "{words:?}");
    assert!(words.contains(&"Attach(agent 0, object 0)".to_owned()), "{words:?}");
}

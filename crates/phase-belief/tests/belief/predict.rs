//! Constant motion of unobserved bodies.

use crate::common::{BALL, BOX, ME, OTHER, physics, random, state, wall};
use core::f32::consts::PI;
use phase_belief::Belief;
use phase_forward::Forward;
use phase_model::{
    AGENT_COUNT, Action, AgentId, Dynamics, Grip, ObjectId, PhysicsConfig, Segment, Side, Size, State, Vec2,
    geometry::Outline,
};
use phase_perception::observe;

/// Agent 0 sees everything at the top of the arena, then turns away at once and sees none of it; the state
/// that its particles predict after some steps.
fn step_approximate(physics: &PhysicsConfig, first: State, steps: usize) -> State {
    imagine_by(&Forward::new(physics), physics, first, steps)
}

fn imagine_by(dynamics: &impl Dynamics, physics: &PhysicsConfig, first: State, steps: usize) -> State {
    let observation = observe(physics, &first, AgentId::ZERO);
    assert_eq!(observation.observed.iter().count(), physics.entity_count(), "all is seen at first");
    let mut chance = random(1);
    let mut belief = Belief::new(physics, &observation, 3, &mut chance);
    let mut away = first;
    *away.body_mut(ME) = phase_model::Body::at_rest(Vec2::new(16.0, 4.0), PI);
    let observation = observe(physics, &away, AgentId::ZERO);
    assert_eq!(observation.observed, [ME].into_iter().collect());
    for _ in 0..steps {
        belief.update(dynamics, physics, Action::NoForce, &observation, &mut chance);
        assert_eq!(belief.resampled(), 0);
    }
    assert!(belief.particles().iter().all(|particle| particle == &belief.particles()[0]));
    belief.particles()[0]
}

/// Agent 0 at the bottom, looking up; the other at (16, 14) with a velocity, looking up.
fn scene(velocity: Vec2, ball: (f32, f32)) -> State {
    let mut state = state([(16.0, 4.0, 0.0), (16.0, 14.0, 0.0), (ball.0, ball.1, 0.0), (8.0, 14.0, 0.0)]);
    state.body_mut(OTHER).velocity = velocity;
    state
}

fn small(walls: Vec<Segment>) -> PhysicsConfig {
    physics(walls, Size::Small, 1)
}

#[test]
fn the_other_agent_goes_on_as_it_was_going() {
    let velocity = Vec2::new(-6.0, 3.0);
    let first = scene(velocity, (20.0, 8.0));
    for steps in 1..4 {
        let last = step_approximate(&small(Vec::new()), first, steps);
        let expected = first.position(OTHER) + velocity * (steps as f32 * 5.0 / 60.0);
        assert!(last.position(OTHER).distance(expected) < 1e-4, "{steps}");
        assert_eq!(last.body(OTHER).velocity, velocity);
        assert_eq!(last.body(OTHER).angle, 0.0);
    }
}

#[test]
fn free_objects_coast_to_a_stop() {
    let mut first = scene(Vec2::ZERO, (10.0, 10.0));
    first.body_mut(BALL).velocity = Vec2::new(0.0, 8.0);
    let last = step_approximate(&small(Vec::new()), first, 4);
    // v²/2a with a = 100 N / 2.01 kg.
    let expected = 10.0 + 64.0 / (2.0 * 100.0 / 2.0106);
    assert_eq!(last.body(BALL).velocity, Vec2::ZERO);
    assert!((last.position(BALL).y - expected).abs() < 0.1, "{}", last.position(BALL));
}

#[test]
fn what_it_holds_goes_along() {
    let velocity = Vec2::new(4.0, -2.0);
    let mut first = scene(velocity, (16.0, 15.6));
    first.body_mut(BALL).velocity = velocity;
    first.grips[1] = Some(Grip { object: ObjectId::ZERO, side: Side::Head, relative_angle: 0.0 });
    let last = step_approximate(&small(Vec::new()), first, 3);
    assert_eq!(last.grips, first.grips);
    for entity in [OTHER, BALL] {
        let expected = first.position(entity) + velocity * 0.25;
        assert!(last.position(entity).distance(expected) < 1e-4, "{entity:?}");
        assert_eq!(last.body(entity).velocity, velocity);
    }
}

#[test]
fn what_is_in_the_way_stops_it() {
    let walls = || vec![wall((6.0, 17.0), (26.0, 17.0))];
    let up = Vec2::new(0.0, 9.0);
    let right = Vec2::new(9.0, 0.0);
    let last = step_approximate(&small(walls()), scene(up, (20.0, 8.0)), 8);
    let top = last.position(OTHER).y + 0.8;
    assert!((16.0..17.05).contains(&top) && last.body(OTHER).velocity.y < 1.0, "a wall: {top}");

    let last = step_approximate(&small(Vec::new()), scene(up, (20.0, 8.0)), 16);
    let top = last.position(OTHER).y + 0.8;
    assert!((21.0..22.05).contains(&top) && last.body(OTHER).velocity.y < 1.0, "the boundary: {top}");

    // An object is pushed on, and the agent that pushes loses speed.
    let physics = small(Vec::new());
    let last = step_approximate(&physics, scene(right, (20.0, 14.0)), 5);
    assert!(last.position(BALL).x > 20.05 && last.body(OTHER).velocity.x < 8.0);
    let smaller = crate::common::shrunk_outline(&physics, 0.05);
    let [agent, ball] = [OTHER, BALL].map(|entity| Outline::of(&smaller, entity, last.body(entity)));
    assert!(!agent.overlaps(&ball));
}

#[test]
fn nothing_passes_through_a_wall_however_fast() {
    let physics = small(vec![wall((6.0, 17.0), (26.0, 17.0))]);
    for speed in [20.0, 40.0, 60.0, 100.0] {
        let last = step_approximate(&physics, scene(Vec2::new(0.0, speed), (20.0, 8.0)), 2);
        assert!(last.position(OTHER).y < 17.0, "{speed}: {}", last.position(OTHER));
    }
}

#[test]
fn pushing_is_left_to_the_dynamics() {
    // A heavy agent pushes a light object, which gives way.
    let mut physics = small(Vec::new());
    physics.agents[1].radius = 1.6;
    let first = scene(Vec2::new(3.0, 0.0), (18.33, 14.37));
    let last = step_approximate(&physics, first, 1);
    assert!(last.position(BALL).x > 18.38, "{}", last.position(BALL));
    assert!(last.body(OTHER).velocity.x < 2.7, "{}", last.body(OTHER).velocity);
}

#[test]
fn what_gets_in_the_way_stops_it() {
    /// The object appears beside the other agent.
    struct Appear;
    impl Dynamics for Appear {
        fn step(&self, state: &mut State, _: [Action; AGENT_COUNT]) {
            state.body_mut(BALL).position = Vec2::new(17.9, 14.0);
        }
    }
    for (velocity, way) in [(6.0, 0.0), (-6.0, -0.5)] {
        let first = scene(Vec2::new(velocity, 0.0), (20.0, 8.0));
        let last = imagine_by(&Appear, &small(Vec::new()), first, 1);
        assert!((last.position(OTHER).x - 16.0 - way).abs() < 1e-4, "{velocity}");
    }
}

#[test]
fn the_agents_own_action_is_known_and_the_other_does_nothing() {
    /// The second object shows the actions passed to the dynamics.
    struct Tell;
    impl Dynamics for Tell {
        fn step(&self, state: &mut State, actions: [Action; AGENT_COUNT]) {
            state.body_mut(BOX).position =
                Vec2::new(8.0 + actions[0].index() as f32, 10.0 + actions[1].index() as f32 / 2.0);
        }
    }
    let physics = physics(Vec::new(), Size::Small, 2);
    let truth = state([(16.0, 4.0, PI), (24.0, 4.0, 0.0), (8.0, 20.0, 0.0), (24.0, 20.0, 0.0)]);
    let mirrored = state([(24.0, 4.0, 0.0), (16.0, 4.0, PI), (8.0, 20.0, 0.0), (24.0, 20.0, 0.0)]);
    for (agent, truth) in [(0, truth), (1, mirrored)] {
        let observation = observe(&physics, &truth, AgentId::ALL[agent]);
        let mut chance = random(2);
        let mut belief = Belief::new(&physics, &observation, 30, &mut chance);
        belief.update(&Tell, &physics, Action::Left, &observation, &mut chance);
        let own = Action::Left.index() as f32;
        let none = Action::NoForce.index() as f32;
        let told = if agent == 0 { (own, none) } else { (none, own) };
        let expected = Vec2::new(8.0 + told.0, 10.0 + told.1 / 2.0);
        let as_told = belief.particles().iter().filter(|particle| particle.position(BOX) == expected).count();
        assert!(as_told > 20, "{as_told}");
    }
}

//! Contradictions of an observation, and the treatment of grips.

use crate::common::{BALL, BOX, ME, OTHER, StaticDynamics, physics, random, state};
use core::f32::consts::PI;
use phase_belief::Belief;
use phase_model::{
    AGENT_COUNT, Action, AgentId, Body, Dynamics, Grip, MAX_ENTITIES, ObjectId, Side, Size, State, Vec2,
};
use phase_perception::observe;

/// Dynamics that lead to one given state, whatever the state before.
struct Into(State);

impl Dynamics for Into {
    fn step(&self, state: &mut State, _: [Action; AGENT_COUNT]) {
        *state = self.0;
    }
}

/// Agent 0 at the bottom looking down; the other agent and two objects somewhere above.
fn hidden() -> State {
    state([(16.0, 4.0, PI), (12.0, 14.0, 0.0), (20.0, 14.0, 0.0), (20.0, 18.0, 0.0)])
}

fn moved(mut state: State, entity: phase_model::Entity, x: f32, y: f32) -> State {
    state.body_mut(entity).position = Vec2::new(x, y);
    state
}

fn held(mut state: State, side: Side) -> State {
    let offset = side.direction() * 1.6;
    *state.body_mut(BALL) = Body::at_rest(state.position(OTHER) + offset, 0.0);
    state.grips[1] = Some(Grip { object: ObjectId::ZERO, side, relative_angle: 0.0 });
    state
}

/// Agent 0 sees `truth` while its particles predict `imagined`.
fn confront(truth: State, imagined: State) -> Belief {
    let physics = physics(Vec::new(), Size::Small, 2);
    let mut chance = random(1);
    let mut belief = Belief::new(&physics, &observe(&physics, &truth, AgentId::ZERO), 20, &mut chance);
    belief.update(
        &Into(imagined),
        &physics,
        Action::NoForce,
        &observe(&physics, &truth, AgentId::ZERO),
        &mut chance,
    );
    assert_eq!(belief.unresolved(), 0);
    belief
}

#[test]
fn only_what_cannot_be_is_redrawn() {
    let truth = hidden();
    let mut nan = truth;
    nan.body_mut(BALL).angular_velocity = f32::NAN;
    let flank = |state: State| {
        // Released at the right flank of the other agent: penetrating the slanting side by a tenth of its
        // radius.
        moved(state, BALL, state.position(OTHER).x + 1.6, state.position(OTHER).y)
    };
    let cases: [(&str, State, &[phase_model::Entity]); 12] = [
        ("as it is", truth, &[]),
        ("elsewhere unseen", moved(truth, BALL, 8.0, 20.0), &[]),
        ("in view", moved(truth, BALL, 16.0, 3.0), &[BALL]),
        ("barely in the boundary", moved(truth, BALL, 25.23, 14.0), &[]),
        ("deep in the boundary", moved(truth, BALL, 25.3, 14.0), &[BALL]),
        ("out of the arena", moved(truth, OTHER, 40.0, 14.0), &[OTHER]),
        ("in what is observed", moved(truth, BALL, 16.0, 5.0), &[BALL]),
        ("barely in the other object", moved(truth, BOX, 20.0, 15.58), &[]),
        ("deep in the other object", moved(truth, BOX, 20.0, 15.4), &[BOX]),
        ("let go at a flank", flank(truth), &[]),
        ("deep in a flank", moved(truth, BALL, 13.3, 14.0), &[BALL]),
        ("not a number", nan, &[BALL]),
    ];
    for (name, imagined, resampled) in cases {
        let belief = confront(truth, imagined);
        assert_eq!(belief.resampled(), 20 * resampled.len(), "{name}");
        for particle in belief.particles() {
            for entity in [ME, OTHER, BALL, BOX] {
                let kept = particle.body(entity) == imagined.body(entity);
                assert_eq!(kept, !resampled.contains(&entity), "{name}: {entity:?}");
            }
        }
    }
}

#[test]
fn walls_count_too() {
    let physics = physics(vec![crate::common::wall((16.0, 12.0), (16.0, 22.0))], Size::Small, 2);
    let truth = hidden();
    let observation = observe(&physics, &truth, AgentId::ZERO);
    for (x, resampled) in [(16.77, 0), (16.7, 20), (16.0, 20), (15.0, 0)] {
        let mut chance = random(1);
        let mut belief = Belief::new(&physics, &observation, 20, &mut chance);
        let imagined = Into(moved(truth, BALL, x, 18.0));
        // The other object far away.
        let imagined = Into(moved(imagined.0, BOX, 24.0, 14.0));
        belief.update(&imagined, &physics, Action::NoForce, &observation, &mut chance);
        assert_eq!(belief.resampled(), resampled, "{x}");
    }
}

#[test]
fn an_unseen_grip_lasts_while_nothing_contradicts_it() {
    for side in Side::ALL {
        let imagined = held(hidden(), side);
        let belief = confront(hidden(), imagined);
        assert_eq!(belief.resampled(), 0, "{side:?}");
        assert!(belief.particles().iter().all(|particle| particle.grips == imagined.grips), "{side:?}");
    }
}

#[test]
fn a_grip_that_still_draws_its_object_into_place_is_no_contradiction() {
    let mut imagined = held(hidden(), Side::Head);
    imagined.body_mut(BALL).position.y -= 0.3;
    assert_eq!(confront(hidden(), imagined).resampled(), 0);
    imagined.grips[1] = None;
    assert_eq!(confront(hidden(), imagined).resampled(), 20);
}

#[test]
fn grips_go_when_either_end_does() {
    let truth = hidden();
    let imagined = held(truth, Side::Head);
    // The object would be in view, or the agent, or the object is seen elsewhere.
    let object_in_view = held(moved(truth, OTHER, 12.2, 2.0 + 0.8), Side::Left);
    let agent_gone = moved(imagined, OTHER, f32::NAN, 14.0);
    let object_gone = moved(imagined, BALL, f32::NAN, 14.0);
    let object_observed = moved(truth, BALL, 16.0, 2.9);
    let agent_observed = moved(truth, OTHER, 16.0, 2.9);
    let cases = [
        ("agent gone", truth, agent_gone),
        ("object gone", truth, object_gone),
        ("object observed elsewhere", object_observed, imagined),
        ("agent observed holding nothing", agent_observed, imagined),
    ];
    for (name, truth, imagined) in cases {
        let belief = confront(truth, imagined);
        assert!(belief.particles().iter().all(|particle| particle.grips == [None; 2]), "{name}");
    }
    let belief = confront(truth, object_in_view);
    for particle in belief.particles() {
        let both_kept = particle.bodies == object_in_view.bodies;
        assert_eq!(particle.grips[1].is_some(), both_kept);
    }
}

#[test]
fn an_observed_grip_is_taken_over() {
    // The other holds the object in view of agent 0, above it.
    let mut truth = held(moved(hidden(), OTHER, 16.0, 10.0), Side::Head);
    truth.body_mut(ME).angle = 0.0;
    let belief = confront(truth, State::new([Body::at_rest(Vec2::new(10.0, 10.0), 0.0); MAX_ENTITIES]));
    for particle in belief.particles() {
        assert_eq!(particle.grips, truth.grips);
        assert_eq!(particle.bodies[..3], truth.bodies[..3]);
    }
}

#[test]
fn contacts_are_the_truth_where_observed_and_imagined_elsewhere() {
    let truth = hidden();
    let mut imagined = truth;
    imagined.contacts.insert(BALL, BOX);
    imagined.contacts.insert(OTHER, BOX);
    let belief = confront(truth, imagined);
    let lost = confront(truth, moved(imagined, OTHER, f32::NAN, 0.0));
    for (belief, with_other) in [(belief, true), (lost, false)] {
        for particle in belief.particles() {
            assert!(!particle.contacts.touching(ME, OTHER));
            assert!(particle.contacts.touching(BALL, BOX));
            assert_eq!(particle.contacts.touching(OTHER, BOX), with_other);
        }
    }
}

#[test]
fn what_should_be_felt_and_is_not_is_not_there() {
    let truth = hidden();
    // In reach behind the agent's back, and predicted in its own grip.
    let behind = moved(truth, BALL, 16.0, 5.6);
    let mut gripped = behind;
    gripped.grips[0] = Some(Grip { object: ObjectId::ZERO, side: Side::Tail, relative_angle: 0.0 });
    for (imagined, stays) in [(behind, true), (gripped, false)] {
        for particle in confront(truth, imagined).particles() {
            assert_eq!(particle.position(BALL) == imagined.position(BALL), stays);
            assert_eq!(particle.grips[0], None);
        }
    }
}

#[test]
fn redrawn_bodies_rest() {
    let truth = hidden();
    let mut imagined = moved(truth, OTHER, 40.0, 14.0);
    imagined.body_mut(OTHER).velocity = Vec2::new(3.0, 3.0);
    imagined.body_mut(OTHER).angular_velocity = 1.0;
    for particle in confront(truth, imagined).particles() {
        assert_eq!(particle.body(OTHER).velocity, Vec2::ZERO);
        assert_eq!(particle.body(OTHER).angular_velocity, 0.0);
    }
}

#[test]
fn a_cell_under_a_known_body_counts_as_seen() {
    let physics = physics(Vec::new(), Size::Huge, 0);
    let truth = state([(16.5, 8.5, PI), (12.0, 18.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)]);
    let mut chance = random(1);
    let observation = observe(&physics, &truth, AgentId::ZERO);
    let mut belief = Belief::new(&physics, &observation, 1, &mut chance);
    let under = phase_perception::Cell::at(Vec2::new(16.5, 9.5)).unwrap();
    assert!(!observation.sees_cell(under));
    assert_eq!(belief.memory().age(under), Some(0));
    assert!(belief.seen_now().any(|cell| cell == under));
    assert!(belief.never_seen().all(|cell| cell != under));
    let gone = moved(truth, ME, 16.5, 4.0);
    belief.update(
        &StaticDynamics,
        &physics,
        Action::Up,
        &observe(&physics, &gone, AgentId::ZERO),
        &mut chance,
    );
    assert_eq!(belief.memory().age(under), Some(1));
}

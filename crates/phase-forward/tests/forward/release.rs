//! After a release, an object and its former holder do not stay inside one another, in any kind of step.

use crate::scenes;

use phase_forward::Forward;
use phase_model::{
    Action, AgentId, Dynamics, Entity, Grip, ObjectId, PhysicsConfig, Side, State, Vec2, geometry::Outline,
};
use proptest::{prelude::*, strategy::ValueTree, test_runner::TestRunner};
use scenes::{actions, clear_of_walls, separated_bodies};

/// Random scenes, and runs of held actions before and after the release.
const SCENES: usize = 400;
const RUNS: usize = 4;
/// Overlap that may last longer than [`STEPS`] (u).
const DEEP: f32 = 0.1;
/// A second of video, in steps.
const STEPS: usize = 4;

/// Agent 0, which never grabs anything, and the object that it holds at the start.
const PAIR: [Entity; 2] = [Entity::Agent(AgentId::ZERO), Entity::Object(ObjectId::ZERO)];

/// Overlap of two bodies by their outlines (u).
fn overlap(physics: &PhysicsConfig, state: &State, [a, b]: [Entity; 2]) -> f32 {
    let [a, b] = [a, b].map(|entity| Outline::of(physics, entity, state.body(entity)));
    a.depth(&b).unwrap_or(0.0)
}

/// Scenes in which agent 0 holds object 0 and overlaps nothing else.
fn carrying() -> impl Strategy<Value = (PhysicsConfig, State)> {
    (separated_bodies(), prop::sample::select(Side::ALL.to_vec())).prop_filter_map(
        "no room for the object",
        |((physics, mut state), side)| {
            let length = physics.agents[0].radius + physics.object_radii[0];
            let [agent, _, mut object, _] = state.bodies;
            object.position =
                agent.position + Vec2::from_angle(agent.angle).rotate(side.direction() * length);
            state.bodies[2] = object;
            let relative_angle = object.angle - agent.angle;
            state.grips[0] = Some(Grip { object: ObjectId::ZERO, side, relative_angle });
            let clear = |other| PAIR.contains(&other) || overlap(&physics, &state, [PAIR[1], other]) == 0.0;
            let possible = physics.object_count > 0
                && clear_of_walls(&physics, &state, PAIR[1], 0.02)
                && physics.entities().all(clear);
            possible.then_some((physics, state))
        },
    )
}

/// Asserts that in at most a share of scenes the pair stays overlapped.
fn assert_apart(
    name: &str,
    exceptions: f32,
    step: impl Fn(&Forward) -> Box<dyn FnMut(&mut State, [Action; 2]) + '_>,
) {
    let mut runner = TestRunner::deterministic();
    let strategy = (carrying(), actions(RUNS), actions(RUNS));
    let (mut overlapped, mut deepest) = (0, 0.0_f32);
    for scene in 0..SCENES {
        let ((physics, mut state), before, after) =
            strategy.new_tree(&mut runner).expect("a scene").current();
        let keep = |[action, other]: [Action; 2]| match action {
            Action::Attach | Action::Detach => [Action::Stop, other],
            _ => [action, other],
        };
        let forward = Forward::new(&physics);
        let mut step = step(&forward);
        for actions in before {
            step(&mut state, keep(actions));
        }
        let (mut steps, mut long) = (0, false);
        // Half of the carriers stop abruptly, so that what they pulled runs into them.
        let stop = if scene % 2 == 0 { Action::Stop } else { Action::NoForce };
        let release = [[Action::Detach, Action::NoForce], [stop, Action::NoForce]];
        let idle = [[Action::NoForce; 2]; STEPS + 2];
        for actions in release.into_iter().chain(after.into_iter().map(keep)).chain(idle) {
            step(&mut state, actions);
            let depth = overlap(&physics, &state, PAIR);
            steps = if depth > DEEP { steps + 1 } else { 0 };
            if steps > STEPS {
                long = true;
                deepest = deepest.max(depth);
            }
        }
        overlapped += usize::from(long);
    }
    println!("{name}: in {overlapped} of {SCENES} scenes, up to {deepest} u");
    assert!(
        overlapped as f32 <= exceptions * SCENES as f32,
        "{name}: in {overlapped} scenes, up to {deepest} u"
    );
}

#[test]
fn exact_steps_end_overlaps() {
    assert_apart("exact", 0.0, |forward| Box::new(|state, actions| forward.step(state, actions)));
}

/// Coarse steps solve contacts approximately, so that a few overlaps last longer.
#[test]
fn coarse_steps_end_overlaps() {
    assert_apart("coarse", 0.01, |forward| Box::new(|state, actions| forward.step_coarse(state, actions)));
}

#[test]
fn steps_with_a_cache_end_overlaps() {
    assert_apart("with a cache", 0.0, |forward| {
        let mut cache = None;
        Box::new(move |state, actions| {
            let cache = cache.get_or_insert_with(|| forward.fresh_cache(state));
            forward.step_warm(state, cache, actions);
        })
    });
}

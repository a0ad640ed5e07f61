//! The kernel compared with the reference world: one step by each from every state of a simulated event.

use crate::scenes;

use phase_forward::Forward;
use phase_model::{Action, Contacts, Dynamics, Entity, PhysicsConfig, State, arena};
use phase_statistics::percentile;
use phase_world::World;
use proptest::{prelude::*, strategy::ValueTree, test_runner::TestRunner};
use scenes::{actions, clear_of_walls, outline, separated_bodies};

/// Bodies that keep this distance from everything while a step lasts move freely (u).
const CLEARANCE: f32 = 0.05;
/// Scenes of the statistics, and runs of held actions in each.
const SCENES: usize = 400;
const RUNS: usize = 12;

/// Tolerance for free bodies after a step, between the two engines (u and rad): every step satisfies it.
const FREE: f32 = 1e-4;
/// Bounds on the distance for a share of all other steps (u): percent and limit.
const CARRYING: [(usize, f32); 2] = [(50, 5e-4), (90, 0.008)];
const CONTACT: [(usize, f32); 3] = [(50, 0.001), (80, 0.01), (90, 0.025)];

/// What occurred in a step.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Going {
    /// No contact and no grip.
    Free,
    /// A grip, but no contact besides it.
    CarryStatistics,
    /// Contacts between bodies or with walls.
    Contact,
}

/// One step by both engines.
#[derive(Debug)]
struct Compared {
    going: Going,
    /// Maximum distance between the positions of any body (u) and between its angles (rad).
    error: [f32; 2],
    same_grips: bool,
}

fn compare(physics: &PhysicsConfig, start: &State, actions: &[[Action; 2]]) -> Vec<Compared> {
    let forward = Forward::new(physics);
    let mut world = World::new(physics, start);
    let one = |&actions: &[Action; 2]| {
        let before = world.state();
        let true_states = world.step(actions);
        let mut imagined = before;
        forward.step(&mut imagined, actions);
        let after = true_states[true_states.len() - 1];
        let mut all = true_states.to_vec();
        all.extend([before, imagined]);
        let errors = physics.entities().map(|entity| {
            let (a, b) = (after.body(entity), imagined.body(entity));
            [a.position.distance(b.position), (a.angle - b.angle).abs()]
        });
        let grips = |state: &State| state.grips.map(|grip| grip.map(|grip| (grip.object, grip.side)));
        Compared {
            going: going(physics, &all),
            error: errors.fold([0.0; 2], |worst, error| [0, 1].map(|k| worst[k].max(error[k]))),
            same_grips: grips(&after) == grips(&imagined),
        }
    };
    actions.iter().map(one).collect()
}

/// What occurred in a step, determined from the states of either engine.
fn going(physics: &PhysicsConfig, states: &[State]) -> Going {
    let contact = states.iter().any(|state| {
        let wide = |entity| outline(physics, state, entity, margin(physics, state, entity));
        let meets = |entity| {
            let near = |other| {
                let held = !state.contacts.touching(entity, other) && state.touching(entity, other);
                !held && wide(entity).overlaps(&wide(other))
            };
            !clear_of_walls(physics, state, entity, margin(physics, state, entity))
                || physics.entities().filter(|&other| other != entity).any(near)
        };
        state.contacts != Contacts::NONE || physics.entities().any(meets)
    });
    let held = states.iter().any(|state| state.grips.iter().any(Option::is_some));
    match (contact, held) {
        (true, _) => Going::Contact,
        (false, true) => Going::CarryStatistics,
        (false, false) => Going::Free,
    }
}

/// Upper bound of a body's displacement in one substep (u): nothing may occur between two states either.
fn margin(physics: &PhysicsConfig, state: &State, entity: Entity) -> f32 {
    let body = state.body(entity);
    let corners = 2.0 * physics.radius(entity) * body.angular_velocity.abs();
    CLEARANCE + 1.2 * (body.velocity.length() + corners) * arena::SUBSTEP_SECONDS
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn free_bodies_go_the_same_way((physics, start) in separated_bodies(), actions in actions(RUNS)) {
        for (k, step) in compare(&physics, &start, &actions).into_iter().enumerate() {
            prop_assert!(step.same_grips, "step {k} {:?}: {step:?}", actions[k]);
            let [position, angle] = step.error;
            let agree = position <= FREE && angle <= FREE;
            prop_assert!(agree || step.going != Going::Free, "step {k} {:?}: {step:?}", actions[k]);
        }
    }
}

/// Contact is chaotic, so single steps may diverge; the bulk of them may not.
#[test]
fn one_step_ahead_over_many_scenes() {
    let mut runner = TestRunner::deterministic();
    let strategy = (separated_bodies(), actions(RUNS));
    let mut steps = Vec::new();
    for _ in 0..SCENES {
        let ((physics, start), actions) = strategy.new_tree(&mut runner).expect("a scene").current();
        steps.extend(compare(&physics, &start, &actions));
    }
    let limits =
        [(Going::Free, &[(100, FREE)][..]), (Going::CarryStatistics, &CARRYING), (Going::Contact, &CONTACT)];
    for (going, limits) in limits {
        let errors = steps.iter().filter(|step| step.going == going).map(|step| step.error);
        let (mut positions, mut angles): (Vec<f32>, Vec<f32>) =
            errors.map(|[position, angle]| (position, angle)).unzip();
        report(going, "u", &mut positions);
        report(going, "rad", &mut angles);
        assert!(positions.len() >= 50, "too few steps to say anything about {going:?}");
        for &(percent, limit) in limits {
            let reached = percentile(&positions, percent).expect("some steps");
            assert!(reached <= limit, "{going:?}: p{percent} is {reached} u, not {limit}");
        }
    }
}

/// Sorts and prints errors.
fn report(going: Going, unit: &str, errors: &mut [f32]) {
    errors.sort_by(f32::total_cmp);
    let [p50, p90, p99, worst] = [50, 90, 99, 100].map(|p| percentile(errors, p).expect("some steps"));
    let near = errors.partition_point(|&error| error <= 0.01) as f32 / errors.len() as f32;
    println!(
        "{going:?}, {} steps: p50 {p50:.1e} p90 {p90:.1e} p99 {p99:.1e} worst {worst:.1e} {unit}, {:.1} % within 0.01",
        errors.len(),
        100.0 * near
    );
}

/// A state that comes from elsewhere than a scene, such as an observation, may have any angle. Both engines
/// take it for the same.
#[test]
fn angles_that_no_scene_has_are_the_same_in_both_engines() {
    let body = phase_model::AgentBody { radius: 0.8, max_force: 450.0 };
    let physics =
        PhysicsConfig { walls: Vec::new(), agents: [body; 2], object_radii: [1.0; 2], object_count: 1 };
    for angle in [99_999.0, 1.5e5, -3e7, 1e30, f32::MIN, f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
        let mut start = State::new([phase_model::Body::default(); 4]);
        for (body, x) in start.bodies.iter_mut().zip([10.0, 16.0, 22.0, 8.0]) {
            (body.position, body.angle) = (phase_model::Vec2::new(x, 12.0), angle);
        }
        let mut imagined = start;
        Forward::new(&physics).step(&mut imagined, [Action::Up, Action::NoForce]);
        let after = World::new(&physics, &start).step([Action::Up, Action::NoForce])[4];
        for entity in physics.entities() {
            let (a, b) = (after.body(entity), imagined.body(entity));
            assert_eq!(a.angle, b.angle, "{entity:?} at {angle}");
            assert!(a.position.distance(b.position) < FREE, "{entity:?} at {angle}");
        }
    }
}

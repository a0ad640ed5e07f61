//! The kernel held against the true world: from each state of an event in the world, one step ahead by both.

mod scenes;

use phase_forward::Forward;
use phase_model::{Action, Contacts, Dynamics, Entity, Physique, State, arena};
use phase_statistics::percentile;
use phase_world::World;
use proptest::{prelude::*, strategy::ValueTree, test_runner::TestRunner};
use scenes::{actions, apart, clear_of_walls, outline};

/// Bodies that keep this distance from everything while a step lasts move freely (u).
const CLEARANCE: f32 = 0.05;
/// Scenes of the statistics, and runs of held actions in each.
const SCENES: usize = 400;
const RUNS: usize = 12;

/// Where free bodies are after a step, by either engine (u and rad): every step agrees to this.
const FREE: f32 = 1e-4;
/// What of all other steps stays under which distance (u): percent and limit.
const CARRYING: [(usize, f32); 2] = [(50, 5e-4), (90, 0.008)];
const CONTACT: [(usize, f32); 3] = [(50, 0.001), (80, 0.01), (90, 0.025)];

/// What went on in a step.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Going {
    /// Nothing touched anything.
    Free,
    /// Something was held, and nothing else touched anything.
    Carrying,
    /// Bodies touched each other or walls.
    Contact,
}

/// One step by both.
#[derive(Debug)]
struct Compared {
    going: Going,
    /// Greatest distance between the positions of any body (u) and between its angles (rad).
    error: [f32; 2],
    same_grips: bool,
}

fn compare(physique: &Physique, start: &State, actions: &[[Action; 2]]) -> Vec<Compared> {
    let forward = Forward::new(physique);
    let mut world = World::new(physique, start);
    let one = |&actions: &[Action; 2]| {
        let before = world.state();
        let true_states = world.step(actions);
        let mut imagined = before;
        forward.step(&mut imagined, actions);
        let after = true_states[true_states.len() - 1];
        let mut all = true_states.to_vec();
        all.extend([before, imagined]);
        let errors = physique.entities().map(|entity| {
            let (a, b) = (after.body(entity), imagined.body(entity));
            [a.position.distance(b.position), (a.angle - b.angle).abs()]
        });
        let grips = |state: &State| state.grips.map(|grip| grip.map(|grip| (grip.object, grip.side)));
        Compared {
            going: going(physique, &all),
            error: errors.fold([0.0; 2], |worst, error| [0, 1].map(|k| worst[k].max(error[k]))),
            same_grips: grips(&after) == grips(&imagined),
        }
    };
    actions.iter().map(one).collect()
}

/// What went on in a step, judged by the states that either engine went through.
fn going(physique: &Physique, states: &[State]) -> Going {
    let contact = states.iter().any(|state| {
        let wide = |entity| outline(physique, state, entity, margin(physique, state, entity));
        let meets = |entity| {
            let near = |other| {
                let held = !state.contacts.touching(entity, other) && state.touching(entity, other);
                !held && wide(entity).overlaps(&wide(other))
            };
            !clear_of_walls(physique, state, entity, margin(physique, state, entity))
                || physique.entities().filter(|&other| other != entity).any(near)
        };
        state.contacts != Contacts::NONE || physique.entities().any(meets)
    });
    let held = states.iter().any(|state| state.grips.iter().any(Option::is_some));
    match (contact, held) {
        (true, _) => Going::Contact,
        (false, true) => Going::Carrying,
        (false, false) => Going::Free,
    }
}

/// How far a body may come in one substep, and a little more (u): nothing may happen between two states either.
fn margin(physique: &Physique, state: &State, entity: Entity) -> f32 {
    let body = state.body(entity);
    let corners = 2.0 * physique.radius(entity) * body.angular_velocity.abs();
    CLEARANCE + 1.2 * (body.velocity.length() + corners) * arena::SUBSTEP_SECONDS
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn free_bodies_go_the_same_way((physique, start) in apart(), actions in actions(RUNS)) {
        for (k, step) in compare(&physique, &start, &actions).into_iter().enumerate() {
            prop_assert!(step.same_grips, "step {k} {:?}: {step:?}", actions[k]);
            let [position, angle] = step.error;
            let agree = position <= FREE && angle <= FREE;
            prop_assert!(agree || step.going != Going::Free, "step {k} {:?}: {step:?}", actions[k]);
        }
    }
}

/// Contact is chaotic, so single steps may part company; the bulk of them may not.
#[test]
fn one_step_ahead_over_many_scenes() {
    let mut runner = TestRunner::deterministic();
    let strategy = (apart(), actions(RUNS));
    let mut steps = Vec::new();
    for _ in 0..SCENES {
        let ((physique, start), actions) = strategy.new_tree(&mut runner).expect("a scene").current();
        steps.extend(compare(&physique, &start, &actions));
    }
    let limits =
        [(Going::Free, &[(100, FREE)][..]), (Going::Carrying, &CARRYING), (Going::Contact, &CONTACT)];
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

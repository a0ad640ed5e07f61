//! A step allocates nothing, whatever happens in it.

mod scenes;

use core::hint::black_box;
use phase_forward::{Exertion, Forward};
use phase_model::{Contacts, Dynamics, arena::SUBSTEPS};
use proptest::{
    strategy::{Strategy, ValueTree},
    test_runner::TestRunner,
};
use scenes::{actions, clear_of_walls, separated_bodies};

/// Scenes, and runs of held actions in each.
const SCENES: usize = 250;
const RUNS: usize = 10;
/// Worlds stepped together.
const WORLDS: usize = 11;

#[test]
fn steps_allocate_nothing() {
    let counted = allocation_counter::measure(|| drop(black_box(vec![1_u8])));
    assert_eq!(counted.count_total, 1, "allocations are counted");

    let mut runner = TestRunner::deterministic();
    let strategy = (separated_bodies(), actions(RUNS));
    let (mut steps, mut gripping, mut touching, mut at_walls) = (0, 0, 0, 0);
    for _ in 0..SCENES {
        let ((physics, start), actions) = strategy.new_tree(&mut runner).expect("a scene").current();
        let forward = Forward::new(&physics);
        let (mut cold, mut warm, mut solver_cache) = (start, start, forward.fresh_cache(&start));
        for actions in actions {
            let allocated = |what: &str, step: &mut dyn FnMut()| {
                assert_eq!(allocation_counter::measure(step).count_total, 0, "{what}: {actions:?}");
            };
            let mut same = cold;
            allocated("step_substeps", &mut || {
                black_box(forward.step_substeps(&mut same, actions));
            });
            allocated("step", &mut || forward.step(&mut cold, actions));
            let mut imagined = cold;
            let (mut worlds, mut imagined_worlds) = ([cold; WORLDS], [cold; WORLDS]);
            allocated("step_batch", &mut || forward.step_batch(&mut worlds, &[actions; WORLDS]));
            allocated("step_approximate_batch", &mut || {
                forward.step_approximate_batch(&mut imagined_worlds, &[actions; WORLDS]);
            });
            allocated("step_coarse", &mut || forward.step_coarse(&mut imagined, actions));
            let (mut worlds, mut caches) = ([warm; WORLDS], [solver_cache; WORLDS]);
            let max_forces = physics.agents.each_ref().map(|agent| agent.max_force);
            let exertions = [Exertion { actions, max_forces }; WORLDS];
            let mut substeps = [[warm; SUBSTEPS]; WORLDS];
            allocated("step_warm_batch", &mut || {
                forward.step_warm_batch(&mut worlds, &mut caches, &exertions, &mut substeps);
            });
            allocated("step_warm", &mut || {
                black_box(forward.step_warm(&mut warm, &mut solver_cache, actions));
            });
            steps += 1;
            gripping += usize::from(cold.grips.iter().any(Option::is_some));
            touching += usize::from(cold.contacts != Contacts::NONE);
            at_walls +=
                usize::from(physics.entities().any(|entity| !clear_of_walls(&physics, &cold, entity, 0.02)));
        }
    }
    println!(
        "{steps} steps, {gripping} with grips, {touching} with contacts, {at_walls} at walls: 0 allocations"
    );
    assert!(steps > 5_000 && gripping > 200 && touching > 200 && at_walls > 200);
}

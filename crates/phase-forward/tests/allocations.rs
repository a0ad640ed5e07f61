//! A step allocates nothing, whatever happens in it.

#[path = "forward/scenes.rs"]
mod scenes;

use core::hint::black_box;
use phase_forward::Forward;
use phase_model::{Contacts, Dynamics};
use proptest::{
    strategy::{Strategy, ValueTree},
    test_runner::TestRunner,
};
use scenes::{actions, clear_of_walls, separated_bodies};

/// Scenes, and runs of held actions in each.
const SCENES: usize = 250;
const RUNS: usize = 10;

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
            allocated("step_coarse", &mut || forward.step_coarse(&mut imagined, actions));
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

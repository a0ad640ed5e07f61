//! Several trees for one decision.

use phase_pomcp::{Forest, Pomcp, PomcpError, PomcpSettings};
use proptest::prelude::*;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::arbitrary::{problem, settings};

proptest! {
    #[test]
    fn a_forest_is_the_sum_of_its_trees(
        problem in problem(), settings in settings(), seed: u64, trees in 1..6_usize, batch in 1..9_usize
    ) {
        let settings = PomcpSettings { batch, ..settings };
        let roots: Vec<u64> = (0..problem.states).collect();
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut seeds = random.clone();
        let found = Forest::new(settings, trees).unwrap().search(&problem, &roots, &mut random).unwrap();
        let single: Vec<_> = (0..trees)
            .map(|_| {
                let mut random = Pcg64Mcg::seed_from_u64(seeds.next_u64());
                Pomcp::new(settings).unwrap().search(&problem, &roots, &mut random).unwrap()
            })
            .collect();
        prop_assert_eq!(&random, &seeds);
        for (action, total) in found.actions.iter().enumerate() {
            let trees = || single.iter().map(|decision| decision.actions[action]);
            prop_assert_eq!(total.visits, trees().map(|found| found.visits).sum::<usize>());
            let sum: f64 = trees().map(|found| found.visits as f64 * found.value).sum();
            let scale = 1.0 + trees().map(|found| found.visits as f64 * found.value.abs()).sum::<f64>();
            prop_assert!((total.visits as f64 * total.value - sum).abs() <= 1e-9 * scale);
        }
        let most = found.actions.iter().map(|found| found.visits).max();
        prop_assert_eq!(Some(found.actions[found.action].visits), most);
        prop_assert_eq!(found.effort.steps, single.iter().map(|decision| decision.effort.steps).sum::<usize>());
        prop_assert_eq!(Some(found.effort.depth), single.iter().map(|decision| decision.effort.depth).max());
    }
}

/// The same bits whatever the number of threads.
#[cfg(feature = "parallel")]
#[test]
fn threads_change_nothing() {
    let problem = crate::batch::FIXED;
    let decide = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut forest = Forest::new(PomcpSettings::default(), 7).unwrap();
        pool.install(|| forest.search(&problem, &[0, 1, 2], &mut Pcg64Mcg::seed_from_u64(3)).unwrap())
    };
    let serial = decide(1);
    assert_eq!(decide(2), serial);
    assert_eq!(decide(5), serial);
}

#[test]
fn a_forest_has_trees() {
    assert_eq!(Forest::<()>::new(PomcpSettings::default(), 0).err(), Some(PomcpError::ZeroTrees));
    let batch = PomcpSettings { batch: 0, ..PomcpSettings::default() };
    assert_eq!(Forest::<()>::new(batch, 2).err(), Some(PomcpError::ZeroBatch));
}

//! Invariants of every search of every problem.

use phase_pomcp::{Pomcp, PomcpSettings};
use proptest::prelude::*;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use crate::arbitrary::{Arbitrary, Certain, problem, settings};

proptest! {
    #[test]
    fn stopping_early_decides_the_same(
        problem in problem(), settings in settings(), seed: u64
    ) {
        let roots: Vec<u64> = (0..problem.states).collect();
        let search = |stop_when_decided| {
            let settings = PomcpSettings { stop_when_decided, ..settings };
            let mut random = Pcg64Mcg::seed_from_u64(seed);
            Pomcp::new(settings).unwrap().search(&problem, &roots, &mut random).unwrap()
        };
        let (whole, early) = (search(false), search(true));
        prop_assert_eq!(early.action, whole.action);
        // The omitted simulations could not have changed the order.
        let run: usize = early.actions.iter().map(|action| action.visits).sum();
        let mut visits: Vec<usize> = early.actions.iter().map(|action| action.visits).collect();
        visits.sort_unstable_by(|a, b| b.cmp(a));
        let lead = visits[0] - visits.get(1).copied().unwrap_or(0);
        prop_assert!(run == settings.simulations || lead > settings.simulations - run);
        // And not one simulation more than necessary was run.
        prop_assert!(run == settings.simulations || lead <= settings.simulations - run + 2);
    }

    #[test]
    fn a_converged_search_ends_where_doubling_it_changed_little(
        problem in problem(), settings in settings(), seed: u64, convergence in 0.01..0.5_f64
    ) {
        let roots: Vec<u64> = (0..problem.states).collect();
        let policy = |simulations, convergence| -> (usize, Vec<f64>) {
            let settings = PomcpSettings { simulations, convergence, ..settings };
            let mut random = Pcg64Mcg::seed_from_u64(seed);
            let decision = Pomcp::new(settings).unwrap().search(&problem, &roots, &mut random).unwrap();
            let run: usize = decision.actions.iter().map(|action| action.visits).sum();
            (run, decision.actions.iter().map(|action| action.visits as f64 / run as f64).collect())
        };
        let (run, shares) = policy(600, convergence);
        // As many simulations without the rule do the same.
        prop_assert_eq!(&policy(run, 0.0).1, &shares);
        let change = |run| {
            let (half, whole): (Vec<f64>, Vec<f64>) = (policy(run / 2, 0.0).1, policy(run, 0.0).1);
            0.5 * half.iter().zip(&whole).map(|(a, b)| (a - b).abs()).sum::<f64>()
        };
        prop_assert!([128, 256, 512, 600].contains(&run));
        prop_assert!(run == 600 || change(run) < convergence);
        for earlier in [128, 256, 512].into_iter().filter(|&earlier| earlier < run) {
            prop_assert!(change(earlier) >= convergence);
        }
    }

    #[test]
    fn remembered_steps_change_nothing(problem in problem(), settings in settings(), seed: u64) {
        let search = |says_so| {
            let mut random = Pcg64Mcg::seed_from_u64(seed);
            let model = Certain { problem: problem.clone(), says_so };
            (Pomcp::new(settings).unwrap().search(&model, &[0], &mut random).unwrap(), random)
        };
        let ((plain, left), (remembered, also_left)) = (search(false), search(true));
        prop_assert_eq!(&remembered.actions, &plain.actions);
        prop_assert_eq!(remembered.action, plain.action);
        prop_assert_eq!(also_left, left);
        prop_assert_eq!(remembered.effort.histories, plain.effort.histories);
        prop_assert!(remembered.effort.steps <= plain.effort.steps);
    }

    #[test]
    fn evidence_adds_up(
        problem in problem(), settings in settings(), seed: u64, other_seed: u64
    ) {
        let roots: Vec<u64> = (0..problem.states).collect();
        let mut pomcp = Pomcp::new(settings).unwrap();
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let decision = pomcp.search(&problem, &roots, &mut random).unwrap();

        prop_assert_eq!(decision.actions.len(), problem.actions);
        let visits: usize = decision.actions.iter().map(|action| action.visits).sum();
        prop_assert_eq!(visits, settings.simulations);
        let most = decision.actions.iter().map(|action| action.visits).max();
        prop_assert_eq!(Some(decision.actions[decision.action].visits), most);
        prop_assert!(most > Some(0));

        // A return is at most the best reward at every possible step, and at least the worst.
        let effort = decision.effort;
        let longest = (effort.depth + settings.rollout_steps).min(settings.horizon);
        let weights: f64 = (0..longest).map(|step| problem.discount.powi(step as i32)).sum();
        let (low, high) = (problem.rewards.0.min(0.0) * weights, problem.rewards.1.max(0.0) * weights);
        for action in decision.actions.iter().filter(|action| action.visits > 0) {
            prop_assert!((low - 1e-6..=high + 1e-6).contains(&action.value), "{:?}", action);
        }

        prop_assert!((1..=settings.simulations + 1).contains(&effort.histories));
        prop_assert!((1..=settings.simulations.min(settings.horizon)).contains(&effort.depth));
        prop_assert!(effort.steps >= settings.simulations);
        prop_assert!(effort.steps <= settings.simulations * longest);

        // The same search again is the same to the last bit, and so is the generator's state afterwards,
        // whether the memory is new or was used for something else.
        let mut again = Pcg64Mcg::seed_from_u64(seed);
        let fresh = Pomcp::new(settings).unwrap().search(&problem, &roots, &mut again).unwrap();
        prop_assert_eq!(&fresh, &decision);
        prop_assert_eq!(&again, &random);
        pomcp.search(&problem, &roots[..1], &mut Pcg64Mcg::seed_from_u64(other_seed)).unwrap();
        let mut reused = Pcg64Mcg::seed_from_u64(seed);
        prop_assert_eq!(&pomcp.search(&problem, &roots, &mut reused).unwrap(), &decision);
        prop_assert_eq!(&reused, &random);
    }
}

/// The seed has an effect: if it were ignored, the determinism above would be trivial.
#[test]
fn another_seed_is_another_search() {
    let problem = Arbitrary {
        seed: 4,
        states: 3,
        actions: 3,
        observations: 3,
        discount: 0.9,
        rewards: (-1.0, 1.0),
        ends: 0.0,
    };
    let mut pomcp = Pomcp::new(PomcpSettings::default()).unwrap();
    let mut search = |seed| pomcp.search(&problem, &[0, 1, 2], &mut Pcg64Mcg::seed_from_u64(seed)).unwrap();
    assert_ne!(search(1), search(2));
}

//! Searches with several simulations in progress.

use std::cell::RefCell;

use phase_pomcp::{Decision, GenerativeModel, Pomcp, PomcpError, PomcpSettings, Transition};
use proptest::prelude::*;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::arbitrary::{Arbitrary, Certain, problem, settings};

/// A problem that computes all steps of a round in one loop, and notes how many there were.
struct Together {
    problem: Arbitrary,
    rounds: RefCell<Vec<usize>>,
}

impl GenerativeModel for Together {
    type State = u64;
    type Observation = u64;

    fn action_count(&self) -> usize {
        self.problem.actions
    }

    fn discount(&self) -> f64 {
        self.problem.discount
    }

    fn step(&self, state: &mut u64, action: usize, random: &mut impl Rng) -> Transition<u64> {
        self.problem.step(state, action, random)
    }

    fn advance_batch(
        &self,
        states: &mut [u64],
        actions: &[usize],
        in_tree: usize,
        random: &mut impl Rng,
        outcomes: &mut Vec<Transition<u64>>,
        rollout_outcomes: &mut Vec<Transition<()>>,
    ) {
        assert_eq!(states.len(), actions.len());
        self.rounds.borrow_mut().push(states.len());
        for (index, (state, &action)) in states.iter_mut().zip(actions).enumerate() {
            let outcome = self.problem.step(state, action, random);
            let Transition { reward, terminal, .. } = outcome;
            if index < in_tree {
                outcomes.push(outcome);
            } else {
                rollout_outcomes.push(Transition { observation: (), reward, terminal });
            }
        }
    }
}

/// The decision, and what the search left of the generator.
fn search<M>(model: &M, states: u64, settings: PomcpSettings, seed: u64) -> (Decision, Pcg64Mcg)
where
    M: GenerativeModel<State = u64, Observation = u64>,
{
    let roots: Vec<u64> = (0..states).collect();
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut pomcp = Pomcp::new(settings).expect("the settings are valid");
    (pomcp.search(model, &roots, &mut random).expect("the problem can be searched"), random)
}

fn visits(decision: &Decision) -> usize {
    decision.actions.iter().map(|action| action.visits).sum()
}

proptest! {
    #[test]
    fn steps_computed_together_change_nothing_and_fill_the_batch(
        problem in problem(), settings in settings(), seed: u64, batch in 2..40_usize
    ) {
        let settings = PomcpSettings { batch, simulations: settings.simulations + 1, ..settings };
        let one_by_one = search(&problem, problem.states, settings, seed);
        let together = Together { problem, rounds: RefCell::default() };
        prop_assert_eq!(&search(&together, together.problem.states, settings, seed), &one_by_one);
        // Every round is full until no more simulations wait to begin.
        let rounds = together.rounds.into_inner();
        prop_assert_eq!(rounds[0], batch.min(settings.simulations));
        prop_assert!(rounds.is_sorted_by(|earlier, later| earlier >= later), "{:?}", rounds);
        prop_assert_eq!(rounds.iter().sum::<usize>(), one_by_one.0.effort.steps);
        prop_assert_eq!(visits(&one_by_one.0), settings.simulations);
    }

    #[test]
    fn a_batch_is_never_more_than_all_simulations(
        problem in problem(), settings in settings(), seed: u64, more in 0..20_usize
    ) {
        let all = PomcpSettings { batch: settings.simulations, ..settings };
        let larger = PomcpSettings { batch: settings.simulations + more, ..settings };
        let states = problem.states;
        prop_assert_eq!(search(&problem, states, larger, seed), search(&problem, states, all, seed));
    }

    /// In batches, too, the steps of a deterministic problem are those that the problem computes.
    #[test]
    fn remembered_steps_are_the_problems_own(
        problem in problem(), settings in settings(), seed: u64, batch in 2..40_usize
    ) {
        let settings = PomcpSettings { batch, ..settings };
        // Values of a problem with one action and no observation have a single right answer.
        let single = Arbitrary { actions: 1, observations: 1, ..problem.clone() };
        let value = |says_so, settings| {
            search(&Certain { problem: single.clone(), says_so }, 1, settings, seed).0
        };
        let settings_to_the_end = PomcpSettings { horizon: 12, rollout_steps: 12, ..settings };
        let (computed, remembered) = (value(false, settings_to_the_end), value(true, settings_to_the_end));
        let scale = 1.0 + computed.value().abs();
        prop_assert!((computed.value() - remembered.value()).abs() < 1e-9 * scale);
        prop_assert!(remembered.effort.steps <= computed.effort.steps);
        let decision = search(&Certain { problem, says_so: true }, 1, settings, seed).0;
        prop_assert_eq!(visits(&decision), settings.simulations);
        prop_assert!(decision.effort.histories <= settings.simulations + 1);
    }
}

/// Only steps of each kind are computed together.
struct Kinds {
    problem: Arbitrary,
    sizes: RefCell<[usize; 2]>,
}

impl GenerativeModel for Kinds {
    type State = u64;
    type Observation = u64;

    fn action_count(&self) -> usize {
        self.problem.actions
    }

    fn discount(&self) -> f64 {
        self.problem.discount
    }

    fn step(&self, state: &mut u64, action: usize, random: &mut impl Rng) -> Transition<u64> {
        self.problem.step(state, action, random)
    }

    fn step_batch(
        &self,
        states: &mut [u64],
        actions: &[usize],
        random: &mut impl Rng,
        outcomes: &mut Vec<Transition<u64>>,
    ) {
        self.sizes.borrow_mut()[0] += states.len();
        outcomes
            .extend(states.iter_mut().zip(actions).map(|(state, &action)| self.step(state, action, random)));
    }

    fn rollout_step_batch(
        &self,
        states: &mut [u64],
        actions: &[usize],
        random: &mut impl Rng,
        outcomes: &mut Vec<Transition<()>>,
    ) {
        self.sizes.borrow_mut()[1] += states.len();
        let pairs = states.iter_mut().zip(actions);
        outcomes.extend(pairs.map(|(state, &action)| self.rollout_step(state, action, random)));
    }
}

pub(crate) const FIXED: Arbitrary = Arbitrary {
    seed: 4,
    states: 3,
    actions: 3,
    observations: 3,
    discount: 0.9,
    rewards: (-1.0, 1.0),
    ends: 0.0,
};

/// The lanes that the last simulations leave empty are few, also where rollouts of ten steps end at any time.
#[test]
fn rounds_are_nearly_full() {
    for (ends, simulations, least) in
        [(0.0, 250, 0.95), (0.1, 250, 0.95), (0.0, 1000, 0.99), (0.1, 1000, 0.99)]
    {
        let together = Together { problem: Arbitrary { ends, ..FIXED }, rounds: RefCell::default() };
        let settings = PomcpSettings { simulations, batch: 8, ..PomcpSettings::default() };
        let (decision, _) = search(&together, 3, settings, 1);
        let fill = decision.effort.steps as f64 / (8 * together.rounds.borrow().len()) as f64;
        assert!(fill > least, "{simulations} simulations that end with probability {ends}: {fill}");
    }
}

#[test]
fn each_kind_of_step_has_its_batch() {
    let settings = PomcpSettings { batch: 8, ..PomcpSettings::default() };
    let kinds = Kinds { problem: FIXED, sizes: RefCell::default() };
    let found = search(&kinds, 3, settings, 1);
    assert_eq!(found, search(&FIXED, 3, settings, 1));
    let [in_tree, in_rollouts] = kinds.sizes.into_inner();
    assert_eq!(in_tree + in_rollouts, found.0.effort.steps);
    // Nothing ends: every simulation has a whole rollout.
    assert_eq!(in_rollouts, 10 * settings.simulations);
}

/// With one action and no observation, simulations that begin together meet at the same new history. The first adds
/// it; the others, which know nothing of it yet, follow the default policy from there too.
#[test]
fn what_nothing_is_known_of_yet_is_not_searched() {
    let path = Arbitrary { actions: 1, observations: 1, ..FIXED };
    for (simulations, histories) in [(4, 2), (5, 3), (8, 3), (9, 4)] {
        let settings = PomcpSettings { simulations, batch: 4, ..PomcpSettings::default() };
        let effort = search(&path, 3, settings, 1).0.effort;
        // Four at a time: each four go one history deeper than those before, and have ten steps from there.
        assert_eq!((effort.histories, effort.depth), (histories, histories - 1), "{simulations} simulations");
    }
}

/// Forgets the outcome of a batch's last step.
struct Forgetful;

impl GenerativeModel for Forgetful {
    type State = ();
    type Observation = ();

    fn action_count(&self) -> usize {
        2
    }

    fn discount(&self) -> f64 {
        0.9
    }

    fn step(&self, _: &mut (), _: usize, _: &mut impl Rng) -> Transition<()> {
        Transition { observation: (), reward: 1.0, terminal: false }
    }

    fn step_batch(
        &self,
        states: &mut [()],
        _: &[usize],
        _: &mut impl Rng,
        outcomes: &mut Vec<Transition<()>>,
    ) {
        let outcome = Transition { observation: (), reward: 1.0, terminal: false };
        outcomes.extend(vec![outcome; states.len().saturating_sub(1)]);
    }
}

#[test]
fn an_outcome_that_is_missing_is_noticed() {
    let mut pomcp = Pomcp::new(PomcpSettings { batch: 4, ..PomcpSettings::default() }).unwrap();
    let found = pomcp.search(&Forgetful, &[()], &mut Pcg64Mcg::seed_from_u64(1));
    assert_eq!(found, Err(PomcpError::OutcomeCount { outcomes: 3, states: 4 }));
}

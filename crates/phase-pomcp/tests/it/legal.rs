//! Actions that are legal in some states only.

use phase_pomcp::{GenerativeModel, Pomcp, PomcpError, PomcpSettings, Transition};
use proptest::prelude::*;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// In state s, a number below 16, the actions are legal whose bit s has set. Each pays its index and leads to
/// the state of the same hash; taking another one panics.
#[derive(Debug, Clone)]
struct Masked {
    seed: u64,
    weights: Vec<f64>,
}

const ACTIONS: usize = 4;
const STATES: u64 = 1 << ACTIONS;

impl GenerativeModel for Masked {
    type State = u64;
    type Observation = u64;

    fn action_count(&self) -> usize {
        ACTIONS
    }

    fn discount(&self) -> f64 {
        0.5
    }

    fn is_legal(&self, &state: &u64, action: usize) -> bool {
        state >> action & 1 == 1
    }

    fn step(&self, state: &mut u64, action: usize, _: &mut impl Rng) -> Transition<u64> {
        assert!(self.is_legal(state, action), "{action} in {state}");
        let hash = (self.seed ^ (*state << 8) ^ action as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        *state = 1 + (hash >> 40) % (STATES - 1);
        Transition { observation: *state, reward: action as f64, terminal: false }
    }

    fn prior_weight(&self, _: &u64, action: usize) -> f64 {
        self.weights[action]
    }
}

proptest! {
    #[test]
    fn illegal_actions_are_never_taken(
        seed: u64,
        root in 1..STATES,
        weights in proptest::collection::vec(0.1..5.0_f64, ACTIONS),
        untried_first: bool,
    ) {
        let model = Masked { seed, weights };
        let settings = PomcpSettings { simulations: 300, untried_first, ..PomcpSettings::default() };
        let mut pomcp = Pomcp::new(settings).unwrap();
        let decision = pomcp.search(&model, &[root], &mut Pcg64Mcg::seed_from_u64(seed)).unwrap();
        prop_assert!(model.is_legal(&root, decision.action));
        for (action, found) in decision.actions.iter().enumerate() {
            // Three hundred simulations are enough for every legal one of four.
            let legal = model.is_legal(&root, action);
            let visited = found.visits > 0;
            let as_allowed = if untried_first { visited == legal } else { !visited || legal };
            prop_assert!(as_allowed, "{}: {:?}", action, found);
        }
        prop_assert_eq!(decision.actions.iter().map(|found| found.visits).sum::<usize>(), 300);
    }
}

/// One step, of equal value: visits follow the priors among the legal actions.
struct Once;

impl GenerativeModel for Once {
    type State = ();
    type Observation = ();

    fn action_count(&self) -> usize {
        3
    }

    fn discount(&self) -> f64 {
        1.0
    }

    fn is_legal(&self, (): &(), action: usize) -> bool {
        action != 0
    }

    fn step(&self, (): &mut (), _: usize, _: &mut impl Rng) -> Transition<()> {
        Transition { observation: (), reward: 1.0, terminal: true }
    }

    fn prior_weight(&self, (): &(), action: usize) -> f64 {
        [f64::NAN, 1.0, 3.0][action]
    }
}

#[test]
fn priors_are_shared_among_legal_actions() {
    let settings = PomcpSettings { simulations: 400, untried_first: false, ..PomcpSettings::default() };
    let decision =
        Pomcp::new(settings).unwrap().search(&Once, &[()], &mut Pcg64Mcg::seed_from_u64(1)).unwrap();
    let visits: Vec<usize> = decision.actions.iter().map(|found| found.visits).collect();
    assert_eq!(visits[0], 0);
    assert!(visits[1].abs_diff(100) <= 2 && visits[2].abs_diff(300) <= 2, "{visits:?}");
}

/// The actions that are legal at the start and after one step, and that of the default policy.
struct Rules {
    legal: [[bool; 2]; 2],
    rollout: Option<usize>,
}

impl GenerativeModel for Rules {
    type State = usize;
    type Observation = ();

    fn action_count(&self) -> usize {
        2
    }

    fn discount(&self) -> f64 {
        1.0
    }

    fn is_legal(&self, &time: &usize, action: usize) -> bool {
        self.legal[time.min(1)][action]
    }

    fn step(&self, time: &mut usize, _: usize, _: &mut impl Rng) -> Transition<()> {
        *time += 1;
        Transition { observation: (), reward: 1.0, terminal: false }
    }

    fn rollout_action(&self, &time: &usize, _: &mut impl Rng) -> usize {
        self.rollout.unwrap_or_else(|| usize::from(!self.is_legal(&time, 0)))
    }
}

#[test]
fn rules_that_allow_nothing_are_named() {
    let search = |legal, rollout, rollout_steps| {
        let settings = PomcpSettings { rollout_steps, simulations: 50, ..PomcpSettings::default() };
        let mut pomcp = Pomcp::new(settings).expect("the settings are valid");
        pomcp.search(&Rules { legal, rollout }, &[0], &mut Pcg64Mcg::seed_from_u64(1)).err()
    };
    let (all, first, none) = ([true; 2], [true, false], [false; 2]);
    assert_eq!(search([all, first], None, 10), None);
    assert_eq!(search([none, all], None, 10), Some(PomcpError::NoLegalAction));
    assert_eq!(search([all, none], None, 0), Some(PomcpError::NoLegalAction));
    assert_eq!(search([all, first], Some(1), 10), Some(PomcpError::IllegalRolloutAction { action: 1 }));
    assert_eq!(search([all, none], None, 10), Some(PomcpError::IllegalRolloutAction { action: 1 }));
}

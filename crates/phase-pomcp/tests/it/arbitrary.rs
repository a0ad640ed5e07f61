//! Problems whose transitions, observations and rewards are arbitrary but fixed, and settings to search them
//! with.

use phase_pomcp::{GenerativeModel, PomcpSettings, Transition};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A problem whose transitions, observations and rewards are arbitrary but fixed, with some randomness added.
#[derive(Debug, Clone)]
pub(crate) struct Arbitrary {
    pub(crate) seed: u64,
    pub(crate) states: u64,
    pub(crate) actions: usize,
    pub(crate) observations: u64,
    pub(crate) discount: f64,
    pub(crate) rewards: (f64, f64),
    pub(crate) ends: f64,
}

impl GenerativeModel for Arbitrary {
    type State = u64;
    type Observation = u64;

    fn action_count(&self) -> usize {
        self.actions
    }

    fn discount(&self) -> f64 {
        self.discount
    }

    fn step(&self, state: &mut u64, action: usize, random: &mut impl rand::Rng) -> Transition<u64> {
        let key = self.seed ^ (*state << 32) ^ ((action as u64) << 16) ^ random.random_range(0..3);
        let mut fixed = Pcg64Mcg::seed_from_u64(key);
        *state = fixed.random_range(0..self.states);
        let (low, high) = self.rewards;
        Transition {
            observation: fixed.random_range(0..self.observations),
            reward: low + (high - low) * fixed.random::<f64>(),
            terminal: fixed.random_bool(self.ends),
        }
    }
}

/// A deterministic problem, which declares that or not.
#[derive(Debug, Clone)]
pub(crate) struct Certain {
    pub(crate) problem: Arbitrary,
    pub(crate) says_so: bool,
}

impl GenerativeModel for Certain {
    type State = u64;
    type Observation = u64;

    fn action_count(&self) -> usize {
        self.problem.actions
    }

    fn discount(&self) -> f64 {
        self.problem.discount
    }

    fn step(&self, state: &mut u64, action: usize, _random: &mut impl rand::Rng) -> Transition<u64> {
        self.problem.step(state, action, &mut Pcg64Mcg::seed_from_u64(0))
    }

    fn is_deterministic(&self) -> bool {
        self.says_so
    }
}

/// Problems of all kinds.
pub(crate) fn problem() -> impl Strategy<Value = Arbitrary> {
    let sizes = (any::<u64>(), 1..5_u64, 1..6_usize, 1..6_u64);
    let rewards = (-100.0..100.0_f64, 0.0..100.0_f64);
    let numbers = (0.0..=1.0_f64, rewards, prop_oneof![Just(0.0), 0.0..0.5_f64]);
    (sizes, numbers).prop_map(|((seed, states, actions, observations), (discount, (low, span), ends))| {
        Arbitrary { seed, states, actions, observations, discount, rewards: (low, low + span), ends }
    })
}

/// Settings of all kinds.
pub(crate) fn settings() -> impl Strategy<Value = PomcpSettings> {
    let horizon = prop_oneof![1..20_usize, Just(usize::MAX)];
    let flags = (any::<bool>(), any::<bool>());
    (1..300_usize, 0..15_usize, 0.0..3.0_f64, 1.0..1e4_f64, horizon, flags).prop_map(
        |(simulations, rollout_steps, c_init, c_base, horizon, (normalise_values, untried_first))| {
            PomcpSettings {
                stop_when_decided: false,
                convergence: 0.0,
                untried_first,
                simulations,
                rollout_steps,
                c_init,
                c_base,
                horizon,
                normalise_values,
            }
        },
    )
}

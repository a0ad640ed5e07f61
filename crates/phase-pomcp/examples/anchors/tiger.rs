//! The tiger behind one of two doors (Kaelbling, Littman & Cassandra 1998).

use crate::episodes::Problem;
use phase_pomcp::{BeliefModel, GenerativeModel, PomcpSettings, Transition};
use rand::{Rng, RngExt};

/// Listening costs 1 and is correct 85 times in 100; the tiger's door costs 100, the other earns 10, and
/// either restarts the problem. From an even belief the optimum is 19.37.
pub(crate) struct Tiger;

const LISTEN: usize = 0;
const OPEN_LEFT: usize = 1;
/// Probability of hearing the tiger where it is.
const ACCURACY: f64 = 0.85;

impl GenerativeModel for Tiger {
    type State = bool; // whether the tiger is on the left
    type Observation = Option<bool>; // whether it was heard there; nothing is heard when a door is opened

    fn action_count(&self) -> usize {
        3
    }

    fn discount(&self) -> f64 {
        0.95
    }

    fn step(&self, left: &mut bool, action: usize, random: &mut impl Rng) -> Transition<Option<bool>> {
        if action == LISTEN {
            let heard = *left == random.random_bool(ACCURACY);
            return Transition { observation: Some(heard), reward: -1.0, terminal: false };
        }
        let reward = if *left == (action == OPEN_LEFT) { -100.0 } else { 10.0 };
        *left = random.random();
        Transition { observation: None, reward, terminal: false }
    }

    /// Opening doors blindly says nothing about the value of a belief, so rollouts only listen.
    fn rollout_action(&self, _: &bool, _: &mut impl Rng) -> usize {
        LISTEN
    }
}

impl BeliefModel for Tiger {}

impl Problem for Tiger {
    /// The tiger's worst return sets the scale of values, about −130 to 20, on which a listening action that
    /// pays is only a hundredth better than one that does not; a small exploration rate distinguishes them.
    const SETTINGS: PomcpSettings = PomcpSettings {
        simulations: 1000,
        rollout_steps: 10,
        c_init: 0.6,
        c_base: 1e6,
        horizon: usize::MAX,
        normalise_values: true,
        stop_when_decided: false,
        convergence: 0.0,
        untried_first: true,
    };

    fn start(&self, random: &mut impl Rng) -> bool {
        random.random()
    }

    fn imagine(&self, _: &bool, random: &mut impl Rng) -> bool {
        random.random()
    }
}

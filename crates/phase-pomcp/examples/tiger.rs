//! Definition and solution of a custom problem: the tiger behind one of two doors (Kaelbling, Littman &
//! Cassandra 1998).
//!
//! The problem is the `impl` block, the solution is `main`: twelve steps of an episode, with a search and an
//! update of the belief at each, and the tree of the first search. Run it with `cargo run --release -p
//! phase-pomcp --example tiger -- [SEED]`; the example `anchors` measures the returns of whole episodes.

use phase_pomcp::{BeliefModel, GenerativeModel, ParticleBelief, Pomcp, PomcpSettings, Transition};
use rand::{Rng, RngExt, SeedableRng};
use std::error::Error;

const NAMES: [&str; 3] = ["listen", "open left", "open right"];

/// Listening costs 1 and is correct 85 times in 100; the tiger's door costs 100, the other earns 10, and
/// either restarts the problem.
struct Tiger;

impl GenerativeModel for Tiger {
    type State = bool; // whether the tiger is on the left
    type Observation = Option<bool>; // whether it was heard there; nothing is heard when a door is opened

    fn action_count(&self) -> usize {
        NAMES.len()
    }

    fn discount(&self) -> f64 {
        0.95
    }

    fn step(&self, left: &mut bool, action: usize, random: &mut impl Rng) -> Transition<Option<bool>> {
        if action == 0 {
            let heard = *left == random.random_bool(0.85);
            return Transition { observation: Some(heard), reward: -1.0, terminal: false };
        }
        let reward = if *left == (action == 1) { -100.0 } else { 10.0 };
        *left = random.random();
        Transition { observation: None, reward, terminal: false }
    }

    /// Opening doors blindly says nothing about the value of a belief, so rollouts only listen.
    fn rollout_action(&self, _: &bool, _: &mut impl Rng) -> usize {
        0
    }
}

impl BeliefModel for Tiger {}

/// The tiger's worst return sets the scale of values, about −130 to 20, on which a listening action that pays
/// is only a hundredth better than one that does not; a small exploration rate distinguishes them.
const SETTINGS: PomcpSettings = PomcpSettings {
    stop_when_decided: false,
    convergence: 0.0,
    untried_first: true,
    simulations: 4096,
    rollout_steps: 10,
    c_init: 0.6,
    c_base: 1e6,
    horizon: usize::MAX,
    normalise_values: true,
};

/// Particles of the belief.
const PARTICLES: usize = 1000;

fn main() -> Result<(), Box<dyn Error>> {
    let seed = match std::env::args().nth(1) {
        Some(seed) => seed.parse()?,
        None => 1,
    };
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(seed);
    let mut pomcp = Pomcp::new(SETTINGS)?;
    let mut tiger: bool = random.random();
    let mut belief = ParticleBelief::new((0..PARTICLES).map(|k| k % 2 == 0).collect())?;
    for step in 0..12 {
        let decision = pomcp.search(&Tiger, belief.particles(), &mut random)?;
        if step == 0 {
            // Two levels, without what fewer than 50 simulations reached; `to_dot` draws them for Graphviz.
            println!("{}", pomcp.view(2, 50));
        }
        let outcome = Tiger.step(&mut tiger, decision.action, &mut random);
        belief.update(&Tiger, decision.action, &outcome.observation, &mut random)?;
        let visits: Vec<usize> = decision.actions.iter().map(|action| action.visits).collect();
        println!("{:10}  earns {:4}  visits {visits:?}", NAMES[decision.action], outcome.reward);
    }
    Ok(())
}

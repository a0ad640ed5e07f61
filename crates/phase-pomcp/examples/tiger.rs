//! Definition and solution of a custom problem: the tiger behind one of two doors (Kaelbling, Littman &
//! Cassandra 1998).
//!
//! The problem is the `impl` block, the solution is `one_episode`; a table then shows the returns of whole
//! episodes with growing numbers of simulations. Run it with
//! `cargo run --release -p phase-pomcp --example tiger -- [EPISODES [SEED]]`.

mod support;

use phase_pomcp::{GenerativeModel, Pomcp, PomcpError, PomcpSettings, Transition};
use rand::{Rng, RngExt, SeedableRng};
use support::Problem;

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

impl Problem for Tiger {
    fn start(&self, random: &mut impl Rng) -> bool {
        random.random()
    }
}

/// The tiger's worst return sets the scale of values, about −130 to 20, on which a listening action that pays
/// is only a hundredth better than one that does not; a small exploration rate distinguishes them.
const SETTINGS: PomcpSettings = PomcpSettings {
    stop_when_decided: false,
    convergence: 0.0,
    untried_first: true,
    batch: 1,
    simulations: 1000,
    rollout_steps: 10,
    c_init: 0.6,
    c_base: 1e6,
    horizon: usize::MAX,
    normalise_values: true,
};

fn main() -> Result<(), PomcpError> {
    let (episodes, seed) = support::arguments(1000);
    one_episode(seed)?;
    support::table(&Tiger, SETTINGS, &[16, 64, 256, 1024, 4096], episodes, seed)?;
    println!("the optimum from an even belief, for ever: 19.37");
    Ok(())
}

/// Prints the actions of one episode and their explanations.
fn one_episode(seed: u64) -> Result<(), PomcpError> {
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(seed);
    let mut pomcp = Pomcp::new(PomcpSettings { simulations: 4096, ..SETTINGS })?;
    let mut tiger: bool = random.random();
    let mut belief = vec![true, false];
    for _ in 0..12 {
        let decision = pomcp.search(&Tiger, &belief, &mut random)?;
        let outcome = Tiger.step(&mut tiger, decision.action, &mut random);
        belief = support::updated(&Tiger, &belief, decision.action, &outcome.observation, &mut random);
        let visits: Vec<usize> = decision.actions.iter().map(|action| action.visits).collect();
        println!("{:10}  earns {:4}  visits {visits:?}", NAMES[decision.action], outcome.reward);
    }
    Ok(())
}

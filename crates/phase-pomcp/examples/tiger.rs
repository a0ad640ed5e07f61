//! A problem of one's own, stated and solved: the tiger behind one of two doors (Kaelbling, Littman &
//! Cassandra 1998).
//!
//! The problem is the `impl` block, the solution is `main`. Run it with
//! `cargo run --release -p phase-pomcp --example tiger`.

use phase_pomcp::{GenerativeModel, Outcome, Pomcp, PomcpError, PomcpSettings};
use rand::{Rng, RngExt, SeedableRng};

const NAMES: [&str; 3] = ["listen", "open left", "open right"];

/// Listening costs 1 and is right 85 times in 100; the tiger's door costs 100, the other earns 10, and either
/// starts the problem anew.
struct Tiger;

impl GenerativeModel for Tiger {
    type State = bool; // whether the tiger is on the left
    type Observation = Option<bool>; // whether it was heard there; nothing is heard while opening a door

    fn action_count(&self) -> usize {
        NAMES.len()
    }

    fn discount(&self) -> f64 {
        0.95
    }

    fn step(&self, left: &mut bool, action: usize, random: &mut impl Rng) -> Outcome<Option<bool>> {
        if action == 0 {
            let heard = *left == random.random_bool(0.85);
            return Outcome { observation: Some(heard), reward: -1.0, terminal: false };
        }
        let reward = if *left == (action == 1) { -100.0 } else { 10.0 };
        *left = random.random();
        Outcome { observation: None, reward, terminal: false }
    }

    /// Opening doors blindly says nothing of what a belief is worth, so rollouts only listen.
    fn rollout_action(&self, _: &bool, _: &mut impl Rng) -> usize {
        0
    }
}

fn main() -> Result<(), PomcpError> {
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(1);
    let settings = PomcpSettings { simulations: 60_000, ..PomcpSettings::default() };
    let mut pomcp = Pomcp::new(settings)?;
    let mut tiger: bool = random.random();
    let mut belief = vec![true, false];
    for _ in 0..12 {
        let decision = pomcp.search(&Tiger, &belief, &mut random)?;
        let outcome = Tiger.step(&mut tiger, decision.action, &mut random);
        belief = updated(&belief, decision.action, outcome.observation, &mut random);
        let visits: Vec<usize> = decision.actions.iter().map(|action| action.visits).collect();
        println!("{:10}  earns {:4}  visits {visits:?}", NAMES[decision.action], outcome.reward);
    }
    Ok(())
}

/// A thousand particles of `belief` after an action and what was heard: each one drawn, moved on by the model
/// itself, and kept if it heard the same.
fn updated(belief: &[bool], action: usize, observed: Option<bool>, random: &mut impl Rng) -> Vec<bool> {
    let mut kept = Vec::new();
    while kept.len() < 1000 {
        let mut particle = belief[random.random_range(0..belief.len())];
        if Tiger.step(&mut particle, action, random).observation == observed {
            kept.push(particle);
        }
    }
    kept
}

//! Whole episodes of a problem: a particle belief between real steps, and the return with a 95 % interval.

use phase_pomcp::{GenerativeModel, Pomcp, PomcpError, PomcpSettings};
use phase_statistics::{mean, standard_error};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Particles of a belief.
const PARTICLES: usize = 1000;
/// Steps after which an episode is cut: at a discount of 0.95 the remainder has a weight of 0.6 %.
const LONGEST_EPISODE: usize = 100;

/// A problem whose episodes can be simulated.
pub(crate) trait Problem: GenerativeModel {
    /// Samples a start state from the agent's initial belief.
    fn start(&self, random: &mut impl Rng) -> Self::State;

    /// Resamples part of the hidden state in a particle, consistently with all observations so far;
    /// unnecessary for problems without particle deprivation.
    fn reinvigorate(&self, _particle: &mut Self::State, _random: &mut impl Rng) {}
}

/// Particles of `belief` after an action and an observation: each is sampled, advanced by the model itself,
/// and kept if it yields the same observation (Silver & Veness 2010, section 3.2).
pub(crate) fn updated<P: Problem>(
    problem: &P,
    belief: &[P::State],
    action: usize,
    perceived: &P::Observation,
    random: &mut impl Rng,
) -> Vec<P::State> {
    let mut kept = Vec::with_capacity(PARTICLES);
    while kept.len() < PARTICLES {
        let mut particle = belief[random.random_range(0..belief.len())].clone();
        if problem.step(&mut particle, action, random).observation == *perceived {
            problem.reinvigorate(&mut particle, random);
            kept.push(particle);
        }
    }
    kept
}

/// Simulates one episode and returns its discounted return.
fn episode<P: Problem>(
    problem: &P,
    pomcp: &mut Pomcp<P::Observation>,
    random: &mut impl Rng,
) -> Result<f64, PomcpError> {
    let mut state = problem.start(random);
    let mut belief: Vec<P::State> = (0..PARTICLES).map(|_| problem.start(random)).collect();
    let (mut earned, mut weight) = (0.0, 1.0);
    for _ in 0..LONGEST_EPISODE {
        let action = pomcp.search(problem, &belief, random)?.action;
        let outcome = problem.step(&mut state, action, random);
        earned += weight * outcome.reward;
        weight *= problem.discount();
        if outcome.terminal {
            break;
        }
        belief = updated(problem, &belief, action, &outcome.observation, random);
    }
    Ok(earned)
}

/// Prints a table: for each number of simulations the mean discounted return of the given number of episodes.
/// Episode k is simulated with seed `seed` + k in every row, so that all rows share their random draws.
pub(crate) fn table<P: Problem>(
    problem: &P,
    settings: PomcpSettings,
    rows: &[usize],
    episodes: u64,
    seed: u64,
) -> Result<(), PomcpError> {
    println!("simulations  mean discounted return of {episodes} episodes, 95 % interval (seed {seed})");
    for &simulations in rows {
        let mut pomcp = Pomcp::new(PomcpSettings { simulations, ..settings })?;
        let returns: Result<Vec<f64>, PomcpError> = (0..episodes)
            .map(|k| episode(problem, &mut pomcp, &mut Pcg64Mcg::seed_from_u64(seed.wrapping_add(k))))
            .collect();
        let returns = returns?;
        let (mean, error) =
            (mean(&returns).unwrap_or(f64::NAN), standard_error(&returns).unwrap_or_default());
        println!("{simulations:11}  {mean:.2} ± {:.2}", 1.96 * error);
    }
    Ok(())
}

/// The number of episodes and the seed from the command line.
pub(crate) fn arguments(episodes: u64) -> (u64, u64) {
    let mut numbers = std::env::args().skip(1).map(|argument| argument.parse::<u64>());
    let mut next = |otherwise| match numbers.next() {
        Some(Ok(number)) => number,
        None => otherwise,
        Some(Err(_)) => {
            eprintln!("usage: [EPISODES [SEED]], both whole numbers");
            std::process::exit(2);
        }
    };
    (next(episodes).max(1), next(1))
}

//! Whole episodes of a problem: a belief of particles between real steps, and what is earned with a 95 % interval.

use phase_pomcp::{GenerativeModel, Pomcp, PomcpError, PomcpSettings};
use phase_statistics::{mean, standard_error};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Particles of a belief.
const PARTICLES: usize = 1000;
/// Steps after which an episode is cut: at a discount of 0.95 what follows counts for 0.6 %.
const LONGEST_EPISODE: usize = 100;

/// A problem that can be played.
pub(crate) trait Problem: GenerativeModel {
    /// Draws a start, as the agent believes in it.
    fn start(&self, random: &mut impl Rng) -> Self::State;

    /// Redraws some of what is hidden in a particle, in accordance with all that has been perceived; where
    /// nothing dies out there is no need to.
    fn reinvigorate(&self, _particle: &mut Self::State, _random: &mut impl Rng) {}
}

/// Particles of `belief` after an action and what was perceived: each one drawn, moved on by the model itself,
/// and kept if it perceived the same (Silver & Veness 2010, section 3.2).
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

/// Plays one episode and returns the discounted sum of what it earned.
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

/// Prints a table: for each number of simulations the mean discounted return of so many episodes. Episode k
/// is played with seed `seed` + k in every row, so that all rows start alike.
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

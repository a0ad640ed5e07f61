//! Whole episodes of a problem: a search at every step, and a particle belief between real steps.

use phase_pomcp::{BeliefError, BeliefModel, Decision, ParticleBelief, Pomcp, PomcpError, PomcpSettings};
use phase_statistics::{mean, standard_error};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use std::{error::Error, time::Instant};

/// Steps after which an episode is cut: at a discount of 0.95 what is left has a weight of 0.6 %.
const LONGEST_EPISODE: usize = 100;
/// Standard errors on either side of the mean in an interval of 95 %.
const STANDARD_ERRORS: f64 = 1.96;

/// A problem whose episodes can be simulated.
pub(crate) trait Problem: BeliefModel + Sized {
    /// The parameters of its searches.
    const SETTINGS: PomcpSettings;

    /// What the agent knows at the start: a start state that differs in the hidden part alone.
    fn start(&self, random: &mut impl Rng) -> Self::State;

    /// As `start`, for a particle of the initial belief of an agent that starts in `state`.
    fn imagine(&self, state: &Self::State, random: &mut impl Rng) -> Self::State;

    /// A search, in the part of the tree that was kept if `reuse` is set.
    fn decide(
        &self,
        pomcp: &mut Pomcp<Self::Observation>,
        roots: &[Self::State],
        reuse: bool,
        random: &mut impl Rng,
    ) -> Result<Decision, PomcpError> {
        match reuse {
            true => pomcp.search_on(self, roots, random),
            false => pomcp.search(self, roots, random),
        }
    }

    /// An update of the belief.
    fn update(
        &self,
        belief: &mut ParticleBelief<Self::State>,
        action: usize,
        observation: &Self::Observation,
        random: &mut impl Rng,
    ) -> Result<(), BeliefError> {
        belief.update(self, action, observation, random).map(drop)
    }
}

/// What is simulated for a row of the table.
pub(crate) struct RowSettings {
    pub(crate) simulations: usize,
    pub(crate) episodes: u64,
    pub(crate) seed: u64,
    /// Whether a search goes on in the part of the tree that the last step led to.
    pub(crate) reuse: bool,
    /// The exploration rate; `None` for the problem's own.
    pub(crate) exploration: Option<f64>,
    /// Particles of a belief.
    pub(crate) particles: usize,
}

/// A row of the table.
pub(crate) struct Row {
    pub(crate) simulations: usize,
    /// The mean discounted return.
    pub(crate) mean: f64,
    /// Half the width of its 95 % interval.
    pub(crate) half_width: f64,
    /// Simulations per second and thread, searches alone.
    pub(crate) speed: f64,
    /// Real steps per episode.
    pub(crate) steps: f64,
}

/// What an episode came to.
struct Episode {
    earned: f64,
    simulations: usize,
    seconds: f64,
    steps: usize,
}

impl RowSettings {
    /// Simulates the episodes of a problem, which may differ from episode to episode.
    pub(crate) fn row<P: Problem>(
        &self,
        problem: impl Fn(&mut Pcg64Mcg) -> P + Sync,
    ) -> Result<Row, Box<dyn Error + Send + Sync>> {
        let episode = |k| {
            let mut random = Pcg64Mcg::seed_from_u64(self.seed.wrapping_add(k));
            let problem = problem(&mut random);
            self.episode(&problem, &mut random)
        };
        let episodes: Vec<Episode> =
            (0..self.episodes).into_par_iter().map(episode).collect::<Result<_, _>>()?;
        let returns: Vec<f64> = episodes.iter().map(|episode| episode.earned).collect();
        let sum = |part: fn(&Episode) -> f64| episodes.iter().map(part).sum::<f64>();
        Ok(Row {
            simulations: self.simulations,
            mean: mean(&returns).unwrap_or(f64::NAN),
            half_width: STANDARD_ERRORS * standard_error(&returns).unwrap_or(f64::NAN),
            speed: sum(|episode| episode.simulations as f64) / sum(|episode| episode.seconds),
            steps: sum(|episode| episode.steps as f64) / episodes.len() as f64,
        })
    }

    fn episode<P: Problem>(
        &self,
        problem: &P,
        random: &mut Pcg64Mcg,
    ) -> Result<Episode, Box<dyn Error + Send + Sync>> {
        let c_init = self.exploration.unwrap_or(P::SETTINGS.c_init);
        let settings = PomcpSettings { simulations: self.simulations, c_init, ..P::SETTINGS };
        let mut pomcp = Pomcp::new(settings)?;
        let mut state = problem.start(random);
        let particles = (0..self.particles).map(|_| problem.imagine(&state, random)).collect();
        let mut belief = ParticleBelief::new(particles)?;
        let mut episode = Episode { earned: 0.0, simulations: 0, seconds: 0.0, steps: 0 };
        let mut weight = 1.0;
        let mut kept = 0;
        while episode.steps < LONGEST_EPISODE {
            let start = Instant::now();
            let roots = belief.particles();
            let decision = problem.decide(&mut pomcp, roots, self.reuse, random)?;
            episode.seconds += start.elapsed().as_secs_f64();
            episode.simulations += decision.actions.iter().map(|action| action.visits).sum::<usize>() - kept;
            let outcome = problem.step(&mut state, decision.action, random);
            episode.earned += weight * outcome.reward;
            episode.steps += 1;
            weight *= problem.discount();
            if outcome.terminal {
                break;
            }
            problem.update(&mut belief, decision.action, &outcome.observation, random)?;
            if self.reuse {
                kept = pomcp.keep(decision.action, &outcome.observation);
            }
        }
        Ok(episode)
    }
}

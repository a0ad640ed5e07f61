//! The numbers of an inference.

use crate::cue::GAMMA;
use serde::{Deserialize, Serialize};

/// From what hypotheses are proposed anew.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Update {
    /// Not at all: the initial proposals stand (SIMPLE (Initial) of the ablation).
    Initial,
    /// From the whole event (SIMPLE (Global)).
    Global,
    /// From a short stretch where simulation and observation are at odds (SIMPLE (Full)).
    Local,
    /// Part by part, each from all it could be (Gibbs sweeps). Not in the paper.
    Sweep,
}

/// How to infer. The defaults are what serves best; [`Settings::published`] is the paper's.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Settings {
    /// Which proposals there are after the first.
    pub update: Update,
    /// L, iterations after the initial proposals; of sweeps, how many.
    pub iterations: usize,
    /// M, particles, each a chain of its own; at least 1.
    pub particles: usize,
    /// β of the likelihood (1/u).
    pub beta: f64,
    /// η of the choice of a stretch (1/u).
    pub eta: f64,
    /// ΔT, length of a stretch (steps).
    pub window: usize,
    /// γ of the goal proposal (1/u).
    pub gamma: f64,
    /// After how many steps a simulation is put back to the observed event; never in the paper.
    pub anchor: Option<usize>,
    /// How the agents of a simulation think.
    pub minds: phase_agent::Settings,
}

/// POMCP simulations a decision within an inference.
const SIMULATIONS: usize = 50;

impl Settings {
    /// The paper's: Algorithm 2 with M = 15, L = 6, β = 0.05, η = 0.1 and ΔT = 10, over simulations that go their own
    /// way from the start. Only γ is not the printed one (see [`GAMMA`]), and agents search with fewer simulations.
    #[must_use]
    pub fn published() -> Self {
        Self { anchor: None, beta: 0.05, ..Self::algorithm_2() }
    }

    /// Algorithm 2 over simulations that are put back to the event.
    #[must_use]
    pub fn algorithm_2() -> Self {
        Self { update: Update::Local, iterations: 6, particles: 15, ..Self::default() }
    }

    /// About how many hypotheses are simulated for an event.
    #[must_use]
    pub const fn simulations_about(&self) -> usize {
        match self.update {
            Update::Initial => self.particles,
            Update::Global | Update::Local => self.particles * (self.iterations + 1),
            // A sweep looks at about a hundred; those it has in common with others are simulated once, but count.
            Update::Sweep => 100 * self.iterations * self.particles,
        }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            update: Update::Sweep,
            iterations: 2,
            particles: 3,
            beta: 0.5,
            eta: 0.1,
            window: 10,
            gamma: GAMMA,
            anchor: Some(10),
            minds: phase_agent::Settings { simulations: SIMULATIONS, ..phase_agent::Settings::default() },
        }
    }
}

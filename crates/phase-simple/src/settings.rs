//! The numbers of an inference.

use crate::cue::GAMMA;
use serde::{Deserialize, Serialize};

/// From what hypotheses are proposed anew.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Update {
    /// Not at all: the initial proposals stand (SIMPLE (Initial) of the ablation).
    Initial,
    /// From the whole event (SIMPLE (Global)).
    Global,
    /// From a short stretch where simulation and observation are at odds (SIMPLE (Full)).
    Local,
    /// Part by part, each from all it could be ([`crate::sweep`]). Not in the paper.
    #[default]
    Sweep,
}

/// How to infer. The defaults are the paper's wherever it gives a number.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Settings {
    /// Which proposals there are after the first.
    pub update: Update,
    /// L, iterations after the initial proposals.
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

impl Default for Settings {
    fn default() -> Self {
        Self {
            update: Update::default(),
            iterations: 6,
            particles: 15,
            beta: 0.05,
            eta: 0.1,
            window: 10,
            gamma: GAMMA,
            anchor: None,
            minds: phase_agent::Settings::default(),
        }
    }
}

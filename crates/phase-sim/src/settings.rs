//! How an event is simulated.

use serde::{Deserialize, Serialize};

/// Lengths and minds. The defaults are the paper's.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Settings {
    /// An event never lasts longer (steps of 0.25 s; the paper's 25 s).
    pub max_steps: usize,
    /// An event never ends earlier, unless `max_steps` is smaller (the paper's 10 s).
    pub min_steps: usize,
    /// An event ends once, for this many steps in a row, neither agent had anything to do and nothing moved.
    pub rest_steps: usize,
    /// How both agents think.
    pub minds: phase_agent::Settings,
}

impl Default for Settings {
    fn default() -> Self {
        Self { max_steps: 100, min_steps: 40, rest_steps: 8, minds: phase_agent::Settings::default() }
    }
}

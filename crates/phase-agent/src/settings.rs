//! Parameters of an agent's mind.

use serde::{Deserialize, Serialize};

/// Fidelity of the dynamics that an agent's search uses. Its belief is always predicted with exact steps.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Foresight {
    /// By [`Dynamics::step_approximate`](phase_model::Dynamics::step_approximate), at a fraction of the cost.
    #[default]
    Coarse,
    /// By [`Dynamics::step`](phase_model::Dynamics::step), the exact dynamics.
    Exact,
}

impl Foresight {
    /// Both levels of fidelity.
    pub const ALL: [Self; 2] = [Self::Coarse, Self::Exact];

    /// The name used in files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Coarse => "coarse",
            Self::Exact => "exact",
        }
    }
}

/// Parameters of an agent's mind. The defaults are the paper's.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct MindParameters {
    /// K, the number of belief particles; at least 1.
    pub particles: usize,
    /// λ of the subgoal value.
    pub lambda: f64,
    /// POMCP simulations per decision; at least 1.
    pub simulations: usize,
    /// Steps of the rollout policy after a leaf of the tree.
    pub rollout_steps: usize,
    /// c_init of PUCT.
    pub c_init: f64,
    /// c_base of PUCT.
    pub c_base: f64,
    /// Discount of the next step's reward relative to this one's.
    pub discount: f64,
    /// Share of rollout actions taken from the heuristic instead of uniformly sampled, 0 to 1.
    #[serde(rename = "guidance")]
    pub heuristic_share: f64,
    /// Fidelity of the search's dynamics. Absent in older files, which means `exact`.
    #[serde(default = "legacy_foresight")]
    pub foresight: Foresight,
}

const fn legacy_foresight() -> Foresight {
    Foresight::Exact
}

impl Default for MindParameters {
    fn default() -> Self {
        Self {
            particles: 50,
            lambda: phase_planner::value::LAMBDA,
            simulations: 1000,
            rollout_steps: 10,
            c_init: 1.25,
            c_base: 1000.0,
            discount: 0.95,
            heuristic_share: 0.5,
            foresight: Foresight::Coarse,
        }
    }
}

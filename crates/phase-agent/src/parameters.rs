//! The parameters of a PHASE mind.

use phase_planner::PlannerCosts;
use serde::{Deserialize, Serialize};

/// The dynamics in which an agent searches. Its belief is always predicted with exact steps.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Foresight {
    /// [`Dynamics::step_approximate`](phase_model::Dynamics::step_approximate), at a fraction of the cost.
    #[default]
    Coarse,
    /// [`Dynamics::step`](phase_model::Dynamics::step), the exact dynamics.
    Exact,
    /// Coarse steps in a world without collisions between bodies: agents and objects pass through each other, and
    /// only walls stop them. Whoever makes a mind gives it such dynamics, as `phase-minds` does.
    Points,
}

impl Foresight {
    /// Every value, the default first.
    pub const ALL: [Self; 3] = [Self::Coarse, Self::Exact, Self::Points];

    /// The name used in files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Coarse => "coarse",
            Self::Exact => "exact",
            Self::Points => "points",
        }
    }
}

/// The parameters of a PHASE mind: every number that shapes its behaviour.
///
/// Those of belief and search, up to `foresight`, are the paper's where it gives them. The others are those that
/// `cargo xtask fit-minds` fits; `docs/minds.md` has their units and says what was fitted to which events. Ranges are
/// checked where parameters enter a program, by `phase_minds::MindParameters::validate`.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PhaseParameters {
    /// K, the number of belief particles; at least 1.
    pub particles: usize,
    /// λ of the subgoal value (1/u).
    pub lambda: f64,
    /// POMCP simulations per decision; at least 1.
    pub simulations: usize,
    /// Change of the policy, as total variation, below which a search ends early
    /// ([`PomcpSettings::convergence`](phase_pomcp::PomcpSettings::convergence)), 0 to 1.
    pub convergence: f64,
    /// Steps of the rollout policy after a leaf of the tree.
    pub rollout_steps: usize,
    /// c_init of PUCT.
    pub c_init: f64,
    /// c_base of PUCT.
    pub c_base: f64,
    /// Discount of the next step's reward relative to this one's.
    pub discount: f64,
    /// Exponent of the visits in the choice of an action: 1 draws in proportion to them, a large one always takes the
    /// most visited; at least 0.
    pub decisiveness: f64,
    /// Share of rollout actions taken from the heuristic instead of uniformly sampled, 0 to 1.
    pub heuristic_share: f64,
    /// The dynamics in which the agent searches.
    pub foresight: Foresight,
    /// Prior of the heuristic's action in PUCT, relative to that of any other; above 0.
    pub heuristic_prior: f64,
    /// Prior of repeating the last action, relative to that of any other; above 0.
    pub momentum_prior: f64,
    /// Prior of pushing backward, sideways or diagonally with free hands, relative to forward; above 0.
    pub lateral_prior: f64,
    /// Prior of stopping and coasting while there is a distance to go, relative to a push; above 0.
    pub rest_prior: f64,
    /// Further steps for which the distance at the end of a rollout is charged.
    pub horizon_steps: f64,
    /// p: share of the imagined steps in which the other agent pursues its own goal instead of coasting, 0 to 1.
    pub other_initiative: f64,
    /// Cost of each unit of a path that leads through a body (dimensionless), beside its length.
    pub obstruction: f32,
    /// Cost of grasping an object, and of releasing it (u), of plans and on the way.
    pub grasp: f32,
    /// Cost of turning (u/rad): of an object and its holders about the object. An agent that faces away from where it
    /// goes is charged as much as one radian.
    pub turning: f32,
    /// Cost of what is nearly impossible (u): a door that is too narrow, a load that is too heavy.
    pub impassable: f32,
    /// What 1 u of travel for or against the other's goal costs, relative to 1 u that it spares or costs the other,
    /// 0 to 1.
    pub effort: f32,
}

impl PhaseParameters {
    /// The costs of plans.
    #[must_use]
    pub const fn planner_costs(&self) -> PlannerCosts {
        PlannerCosts { grasp: self.grasp, impassable: self.impassable, effort: self.effort }
    }
}

impl Default for PhaseParameters {
    fn default() -> Self {
        Self {
            particles: 50,
            lambda: phase_planner::value::LAMBDA,
            simulations: 1000,
            convergence: 0.1,
            rollout_steps: 10,
            c_init: 1.25,
            c_base: 1000.0,
            discount: 0.95,
            decisiveness: 4.0,
            heuristic_share: 0.5,
            foresight: Foresight::Coarse,
            heuristic_prior: 2.0,
            momentum_prior: 3.0,
            lateral_prior: 0.1,
            rest_prior: 0.2,
            horizon_steps: 8.0,
            other_initiative: 0.5,
            obstruction: 2.0,
            grasp: 1.0,
            turning: 1.0,
            impassable: 100.0,
            effort: 0.4,
        }
    }
}

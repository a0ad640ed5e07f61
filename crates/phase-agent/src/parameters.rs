//! The parameters of a PHASE mind.

use phase_model::arena;
use phase_navigation::{AssemblyParameters, NavigationParameters};
use phase_planner::PlannerParameters;
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
    /// Coarse steps in a world without collisions between bodies: agents and objects pass through each other,
    /// and only walls stop them. The caller gives a mind such dynamics, as `phase-minds` does.
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

/// The priors of the root's actions in PUCT.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Prior {
    /// Habits: the heuristic's action, momentum, walking forward.
    #[default]
    Habits,
    /// The policy network, distilled from whole searches ([`PolicyNetwork`](crate::PolicyNetwork)).
    Network,
    /// The policy network in place of a search. What it says is taken for the shares of
    /// [`simulations`](PhaseParameters::simulations) visits.
    #[serde(rename = "network-alone")]
    NetworkAlone,
}

impl Prior {
    /// Every value, the default first.
    pub const ALL: [Self; 3] = [Self::Habits, Self::Network, Self::NetworkAlone];

    /// The name used in files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Habits => "habits",
            Self::Network => "network",
            Self::NetworkAlone => "network-alone",
        }
    }

    /// Whether this is the default, which files do not name.
    #[must_use]
    pub const fn is_habits(&self) -> bool {
        matches!(self, Self::Habits)
    }
}

/// The parameters of a PHASE mind: every number that shapes its decisions.
///
/// Those of belief and search, up to `directions`, are the paper's where it gives them; `patience` and
/// `respite` are medians of recorded contests, and `cargo xtask fit-minds` fits the others.
/// `docs/explanation/minds.md` says what was fitted to which events. Ranges are checked where parameters
/// enter a program, by `phase_minds::MindParameters::validate`.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PhaseParameters {
    /// K, the number of belief particles; at least 1.
    pub particles: usize,
    /// λ of the subgoal value (1/u); at least 0.
    pub lambda: f64,
    /// POMCP simulations per decision; at least 1.
    pub simulations: usize,
    /// Change of the policy, as total variation, below which a search ends early
    /// ([`PomcpSettings::convergence`](phase_pomcp::PomcpSettings::convergence)), 0 to 1.
    pub convergence: f64,
    /// Steps of the rollout policy after a leaf of the tree.
    pub rollout_steps: usize,
    /// c_init of PUCT; at least 0.
    pub c_init: f64,
    /// c_base of PUCT; above 0.
    pub c_base: f64,
    /// Discount of the next step's reward relative to this one's, 0 to 1.
    pub discount: f64,
    /// Exponent of the visits in the choice of an action: 1 draws in proportion to them, a large one always
    /// takes the most visited; at least 0.
    pub decisiveness: f64,
    /// Share of rollout actions taken from the heuristic instead of uniformly sampled, 0 to 1.
    pub heuristic_share: f64,
    /// The dynamics in which the agent searches.
    pub foresight: Foresight,
    /// The priors of the root's actions.
    #[serde(default, skip_serializing_if = "Prior::is_habits")]
    pub prior: Prior,
    /// Directions, evenly spaced, of the pushes and of the escapes that are tried; at least 1.
    pub directions: usize,
    /// Steps for which two hold an object without moving it from its place before the one that held it first
    /// lets go.
    pub patience: u16,
    /// Steps for which an agent that has let go leaves the object to the other.
    pub respite: u16,
    /// Prior of the heuristic's action in PUCT, relative to that of any other; above 0.
    pub heuristic_prior: f64,
    /// Prior of repeating the last action, relative to that of any other; above 0.
    pub momentum_prior: f64,
    /// Prior of pushing backward, sideways or diagonally with free hands, relative to forward; above 0.
    pub lateral_prior: f64,
    /// Prior of stopping and coasting while there is a distance to go, relative to a push; above 0.
    pub rest_prior: f64,
    /// Distance to go (u) up to which stopping and coasting have the prior of a push; at least 0.
    pub rest_distance: f32,
    /// Speed (u/s) above which a body is in motion: an agent then repeats its last action out of habit, and
    /// another agent is expected to pursue its goal; at least 0.
    pub moving_speed: f32,
    /// Further steps for which the distance at the end of a rollout is charged; at least 0.
    pub horizon_steps: f64,
    /// p: share of the imagined steps in which the other agent pursues its own goal instead of coasting, 0 to
    /// 1.
    pub other_initiative: f64,
    /// Distance (u) between the believed positions of an entity up to which its position counts as known; at
    /// least 0.
    pub agreement: f32,
    /// Distance (u) between the believed positions of an unseen target up to which they are searched
    /// together; at least 0.
    pub colocation: f32,
    /// Distance (u) ahead on a way at which the next waypoint lies; above 0.
    pub look_ahead: f32,
    /// Deviation from the direction of the waypoint (rad) below which an agent pushes forward instead of
    /// turning; at least 0.
    pub heading_tolerance: f32,
    /// Distance to the waypoint (u) below which an agent stops; at least 0.
    pub arrival_distance: f32,
    /// Share of the grab reach within which an object counts as reached, 0 to 1.
    pub grasp_reach: f32,
    /// Distance (in widths of the agent) from a door that is too narrow for it at which an agent waits, so
    /// that others can come through; at least 0.
    pub waiting_widths: f32,
    /// Spacing (u) of the points of a path at which a body could be cut off, and of a push at which it could
    /// be stopped, 0.1 to 10.
    pub interception_spacing: f32,
    /// Length (u) of a push that is considered; at least 0.
    pub push_length: f32,
    /// Distance to its post (u) below which a guard next to a body turns on that body; at least 0.
    pub post_distance: f32,
    /// Clearance (u) that an agent leaves between itself and the path of another that it lets pass; at least
    /// 0.
    pub clearance: f32,
    /// Length (u) of a step away from a pursuer that is tried; at least 0.
    pub escape_length: f32,
    /// Cost of each unit of a path that leads through a body (dimensionless), beside its length; at least 0.
    pub obstruction: f32,
    /// Cost of grasping an object, and of releasing it (u), of plans and on the way; at least 0.
    pub grasp: f32,
    /// Cost of turning (u/rad): of an object and its holders about the object. An agent that faces away from
    /// where it goes is charged as much as one radian; at least 0.
    pub turning: f32,
    /// Cost of what is nearly impossible (u): a door that is too narrow, a load that is too heavy; at least
    /// 0.
    pub impassable: f32,
    /// Cost of 1 u of travel for or against the other's goal, relative to 1 u that it spares or costs the
    /// other, 0 to 1.
    pub effort: f32,
    /// Clearance (u) beside the other's path within which an agent without a part in the other's plan gives
    /// way; at least 0.
    pub yielding_clearance: f32,
    /// Distance (u) behind a door at which an object is expected to lie that was passed through it; at least
    /// 0.
    pub passing_depth: f32,
    /// Depth (u) inside a room at which a body counts as having entered it, 0.1 to 10.
    pub room_depth: f32,
    /// Cost of each unit of a path within the margin of a wall's end (dimensionless), beside its length; at
    /// least 0.
    pub corner: f32,
    /// Distance (u) to a bend of a path below which the bend is cut; above 0.
    pub bend_distance: f32,
    /// Overlap (u) of an object and its holders with walls that does not count as a collision on their way;
    /// at least 0.
    pub wall_overlap: f32,
    /// Rise of the cost of a way from the nearest place without a collision into one, relative to the length
    /// of that move, for an object and its holders; at least 0.
    pub edge_rise: f32,
    /// Length (u) of the way ahead over which the motion of an object and its holders is averaged; at least
    /// 0.
    pub descent_length: f32,
}

impl PhaseParameters {
    /// The parameters of plans.
    #[must_use]
    pub const fn planning(&self) -> PlannerParameters {
        PlannerParameters {
            grasp: self.grasp,
            impassable: self.impassable,
            effort: self.effort,
            yielding_clearance: self.yielding_clearance,
            passing_depth: self.passing_depth,
        }
    }

    /// The parameters of ways.
    #[must_use]
    pub const fn navigation(&self) -> NavigationParameters {
        NavigationParameters {
            impassable: self.impassable,
            obstruction: self.obstruction,
            corner: self.corner,
            bend_distance: self.bend_distance,
        }
    }

    /// The parameters of the ways of an object and its holders.
    pub(crate) const fn carrying(&self) -> AssemblyParameters {
        AssemblyParameters {
            turning: self.turning,
            // So that crossing a wall for the length of a room is as bad as a door that is too narrow.
            collision: self.impassable / (0.5 * arena::SIDE),
            overlap: self.wall_overlap,
            edge_rise: self.edge_rise,
            descent_length: self.descent_length,
        }
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
            prior: Prior::Habits,
            directions: 8,
            patience: 6,
            respite: 11,
            heuristic_prior: 2.0,
            momentum_prior: 3.0,
            lateral_prior: 0.1,
            rest_prior: 0.2,
            rest_distance: 1.0,
            moving_speed: 0.5,
            horizon_steps: 8.0,
            other_initiative: 0.5,
            agreement: 0.5,
            colocation: 3.0,
            look_ahead: 1.5,
            heading_tolerance: 0.6,
            arrival_distance: 0.2,
            grasp_reach: 0.5,
            waiting_widths: 2.0,
            interception_spacing: 1.0,
            push_length: 4.0,
            post_distance: 0.6,
            clearance: 0.8,
            escape_length: 3.0,
            obstruction: 2.0,
            grasp: 1.0,
            turning: 1.0,
            impassable: 100.0,
            effort: 0.4,
            yielding_clearance: 0.4,
            passing_depth: 1.2,
            room_depth: 1.5,
            corner: 3.0,
            bend_distance: 0.2,
            wall_overlap: 0.15,
            edge_rise: 2.0,
            descent_length: 0.75,
        }
    }
}

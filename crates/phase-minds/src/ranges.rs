//! The range of every parameter of every kind of mind.
//!
//! Bounds are those of what can be meant, and of what a machine can do. A particle is a state of 120 bytes
//! that is planned from in some 0.1 ms: 100,000 are 12 MB and ten seconds a decision. A simulation adds at
//! most a node of 0.5 kB to the tree: 1,000,000 are 500 MB. Lengths end at five times the side of the arena.

use phase_agent::PhaseParameters;
use phase_model::setting::{RangeError, Setting};
use phase_published::PublishedParameters;

/// K, belief particles.
pub const PARTICLES: Setting = Setting::whole("particles", "", 1, 100_000);
/// POMCP simulations of a search.
pub const SIMULATIONS: Setting = Setting::whole("simulations", "", 1, 1_000_000);
/// Searches of a decision.
const SEARCHES: Setting = Setting::whole("searches", "", 1, 100);
/// Steps of a rollout; the paper's events have 100 steps in all.
const ROLLOUT_STEPS: Setting = Setting::whole("rollout_steps", "steps", 0, 1000);
/// Steps that a decision may imagine in its rollouts, which bounds its time: a coarse step takes about a
/// microsecond, an exact one some more. Each of its factors may be large, not all of them at once.
const IMAGINED_STEPS: Setting =
    Setting::whole("simulations × searches × rollout_steps", "steps", 0, 100_000_000);
const LAMBDA: Setting = Setting::real("lambda", "1/u", 0.0, 1000.0);
const C_INIT: Setting = Setting::real("c_init", "", 0.0, 1e6);
const C_BASE: Setting = Setting::positive("c_base", "", 1e9);
const DISCOUNT: Setting = share("discount");

/// A share.
const fn share(name: &'static str) -> Setting {
    Setting::real(name, "", 0.0, 1.0)
}

/// A ratio of priors.
const fn ratio(name: &'static str) -> Setting {
    Setting::positive(name, "", 1000.0)
}

/// A length.
const fn length(name: &'static str) -> Setting {
    Setting::real(name, "u", 0.0, 100.0)
}

/// A length that cannot be 0.
const fn reach(name: &'static str) -> Setting {
    Setting::positive(name, "u", 100.0)
}

/// The spacing of points on a way, of which there must not be too many.
const fn spacing(name: &'static str) -> Setting {
    Setting::real(name, "u", 0.1, 10.0)
}

/// A price beside a length.
const fn price(name: &'static str, unit: &'static str) -> Setting {
    Setting::real(name, unit, 0.0, 1000.0)
}

/// A parameter and its value.
pub(crate) type Ranged = (Setting, f64);

/// Checks values against their ranges.
pub(crate) fn check(parameters: &[Ranged]) -> Result<(), RangeError> {
    parameters.iter().try_for_each(|(setting, value)| setting.check(*value))
}

/// The steps that a decision may imagine.
fn imagined(simulations: usize, searches: usize, rollout_steps: usize) -> Ranged {
    (IMAGINED_STEPS, simulations as f64 * searches as f64 * rollout_steps as f64)
}

pub(crate) fn of_phase(parameters: &PhaseParameters) -> [Ranged; 47] {
    let [grasp, impassable, effort, yielding_clearance, passing_depth] = parameters.planning().settings();
    [
        (PARTICLES, parameters.particles as f64),
        (LAMBDA, parameters.lambda),
        (SIMULATIONS, parameters.simulations as f64),
        (share("convergence"), parameters.convergence),
        (ROLLOUT_STEPS, parameters.rollout_steps as f64),
        (C_INIT, parameters.c_init),
        (C_BASE, parameters.c_base),
        (DISCOUNT, parameters.discount),
        (Setting::real("decisiveness", "", 0.0, 100.0), parameters.decisiveness),
        (share("heuristic_share"), parameters.heuristic_share),
        (Setting::whole("directions", "", 1, 360), parameters.directions as f64),
        (Setting::whole("patience", "steps", 1, 10_000), parameters.patience.into()),
        (Setting::whole("respite", "steps", 0, 10_000), parameters.respite.into()),
        (ratio("heuristic_prior"), parameters.heuristic_prior),
        (ratio("momentum_prior"), parameters.momentum_prior),
        (ratio("lateral_prior"), parameters.lateral_prior),
        (ratio("rest_prior"), parameters.rest_prior),
        (length("rest_distance"), parameters.rest_distance.into()),
        (Setting::real("moving_speed", "u/s", 0.0, 1000.0), parameters.moving_speed.into()),
        (Setting::real("horizon_steps", "steps", 0.0, 10_000.0), parameters.horizon_steps),
        (share("other_initiative"), parameters.other_initiative),
        (length("agreement"), parameters.agreement.into()),
        (length("colocation"), parameters.colocation.into()),
        (reach("look_ahead"), parameters.look_ahead.into()),
        (Setting::real("heading_tolerance", "rad", 0.0, 10.0), parameters.heading_tolerance.into()),
        (length("arrival_distance"), parameters.arrival_distance.into()),
        (share("grasp_reach"), parameters.grasp_reach.into()),
        (Setting::real("waiting_widths", "widths", 0.0, 100.0), parameters.waiting_widths.into()),
        (spacing("interception_spacing"), parameters.interception_spacing.into()),
        (length("push_length"), parameters.push_length.into()),
        (length("post_distance"), parameters.post_distance.into()),
        (length("clearance"), parameters.clearance.into()),
        (length("escape_length"), parameters.escape_length.into()),
        (price("obstruction", ""), parameters.obstruction.into()),
        grasp,
        (price("turning", "u/rad"), parameters.turning.into()),
        impassable,
        effort,
        yielding_clearance,
        passing_depth,
        (spacing("room_depth"), parameters.room_depth.into()),
        (price("corner", ""), parameters.corner.into()),
        (reach("bend_distance"), parameters.bend_distance.into()),
        (length("wall_overlap"), parameters.wall_overlap.into()),
        (price("edge_rise", ""), parameters.edge_rise.into()),
        (length("descent_length"), parameters.descent_length.into()),
        imagined(parameters.simulations, 1, parameters.rollout_steps),
    ]
}

pub(crate) fn of_published(parameters: &PublishedParameters) -> [Ranged; 9] {
    [
        (PARTICLES, parameters.particles as f64),
        (LAMBDA, parameters.lambda),
        (SIMULATIONS, parameters.simulations as f64),
        (SEARCHES, parameters.searches as f64),
        (ROLLOUT_STEPS, parameters.rollout_steps as f64),
        (C_INIT, parameters.c_init),
        (C_BASE, parameters.c_base),
        (DISCOUNT, parameters.discount),
        imagined(parameters.simulations, parameters.searches, parameters.rollout_steps),
    ]
}

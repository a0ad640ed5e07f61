//! The range of every parameter of every kind of mind.

use phase_agent::PhaseParameters;
use phase_published::PublishedParameters;
use thiserror::Error;

/// A parameter of a mind that is out of its range.
#[derive(Clone, Copy, PartialEq, Debug, Error)]
#[error("field `{name}` must be {range}, not {value}")]
pub struct RangeError {
    /// The parameter's name.
    pub name: &'static str,
    /// The range in words.
    pub range: &'static str,
    /// The rejected value.
    pub value: f64,
}

/// The values that a parameter may have.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Range {
    /// A number of things, of which there has to be one.
    AtLeastOne,
    /// A share.
    Share,
    /// A ratio or a scale.
    Positive,
    /// An amount.
    NotNegative,
    /// The spacing of points on a way, of which there must not be too many (u).
    Spacing,
}

impl Range {
    const fn in_words(self) -> &'static str {
        match self {
            Self::AtLeastOne => "at least 1",
            Self::Share => "from 0 to 1",
            Self::Positive => "finite and above 0",
            Self::NotNegative => "finite and at least 0",
            Self::Spacing => "from 0.1 to 10",
        }
    }

    fn contains(self, value: f64) -> bool {
        match self {
            Self::AtLeastOne => value >= 1.0,
            Self::Share => (0.0..=1.0).contains(&value),
            Self::Positive => value.is_finite() && value > 0.0,
            Self::NotNegative => value.is_finite() && value >= 0.0,
            // A parameter of 32 bits is read as 64.
            Self::Spacing => (f64::from(0.1_f32)..=10.0).contains(&value),
        }
    }
}

/// A parameter: its name in files, its value, and its range.
type Ranged = (&'static str, f64, Range);

/// Checks values against their ranges.
pub(crate) fn check(parameters: &[Ranged]) -> Result<(), RangeError> {
    for &(name, value, range) in parameters {
        if !range.contains(value) {
            return Err(RangeError { name, range: range.in_words(), value });
        }
    }
    Ok(())
}

pub(crate) fn of_phase(parameters: &PhaseParameters) -> [Ranged; 44] {
    use Range::{AtLeastOne, NotNegative, Positive, Share, Spacing};
    [
        ("particles", parameters.particles as f64, AtLeastOne),
        ("lambda", parameters.lambda, NotNegative),
        ("simulations", parameters.simulations as f64, AtLeastOne),
        ("convergence", parameters.convergence, Share),
        ("rollout_steps", parameters.rollout_steps as f64, NotNegative),
        ("c_init", parameters.c_init, NotNegative),
        ("c_base", parameters.c_base, Positive),
        ("discount", parameters.discount, Share),
        ("decisiveness", parameters.decisiveness, NotNegative),
        ("heuristic_share", parameters.heuristic_share, Share),
        ("directions", parameters.directions as f64, AtLeastOne),
        ("heuristic_prior", parameters.heuristic_prior, Positive),
        ("momentum_prior", parameters.momentum_prior, Positive),
        ("lateral_prior", parameters.lateral_prior, Positive),
        ("rest_prior", parameters.rest_prior, Positive),
        ("rest_distance", parameters.rest_distance.into(), NotNegative),
        ("moving_speed", parameters.moving_speed.into(), NotNegative),
        ("horizon_steps", parameters.horizon_steps, NotNegative),
        ("other_initiative", parameters.other_initiative, Share),
        ("agreement", parameters.agreement.into(), NotNegative),
        ("colocation", parameters.colocation.into(), NotNegative),
        ("look_ahead", parameters.look_ahead.into(), Positive),
        ("heading_tolerance", parameters.heading_tolerance.into(), NotNegative),
        ("arrival_distance", parameters.arrival_distance.into(), NotNegative),
        ("grasp_reach", parameters.grasp_reach.into(), Share),
        ("waiting_widths", parameters.waiting_widths.into(), NotNegative),
        ("interception_spacing", parameters.interception_spacing.into(), Spacing),
        ("push_length", parameters.push_length.into(), NotNegative),
        ("post_distance", parameters.post_distance.into(), NotNegative),
        ("clearance", parameters.clearance.into(), NotNegative),
        ("escape_length", parameters.escape_length.into(), NotNegative),
        ("obstruction", parameters.obstruction.into(), NotNegative),
        ("grasp", parameters.grasp.into(), NotNegative),
        ("turning", parameters.turning.into(), NotNegative),
        ("impassable", parameters.impassable.into(), NotNegative),
        ("effort", parameters.effort.into(), Share),
        ("yielding_clearance", parameters.yielding_clearance.into(), NotNegative),
        ("passing_depth", parameters.passing_depth.into(), NotNegative),
        ("room_depth", parameters.room_depth.into(), Spacing),
        ("corner", parameters.corner.into(), NotNegative),
        ("bend_distance", parameters.bend_distance.into(), Positive),
        ("wall_overlap", parameters.wall_overlap.into(), NotNegative),
        ("edge_rise", parameters.edge_rise.into(), NotNegative),
        ("descent_length", parameters.descent_length.into(), NotNegative),
    ]
}

pub(crate) fn of_published(parameters: &PublishedParameters) -> [Ranged; 8] {
    use Range::{AtLeastOne, NotNegative, Positive, Share};
    [
        ("particles", parameters.particles as f64, AtLeastOne),
        ("lambda", parameters.lambda, NotNegative),
        ("simulations", parameters.simulations as f64, AtLeastOne),
        ("searches", parameters.searches as f64, AtLeastOne),
        ("rollout_steps", parameters.rollout_steps as f64, NotNegative),
        ("c_init", parameters.c_init, NotNegative),
        ("c_base", parameters.c_base, Positive),
        ("discount", parameters.discount, Share),
    ]
}

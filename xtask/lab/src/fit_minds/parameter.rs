//! The parameters that are fitted: where they are, what values they may have, and which are tried.

use phase_minds::PhaseParameters;

/// A parameter of the minds that is fitted.
pub(super) struct Parameter {
    /// The name of its field.
    pub(super) name: &'static str,
    /// The value with which it has no effect, for the ablation.
    pub(super) neutral: f64,
    domain: Domain,
    get: fn(&PhaseParameters) -> f64,
    set: fn(&mut PhaseParameters, f64),
}

/// The values that a parameter may have, and how it is changed.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Domain {
    /// A ratio, from `1 / RATIO_LIMIT` to `RATIO_LIMIT`: it is multiplied.
    Ratio,
    /// A length or another scale, from `low` to `high`, both above 0: it is multiplied.
    Between { low: f64, high: f64 },
    /// A share, from 0 to 1: something is added.
    Share,
    /// An amount, from 0 to `limit`: it is multiplied. Below a quarter of `unit` it becomes 0; from 0 it
    /// becomes `unit`.
    Amount { unit: f64, limit: f64 },
}

/// The size of the changes that are tried.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Step {
    /// By a factor of 2, or by 0.25.
    Coarse,
    /// By a factor of √2, or by 0.1.
    Fine,
}

/// The greatest ratio.
const RATIO_LIMIT: f64 = 1000.0;
/// Significant digits of every value that is tried; more would not be meant.
const DIGITS: i32 = 3;

/// All fitted parameters, in the order in which they are changed.
pub(super) const PARAMETERS: [Parameter; 33] = [
    Parameter {
        name: "heuristic_prior",
        neutral: 1.0,
        domain: Domain::Ratio,
        get: |it| it.heuristic_prior,
        set: |it, value| it.heuristic_prior = value,
    },
    Parameter {
        name: "momentum_prior",
        neutral: 1.0,
        domain: Domain::Ratio,
        get: |it| it.momentum_prior,
        set: |it, value| it.momentum_prior = value,
    },
    Parameter {
        name: "lateral_prior",
        neutral: 1.0,
        domain: Domain::Ratio,
        get: |it| it.lateral_prior,
        set: |it, value| it.lateral_prior = value,
    },
    Parameter {
        name: "rest_prior",
        neutral: 1.0,
        domain: Domain::Ratio,
        get: |it| it.rest_prior,
        set: |it, value| it.rest_prior = value,
    },
    Parameter {
        name: "rest_distance",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.5, limit: 30.0 },
        get: |it| it.rest_distance.into(),
        set: |it, value| it.rest_distance = value as f32,
    },
    Parameter {
        name: "moving_speed",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.5, limit: 20.0 },
        get: |it| it.moving_speed.into(),
        set: |it, value| it.moving_speed = value as f32,
    },
    Parameter {
        name: "horizon_steps",
        neutral: 0.0,
        domain: Domain::Amount { unit: 2.0, limit: 100.0 },
        get: |it| it.horizon_steps,
        set: |it, value| it.horizon_steps = value,
    },
    Parameter {
        name: "other_initiative",
        neutral: 0.0,
        domain: Domain::Share,
        get: |it| it.other_initiative,
        set: |it, value| it.other_initiative = value,
    },
    Parameter {
        name: "agreement",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.5, limit: 30.0 },
        get: |it| it.agreement.into(),
        set: |it, value| it.agreement = value as f32,
    },
    Parameter {
        name: "colocation",
        neutral: 30.0,
        domain: Domain::Amount { unit: 0.5, limit: 30.0 },
        get: |it| it.colocation.into(),
        set: |it, value| it.colocation = value as f32,
    },
    Parameter {
        name: "look_ahead",
        neutral: 0.1,
        domain: Domain::Between { low: 0.1, high: 10.0 },
        get: |it| it.look_ahead.into(),
        set: |it, value| it.look_ahead = value as f32,
    },
    Parameter {
        name: "heading_tolerance",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.1, limit: 3.0 },
        get: |it| it.heading_tolerance.into(),
        set: |it, value| it.heading_tolerance = value as f32,
    },
    Parameter {
        name: "arrival_distance",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.1, limit: 10.0 },
        get: |it| it.arrival_distance.into(),
        set: |it, value| it.arrival_distance = value as f32,
    },
    Parameter {
        name: "grasp_reach",
        neutral: 0.0,
        domain: Domain::Share,
        get: |it| it.grasp_reach.into(),
        set: |it, value| it.grasp_reach = value as f32,
    },
    Parameter {
        name: "waiting_widths",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.5, limit: 10.0 },
        get: |it| it.waiting_widths.into(),
        set: |it, value| it.waiting_widths = value as f32,
    },
    Parameter {
        name: "interception_spacing",
        neutral: 10.0,
        domain: Domain::Between { low: 0.1, high: 10.0 },
        get: |it| it.interception_spacing.into(),
        set: |it, value| it.interception_spacing = value as f32,
    },
    Parameter {
        name: "push_length",
        neutral: 0.0,
        domain: Domain::Amount { unit: 1.0, limit: 30.0 },
        get: |it| it.push_length.into(),
        set: |it, value| it.push_length = value as f32,
    },
    Parameter {
        name: "post_distance",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.2, limit: 10.0 },
        get: |it| it.post_distance.into(),
        set: |it, value| it.post_distance = value as f32,
    },
    Parameter {
        name: "clearance",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.2, limit: 10.0 },
        get: |it| it.clearance.into(),
        set: |it, value| it.clearance = value as f32,
    },
    Parameter {
        name: "escape_length",
        neutral: 0.0,
        domain: Domain::Amount { unit: 1.0, limit: 30.0 },
        get: |it| it.escape_length.into(),
        set: |it, value| it.escape_length = value as f32,
    },
    Parameter {
        name: "obstruction",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.5, limit: 100.0 },
        get: |it| it.obstruction.into(),
        set: |it, value| it.obstruction = value as f32,
    },
    Parameter {
        name: "grasp",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.5, limit: 100.0 },
        get: |it| it.grasp.into(),
        set: |it, value| it.grasp = value as f32,
    },
    Parameter {
        name: "turning",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.5, limit: 100.0 },
        get: |it| it.turning.into(),
        set: |it, value| it.turning = value as f32,
    },
    Parameter {
        name: "impassable",
        neutral: 10.0,
        domain: Domain::Amount { unit: 10.0, limit: 10_000.0 },
        get: |it| it.impassable.into(),
        set: |it, value| it.impassable = value as f32,
    },
    Parameter {
        name: "effort",
        neutral: 0.0,
        domain: Domain::Share,
        get: |it| it.effort.into(),
        set: |it, value| it.effort = value as f32,
    },
    Parameter {
        name: "yielding_clearance",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.25, limit: 30.0 },
        get: |it| it.yielding_clearance.into(),
        set: |it, value| it.yielding_clearance = value as f32,
    },
    Parameter {
        name: "passing_depth",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.5, limit: 10.0 },
        get: |it| it.passing_depth.into(),
        set: |it, value| it.passing_depth = value as f32,
    },
    Parameter {
        name: "room_depth",
        neutral: 0.1,
        domain: Domain::Between { low: 0.1, high: 10.0 },
        get: |it| it.room_depth.into(),
        set: |it, value| it.room_depth = value as f32,
    },
    Parameter {
        name: "corner",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.5, limit: 100.0 },
        get: |it| it.corner.into(),
        set: |it, value| it.corner = value as f32,
    },
    Parameter {
        name: "bend_distance",
        neutral: 0.01,
        domain: Domain::Between { low: 0.01, high: 10.0 },
        get: |it| it.bend_distance.into(),
        set: |it, value| it.bend_distance = value as f32,
    },
    Parameter {
        name: "wall_overlap",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.1, limit: 10.0 },
        get: |it| it.wall_overlap.into(),
        set: |it, value| it.wall_overlap = value as f32,
    },
    Parameter {
        name: "edge_rise",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.5, limit: 100.0 },
        get: |it| it.edge_rise.into(),
        set: |it, value| it.edge_rise = value as f32,
    },
    Parameter {
        name: "descent_length",
        neutral: 0.0,
        domain: Domain::Amount { unit: 0.25, limit: 30.0 },
        get: |it| it.descent_length.into(),
        set: |it, value| it.descent_length = value as f32,
    },
];

impl Parameter {
    /// Its value.
    pub(super) fn value(&self, of: &PhaseParameters) -> f64 {
        rounded((self.get)(of))
    }

    /// The parameters with this value of it.
    pub(super) fn with(&self, mut of: PhaseParameters, value: f64) -> PhaseParameters {
        (self.set)(&mut of, value);
        of
    }

    /// The least and the greatest value that it may have.
    pub(super) const fn range(&self) -> (f64, f64) {
        match self.domain {
            Domain::Ratio => (1.0 / RATIO_LIMIT, RATIO_LIMIT),
            Domain::Between { low, high } => (low, high),
            Domain::Share => (0.0, 1.0),
            Domain::Amount { limit, .. } => (0.0, limit),
        }
    }

    /// The values to be tried in place of one, without this one itself; the smaller ones first.
    pub(super) fn neighbours(&self, value: f64, step: Step) -> Vec<f64> {
        let (factor, summand) = match step {
            Step::Coarse => (2.0, 0.25),
            Step::Fine => (core::f64::consts::SQRT_2, 0.1),
        };
        let tried = match self.domain {
            Domain::Ratio | Domain::Between { .. } => vec![value / factor, value * factor],
            Domain::Share => vec![value - summand, value + summand],
            Domain::Amount { unit, .. } if value <= 0.0 => vec![unit],
            Domain::Amount { unit, .. } if value / factor < 0.25 * unit => vec![0.0, value * factor],
            Domain::Amount { .. } => vec![value / factor, value * factor],
        };
        let (low, high) = self.range();
        let tried = tried.into_iter().map(|it| rounded(it.clamp(low, high)));
        tried.filter(|it| *it != rounded(value)).collect()
    }
}

/// A value with [`DIGITS`] significant digits.
fn rounded(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let places = DIGITS - 1 - libm::floor(libm::log10(value.abs())) as i32;
    let scale = libm::pow(10.0, f64::from(places.abs()));
    if places >= 0 { libm::round(value * scale) / scale } else { libm::round(value / scale) * scale }
}

#[cfg(test)]
mod tests {
    use super::{PARAMETERS, Step, rounded};
    use phase_minds::PhaseParameters;
    use serde_json::Value;

    #[test]
    fn every_parameter_from_the_heuristic_prior_on_is_fitted_and_is_the_field_of_its_name() {
        let text = serde_json::to_string(&PhaseParameters::default()).expect("JSON");
        let places = PARAMETERS.each_ref().map(|it| text.find(&format!("\"{}\":", it.name)).expect(it.name));
        assert!(places.is_sorted(), "the order is that of the fields");
        let rest = &text[places[0]..];
        assert_eq!(rest.matches(':').count(), PARAMETERS.len(), "{rest}");
        for parameter in &PARAMETERS {
            let changed = parameter.with(PhaseParameters::default(), 0.375);
            let json: Value = serde_json::to_value(changed).expect("JSON");
            assert_eq!((&json[parameter.name], parameter.value(&changed)), (&0.375.into(), 0.375));
        }
    }

    #[test]
    fn defaults_neutral_values_and_all_that_is_tried_are_within_range() {
        for parameter in &PARAMETERS {
            let (low, high) = parameter.range();
            let default = parameter.value(&PhaseParameters::default());
            for value in [default, parameter.neutral, low, high] {
                assert!((low..=high).contains(&value), "{}: {value}", parameter.name);
                for step in [Step::Coarse, Step::Fine] {
                    let tried = parameter.neighbours(value, step);
                    assert!(!tried.is_empty() && !tried.contains(&value), "{}: {tried:?}", parameter.name);
                    assert!(
                        tried.iter().all(|it| (low..=high).contains(it)),
                        "{}: {tried:?}",
                        parameter.name
                    );
                }
            }
        }
    }

    #[test]
    fn an_amount_can_vanish_and_come_back() {
        let horizon = PARAMETERS.iter().find(|it| it.name == "horizon_steps").expect("it is fitted");
        assert_eq!(horizon.neighbours(8.0, Step::Coarse), [4.0, 16.0]);
        assert_eq!(horizon.neighbours(0.5, Step::Coarse), [0.0, 1.0]);
        assert_eq!(horizon.neighbours(0.0, Step::Coarse), [2.0]);
    }

    #[test]
    fn values_have_three_digits() {
        let cases = [(0.0, 0.0), (1234.5, 1230.0), (2.828_427, 2.83), (0.070_710_678, 0.0707), (1.0, 1.0)];
        for (value, expected) in cases {
            assert!((rounded(value) - expected).abs() < 1e-12, "{value}: {}", rounded(value));
        }
    }
}

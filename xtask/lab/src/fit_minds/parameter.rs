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

/// The table of all fitted parameters, each with its neutral value and its domain.
macro_rules! parameters {
    ($($name:ident, $neutral:literal, $domain:expr;)*) => {
        /// All fitted parameters, in the order in which they are changed.
        pub(super) const PARAMETERS: &[Parameter] = &[$(Parameter {
            name: stringify!($name),
            neutral: $neutral,
            domain: $domain,
            get: |it| it.$name.into(),
            set: |it, value| it.$name = value as _,
        }),*];
    };
}

parameters! {
    heuristic_prior, 1.0, Domain::Ratio;
    momentum_prior, 1.0, Domain::Ratio;
    lateral_prior, 1.0, Domain::Ratio;
    rest_prior, 1.0, Domain::Ratio;
    rest_distance, 0.0, Domain::Amount { unit: 0.5, limit: 30.0 };
    moving_speed, 0.0, Domain::Amount { unit: 0.5, limit: 20.0 };
    horizon_steps, 0.0, Domain::Amount { unit: 2.0, limit: 100.0 };
    other_initiative, 0.0, Domain::Share;
    agreement, 0.0, Domain::Amount { unit: 0.5, limit: 30.0 };
    colocation, 30.0, Domain::Amount { unit: 0.5, limit: 30.0 };
    look_ahead, 0.1, Domain::Between { low: 0.1, high: 10.0 };
    heading_tolerance, 0.0, Domain::Amount { unit: 0.1, limit: 3.0 };
    arrival_distance, 0.0, Domain::Amount { unit: 0.1, limit: 10.0 };
    grasp_reach, 0.0, Domain::Share;
    waiting_widths, 0.0, Domain::Amount { unit: 0.5, limit: 10.0 };
    interception_spacing, 10.0, Domain::Between { low: 0.1, high: 10.0 };
    push_length, 0.0, Domain::Amount { unit: 1.0, limit: 30.0 };
    post_distance, 0.0, Domain::Amount { unit: 0.2, limit: 10.0 };
    clearance, 0.0, Domain::Amount { unit: 0.2, limit: 10.0 };
    escape_length, 0.0, Domain::Amount { unit: 1.0, limit: 30.0 };
    obstruction, 0.0, Domain::Amount { unit: 0.5, limit: 100.0 };
    grasp, 0.0, Domain::Amount { unit: 0.5, limit: 100.0 };
    turning, 0.0, Domain::Amount { unit: 0.5, limit: 100.0 };
    impassable, 10.0, Domain::Amount { unit: 10.0, limit: 10_000.0 };
    effort, 0.0, Domain::Share;
    yielding_clearance, 0.0, Domain::Amount { unit: 0.25, limit: 30.0 };
    passing_depth, 0.0, Domain::Amount { unit: 0.5, limit: 10.0 };
    room_depth, 0.1, Domain::Between { low: 0.1, high: 10.0 };
    corner, 0.0, Domain::Amount { unit: 0.5, limit: 100.0 };
    bend_distance, 0.01, Domain::Between { low: 0.01, high: 10.0 };
    wall_overlap, 0.0, Domain::Amount { unit: 0.1, limit: 10.0 };
    edge_rise, 0.0, Domain::Amount { unit: 0.5, limit: 100.0 };
    descent_length, 0.0, Domain::Amount { unit: 0.25, limit: 30.0 };
}

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
        let places = PARAMETERS
            .iter()
            .map(|it| text.find(&format!("\"{}\":", it.name)).expect(it.name))
            .collect::<Vec<_>>();
        assert!(places.is_sorted(), "the order is that of the fields");
        let rest = &text[places[0]..];
        assert_eq!(rest.matches(':').count(), PARAMETERS.len(), "{rest}");
        for parameter in PARAMETERS {
            let changed = parameter.with(PhaseParameters::default(), 0.375);
            let json: Value = serde_json::to_value(changed).expect("JSON");
            assert_eq!((&json[parameter.name], parameter.value(&changed)), (&0.375.into(), 0.375));
        }
    }

    #[test]
    fn defaults_neutral_values_and_all_that_is_tried_are_within_range() {
        for parameter in PARAMETERS {
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

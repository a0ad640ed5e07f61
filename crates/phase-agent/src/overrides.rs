//! Parameters of minds that somebody gives: some of them, of which the others have their defaults.

use crate::MindParameters;
use serde_json::Value;
use thiserror::Error;

/// Why parameters of minds cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ParametersError {
    /// They are no JSON object.
    #[error("parameters of minds must be an object")]
    NoObject,
    /// A member is no parameter.
    #[error("field `{0}` is no parameter of the minds")]
    Unknown(String),
    /// A parameter has the wrong type.
    #[error("field `{name}` is wrong: {source}")]
    Type {
        /// Its name.
        name: String,
        /// What is wrong.
        source: serde_json::Error,
    },
    /// A parameter is out of its range.
    #[error("field `{name}` must be {range}, not {value}")]
    Range {
        /// Its name in files.
        name: &'static str,
        /// The range, in words.
        range: &'static str,
        /// The rejected value.
        value: f64,
    },
}

impl MindParameters {
    /// The default parameters with those of a JSON object in their place, by their names in files.
    ///
    /// # Errors
    /// If it is no object, or holds something that is no parameter, or one of a wrong type or out of its range.
    pub fn from_overrides(given: Value) -> Result<Self, ParametersError> {
        let Value::Object(given) = given else { return Err(ParametersError::NoObject) };
        let typed = |name: &str, source| ParametersError::Type { name: name.to_owned(), source };
        let mut parameters = Self::default();
        for (name, value) in given {
            let mut all = serde_json::to_value(parameters).map_err(|source| typed(&name, source))?;
            let Some(place) = all.get_mut(&name) else { return Err(ParametersError::Unknown(name)) };
            *place = value;
            parameters = serde_json::from_value(all).map_err(|source| typed(&name, source))?;
        }
        parameters.validate()?;
        Ok(parameters)
    }

    /// Checks that every parameter is in its range.
    ///
    /// # Errors
    /// [`ParametersError::Range`] for the first that is not.
    pub fn validate(&self) -> Result<(), ParametersError> {
        for (name, count) in
            [("particles", self.particles), ("simulations", self.simulations), ("searches", self.searches)]
        {
            ensure(name, count as f64, "at least 1", count >= 1)?;
        }
        for (name, share) in [
            ("convergence", self.convergence),
            ("guidance", self.heuristic_share),
            ("other_initiative", self.other_initiative),
            ("discount", self.discount),
            ("effort", self.effort.into()),
        ] {
            ensure(name, share, "from 0 to 1", (0.0..=1.0).contains(&share))?;
        }
        for (name, prior) in [
            ("heuristic_prior", self.heuristic_prior),
            ("momentum_prior", self.momentum_prior),
            ("lateral_prior", self.lateral_prior),
            ("rest_prior", self.rest_prior),
            ("c_base", self.c_base),
        ] {
            ensure(name, prior, "finite and above 0", prior.is_finite() && prior > 0.0)?;
        }
        for (name, amount) in [
            ("lambda", self.lambda),
            ("c_init", self.c_init),
            ("decisiveness", self.decisiveness),
            ("horizon_steps", self.horizon_steps),
            ("obstruction", self.obstruction.into()),
            ("grasp", self.grasp.into()),
            ("turning", self.turning.into()),
            ("impassable", self.impassable.into()),
        ] {
            ensure(name, amount, "finite and at least 0", amount.is_finite() && amount >= 0.0)?;
        }
        Ok(())
    }
}

const fn ensure(
    name: &'static str,
    value: f64,
    range: &'static str,
    holds: bool,
) -> Result<(), ParametersError> {
    if holds { Ok(()) } else { Err(ParametersError::Range { name, range, value }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn refused(given: Value) -> String {
        MindParameters::from_overrides(given).unwrap_err().to_string()
    }

    #[test]
    fn absent_parameters_have_their_defaults() {
        let given = MindParameters::from_overrides(json!({"simulations": 7, "guidance": 0.25})).unwrap();
        let expected = MindParameters { simulations: 7, heuristic_share: 0.25, ..MindParameters::default() };
        assert_eq!(given, expected);
        assert_eq!(MindParameters::from_overrides(json!({})).unwrap(), MindParameters::default());
    }

    #[test]
    fn whatever_is_wrong_is_named() {
        assert_eq!(refused(json!(3)), "parameters of minds must be an object");
        assert_eq!(refused(json!({"patience": 3})), "field `patience` is no parameter of the minds");
        assert!(
            refused(json!({"simulations": "many"})).starts_with("field `simulations` is wrong: invalid type")
        );
        assert_eq!(refused(json!({"particles": 0})), "field `particles` must be at least 1, not 0");
        assert_eq!(
            refused(json!({"decisiveness": -1})),
            "field `decisiveness` must be finite and at least 0, not -1"
        );
        assert_eq!(refused(json!({"effort": 2})), "field `effort` must be from 0 to 1, not 2");
        assert_eq!(refused(json!({"rest_prior": 0})), "field `rest_prior` must be finite and above 0, not 0");
    }

    #[test]
    fn the_defaults_are_in_their_ranges() {
        MindParameters::default().validate().unwrap();
    }
}

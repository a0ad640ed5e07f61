//! Means over events.

use super::{case::Explanation, evaluations::Evaluations};
use crate::error::LabError;
use phase_minds::PhaseParameters;
use phase_statistics::{mean, standard_error};
use serde::Serialize;

/// Means of the figures of some events.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub(super) struct Means {
    /// Number of events.
    pub(super) events: usize,
    /// ln of the posterior probability of the truth (nat).
    pub(super) log_posterior: f64,
    /// Log likelihood of what was done in a step (nat).
    pub(super) log_likelihood: f64,
    /// Chance of what was done in a step.
    pub(super) chance: f64,
    /// CPU time of a decision (s).
    pub(super) cpu_seconds: f64,
}

/// A mean difference between paired figures of the same events.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub(super) struct Difference {
    /// The mean.
    pub(super) mean: f64,
    /// Its standard error; 0 for a single event.
    pub(super) standard_error: f64,
}

impl Means {
    /// The means of parameters on some events.
    ///
    /// # Errors
    /// As [`Evaluations::of`].
    pub(super) fn of(
        parameters: PhaseParameters,
        events: &[usize],
        evaluations: &mut Evaluations<'_>,
        activity: &str,
    ) -> Result<Self, LabError> {
        let wanted: Vec<_> = events.iter().map(|&event| (parameters, event)).collect();
        Ok(Self::over(&evaluations.of(&wanted, activity)?))
    }

    /// The means of some figures; zero without any.
    pub(super) fn over(figures: &[Explanation]) -> Self {
        let of =
            |get: fn(&Explanation) -> f64| mean(&figures.iter().map(get).collect::<Vec<_>>()).unwrap_or(0.0);
        Self {
            events: figures.len(),
            log_posterior: of(|it| it.log_posterior),
            log_likelihood: of(|it| it.log_likelihood),
            chance: of(|it| it.chance),
            cpu_seconds: of(|it| it.cpu_seconds),
        }
    }
}

impl Difference {
    /// By how much a figure is greater in `after` than in `before`, which are about the same events.
    pub(super) fn of(before: &[Explanation], after: &[Explanation], get: fn(&Explanation) -> f64) -> Self {
        let each: Vec<f64> =
            before.iter().zip(after).map(|(before, after)| get(after) - get(before)).collect();
        Self { mean: mean(&each).unwrap_or(0.0), standard_error: standard_error(&each).unwrap_or(0.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::{Difference, Means};
    use crate::fit_minds::case::Explanation;

    fn figures(log_posterior: f64) -> Explanation {
        Explanation { log_posterior, log_likelihood: -1.0, chance: 0.5, cpu_seconds: 0.001 }
    }

    #[test]
    fn differences_are_paired() {
        let before = [figures(-3.0), figures(-1.0), figures(-2.0)];
        let after = [figures(-2.0), figures(-1.0), figures(0.0)];
        let difference = Difference::of(&before, &after, |it| it.log_posterior);
        // Differences of 1, 0 and 2: their variance is 1.
        assert!((difference.mean - 1.0).abs() < 1e-12);
        assert!((difference.standard_error - 1.0 / 3.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!((Means::over(&before).log_posterior, Means::over(&before).events), (-2.0, 3));
        assert_eq!(Means::over(&[]).events, 0);
    }
}

//! SIMPLE's answers for all combinations of weights.

use super::subject::Subject;
use crate::check_minds::recognition::Recognition;
use phase_model::EventKind;
use phase_simple::InversePlanningSettings;

/// Values of κ.
const INVERSE_TEMPERATURES: [f64; 10] = [0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1.0];
/// Values of β (1/u).
const BETAS: [f64; 10] = [0.0, 0.005, 0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2];
/// Values of ε.
const LAPSE_RATES: [f64; 10] = [0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7];

/// How SIMPLE weighs its evidence.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Weights {
    /// κ.
    pub(super) inverse_temperature: f64,
    /// β (1/u).
    pub(super) beta: f64,
    /// ε.
    pub(super) lapse_rate: f64,
}

impl Weights {
    /// Those of [`InversePlanningSettings`].
    pub(super) fn present() -> Self {
        let InversePlanningSettings { inverse_temperature, beta, lapse_rate, .. } =
            InversePlanningSettings::default();
        Self { inverse_temperature, beta, lapse_rate }
    }

    /// Every combination on the grid, and the present one.
    fn all() -> Vec<Self> {
        let mut all = vec![Self::present()];
        for lapse_rate in LAPSE_RATES {
            for inverse_temperature in INVERSE_TEMPERATURES {
                all.extend(BETAS.map(|beta| Self { inverse_temperature, beta, lapse_rate }));
            }
        }
        all
    }
}

/// The answers to all events for all weights.
pub(super) struct Grid {
    weights: Vec<Weights>,
    events: Vec<(String, EventKind)>,
    /// By event and weights.
    answers: Vec<Vec<Recognition>>,
}

impl Grid {
    pub(super) fn of(subjects: &[Subject]) -> Self {
        let weights = Weights::all();
        let answers = subjects.iter().map(|subject| {
            let mut terms = (f64::NAN, [Vec::new(), Vec::new()]);
            weights
                .iter()
                .map(|weights| {
                    if terms.0 != weights.lapse_rate {
                        terms = (weights.lapse_rate, subject.at_lapse_rate(weights.lapse_rate));
                    }
                    subject.recognise(&terms.1, weights.inverse_temperature, weights.beta)
                })
                .collect()
        });
        let answers = answers.collect();
        let events = subjects.iter().map(|subject| (subject.id.clone(), subject.kind)).collect();
        Self { weights, events, answers }
    }

    /// Id and kind of each event.
    pub(super) fn events(&self) -> impl Iterator<Item = (&str, EventKind)> {
        self.events.iter().map(|(id, kind)| (id.as_str(), *kind))
    }

    /// The weights under which the mean log posterior of the truth of these events is greatest; the first of equals.
    pub(super) fn fit(&self, events: &[usize]) -> Weights {
        let sum =
            |k: usize| -> f64 { events.iter().map(|&event| self.answers[event][k].log_posterior).sum() };
        let mut best = (f64::NEG_INFINITY, Weights::present());
        for (k, weights) in self.weights.iter().enumerate() {
            let sum = sum(k);
            if sum > best.0 {
                best = (sum, *weights);
            }
        }
        best.1
    }

    /// The answer to an event for weights of the grid; `None` for others.
    pub(super) fn answer(&self, event: usize, weights: Weights) -> Option<&Recognition> {
        let k = self.weights.iter().position(|it| *it == weights)?;
        self.answers.get(event)?.get(k)
    }

    /// Number of events.
    pub(super) const fn len(&self) -> usize {
        self.events.len()
    }
}

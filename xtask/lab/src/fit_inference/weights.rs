//! Weights of SIMPLE's evidence.

use phase_simple::{Guidance, InferenceSettings, InversePlanningSettings};
use serde::Serialize;

/// Values of κ; 0 is the network alone.
const INVERSE_TEMPERATURES: [f64; 10] = [0.0, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.25, 0.3, 0.5];
/// Values of a; 0 is planning alone.
const EXPONENTS: [f64; 9] = [0.0, 0.15, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.0];
/// Values of ε.
const LAPSE_RATES: [f64; 10] = [0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7];
/// Values of ε of each kind where there are two.
const LAPSE_RATES_OF_TWO: [f64; 6] = [0.02, 0.05, 0.1, 0.2, 0.35, 0.5];

/// Weights of SIMPLE's evidence.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub(super) struct Weights {
    /// κ. Kinds of minds have it in common, or their likelihoods could not be compared.
    pub(super) inverse_temperature: f64,
    /// a, the exponent of the intent network's guess.
    pub(super) exponent: f64,
    /// ε of each kind of minds.
    pub(super) lapse_rates: Vec<f64>,
    /// Steps from one decision to the next; not fitted.
    pub(super) interval: usize,
    /// ε at which kinds are compared, if there are two; not fitted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) comparison_lapse_rate: Option<f64>,
}

impl Weights {
    /// Those of these settings.
    pub(super) fn of(settings: &InferenceSettings, planning: &InversePlanningSettings) -> Self {
        let InversePlanningSettings { inverse_temperature, lapse_rate, interval, .. } = *planning;
        let alternative = settings.alternative.map(|it| it.lapse_rate);
        let lapse_rates = core::iter::once(lapse_rate).chain(alternative).collect();
        let comparison_lapse_rate = settings.alternative.map(|it| it.comparison_lapse_rate);
        let exponent = Guidance::default().exponent;
        Self { inverse_temperature, exponent, lapse_rates, interval, comparison_lapse_rate }
    }

    /// Every combination on the grid, and the present one first.
    pub(super) fn all(present: &Self) -> Vec<Self> {
        let rates: Vec<Vec<f64>> = if present.lapse_rates.len() == 1 {
            LAPSE_RATES.map(|rate| vec![rate]).into()
        } else {
            let of = |first: f64| LAPSE_RATES_OF_TWO.map(|second| vec![first, second]);
            LAPSE_RATES_OF_TWO.into_iter().flat_map(of).collect()
        };
        let mut all = vec![present.clone()];
        for lapse_rates in &rates {
            for inverse_temperature in INVERSE_TEMPERATURES {
                let with = |exponent| Self {
                    inverse_temperature,
                    exponent,
                    lapse_rates: lapse_rates.clone(),
                    interval: present.interval,
                    comparison_lapse_rate: present.comparison_lapse_rate,
                };
                all.extend(EXPONENTS.map(with));
            }
        }
        all
    }

    /// Whether they use the network alone.
    pub(super) fn is_network_alone(&self) -> bool {
        self.inverse_temperature == 0.0
    }

    /// Whether they use planning alone.
    pub(super) fn is_planning_alone(&self) -> bool {
        self.exponent == 0.0
    }
}

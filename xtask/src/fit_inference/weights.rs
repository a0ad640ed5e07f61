//! How SIMPLE weighs its evidence.

use phase_simple::{Algorithm, InferenceSettings, InversePlanningSettings};
use serde::Serialize;

/// Values of κ.
const INVERSE_TEMPERATURES: [f64; 10] = [0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1.0];
/// Values of β (1/u).
const BETAS: [f64; 10] = [0.0, 0.005, 0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2];
/// Values of ε.
const LAPSE_RATES: [f64; 10] = [0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7];
/// Values of ε of each kind where there are two.
const LAPSE_RATES_OF_TWO: [f64; 6] = [0.02, 0.05, 0.1, 0.2, 0.35, 0.5];

/// How SIMPLE weighs its evidence.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub(super) struct Weights {
    /// κ. Kinds of minds have it in common, or their likelihoods could not be compared.
    pub(super) inverse_temperature: f64,
    /// β (1/u), in common for the same reason.
    pub(super) beta: f64,
    /// ε of each kind of minds.
    pub(super) lapse_rates: Vec<f64>,
}

impl Weights {
    /// Those of these settings.
    pub(super) fn of(settings: &InferenceSettings) -> Self {
        let planning = match settings.algorithm {
            Algorithm::InversePlanning(planning) => planning,
            Algorithm::Chains(_) => InversePlanningSettings::default(),
        };
        let InversePlanningSettings { inverse_temperature, beta, lapse_rate, .. } = planning;
        let alternative = settings.alternative.map(|it| it.lapse_rate);
        let lapse_rates = core::iter::once(lapse_rate).chain(alternative).collect();
        Self { inverse_temperature, beta, lapse_rates }
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
                let with = |beta| Self { inverse_temperature, beta, lapse_rates: lapse_rates.clone() };
                all.extend(BETAS.map(with));
            }
        }
        all
    }
}

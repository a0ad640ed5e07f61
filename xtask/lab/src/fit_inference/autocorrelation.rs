//! Autocorrelation of the evidence: the time over which decisions tell the same.

use super::{case::InferenceCase, weights::Weights};
use phase_statistics::mean;

/// The integrated autocorrelation time (steps) of the log likelihood ratio of every other intent and the true
/// one, over all agents, kinds of minds and events: 1 + 2 Σ ρ(k) decisions, where the sum ends before the
/// first ρ(k) below 0 (Sokal's initial positive sequence). Each ratio is taken relative to its mean over the
/// event. `None` without decisions.
pub(super) fn time(cases: &[InferenceCase], weights: &Weights) -> Option<f64> {
    let mut covariances: Vec<f64> = Vec::new();
    for ratios in cases.iter().flat_map(|case| case.log_ratios(&weights.lapse_rates)) {
        let mean = mean(&ratios).unwrap_or_default();
        let centred: Vec<f64> = ratios.iter().map(|ratio| ratio - mean).collect();
        covariances.resize(covariances.len().max(centred.len()), 0.0);
        for (lag, covariance) in covariances.iter_mut().enumerate().take(centred.len()) {
            *covariance += centred.iter().zip(&centred[lag..]).map(|(a, b)| a * b).sum::<f64>();
        }
    }
    let variance = *covariances.first().filter(|variance| **variance > 0.0)?;
    let positive =
        covariances[1..].iter().map(|covariance| covariance / variance).take_while(|rho| *rho > 0.0);
    Some((1.0 + 2.0 * positive.sum::<f64>()) * weights.interval as f64)
}

//! Probabilities and their logarithms.

/// ln Σ eˣ of logarithms of weights, without overflow: the greatest is taken out before the exponentials are
/// summed, from first to last. −∞ without values or if all are −∞.
///
/// ```
/// use phase_statistics::log_sum_exp;
///
/// let sum = log_sum_exp([1000.0, 1000.0]);
/// assert!((sum - (1000.0 + 2.0_f64.ln())).abs() < 1e-12);
/// ```
#[must_use]
pub fn log_sum_exp(logs: impl IntoIterator<Item = f64, IntoIter: Clone>) -> f64 {
    let logs = logs.into_iter();
    let greatest = logs.clone().fold(f64::NEG_INFINITY, f64::max);
    if greatest == f64::NEG_INFINITY {
        return greatest;
    }
    greatest + libm::log(logs.map(|log| libm::exp(log - greatest)).sum())
}

/// Turns logarithms of weights into logarithms of probabilities, x − ln Σ eˣ, in place. Nothing changes
/// without values or if all are −∞.
///
/// Each value is taken relative to the greatest before the logarithm of the sum is subtracted: beside
/// thousands, that logarithm would lose its digits. So the result may differ from x less [`log_sum_exp`] in
/// the last bits.
pub fn log_softmax(logs: &mut [f64]) {
    let greatest = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if greatest == f64::NEG_INFINITY {
        return;
    }
    logs.iter_mut().for_each(|log| *log -= greatest);
    let whole = libm::log(logs.iter().map(|log| libm::exp(*log)).sum());
    logs.iter_mut().for_each(|log| *log -= whole);
}

/// The probabilities eˣ / Σ eˣ of some logits, which need not be normalised; at least one has to be finite.
#[must_use]
pub fn softmax<const N: usize>(logits: [f64; N]) -> [f64; N] {
    let greatest = logits.into_iter().fold(f64::NEG_INFINITY, f64::max);
    let odds = logits.map(|logit| libm::exp(logit - greatest));
    let sum: f64 = odds.iter().sum();
    odds.map(|odds| odds / sum)
}

/// The logistic function 1 / (1 + e⁻ˣ), 0 to 1.
#[must_use]
pub fn logistic(x: f64) -> f64 {
    1.0 / (1.0 + libm::exp(-x))
}

/// The entropy −Σ p ln p of probabilities (nat), where 0 ln 0 is 0.
#[must_use]
pub fn entropy(probabilities: &[f64]) -> f64 {
    -probabilities.iter().filter(|p| **p > 0.0).map(|p| p * libm::log(*p)).sum::<f64>()
}

//! The Metropolis–Hastings rule.

/// The log likelihood that a proposal must exceed to be accepted, known before it has been simulated:
/// ln P(s | Y′) > ln u + ln P(s | Y) + ln Q(Y′ | S′) − ln Q(Y | S′) for u drawn evenly from 0 to 1.
///
/// The paper prints min{1, Q(Y′)P(s | Y′) / Q(Y)P(s | Y)}, with the proposals' ratio upside down: a chain by that rule
/// favours what is proposed often twice over. The rule of Metropolis and Hastings, which it names, divides by how
/// often a hypothesis is proposed, so that the chain comes to the posterior whatever proposes.
#[must_use]
pub fn threshold(log_u: f64, log_likelihood: f64, log_proposed: f64, log_current: f64) -> f64 {
    // What is never proposed from here on is left at once.
    if log_current == f64::NEG_INFINITY && log_proposed == f64::NEG_INFINITY {
        return log_u + log_likelihood;
    }
    log_u + log_likelihood + log_proposed - log_current
}

//! Algorithm 2 of the paper: Metropolis–Hastings chains whose proposals come from short time windows of the
//! event.

use crate::{
    ChainSettings, Hypothesis, Proposal, Update, generative::PreparedEvent, proposal::sample_index,
    simulations::Simulations, strength::StrengthCue,
};
use core::ops::{ControlFlow, RangeInclusive};
use phase_model::random::Pcg64Mcg;
use phase_pomcp::PomcpError;
use phase_statistics::log_softmax;
use rand::RngExt;

/// The log-likelihood that a proposal must exceed to be accepted, known before it has been simulated: ln P(s
/// | Y′) > ln u + ln P(s | Y) + ln Q(Y′ | S′) − ln Q(Y | S′) for u uniformly sampled from 0 to 1.
///
/// The paper prints min{1, Q(Y′)P(s | Y′) / Q(Y)P(s | Y)}, with the proposals' ratio inverted: a chain with
/// that rule favours frequently proposed hypotheses twice over. The Metropolis–Hastings rule, which the paper
/// names, divides by the proposal probability, so that the chain converges to the posterior for any proposal
/// distribution.
#[must_use]
pub fn threshold(log_u: f64, log_likelihood: f64, log_proposed: f64, log_current: f64) -> f64 {
    log_u + log_likelihood + log_proposed - log_current
}

/// The parts that all chains of an event share.
#[derive(Clone, Copy)]
pub(crate) struct Chains<'a, 's> {
    pub(crate) prepared: &'a PreparedEvent,
    pub(crate) initial: &'a Proposal,
    pub(crate) strengths: &'s dyn StrengthCue,
    pub(crate) gamma: f64,
    pub(crate) settings: &'a ChainSettings,
}

impl Chains<'_, '_> {
    /// Runs one chain: its last hypothesis with ln P(s | Y), and which iterations accepted their proposal;
    /// `None` if `tick` cancelled it.
    pub(crate) fn run(
        &self,
        simulations: &mut Simulations<'_>,
        random: &mut Pcg64Mcg,
        tick: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Option<(Hypothesis, f64, Vec<bool>)>, PomcpError> {
        let mut current = self.initial.sample(random);
        let mut likelihood = simulations.log_likelihood(&current)?;
        let iterations = if self.settings.update == Update::Initial { 0 } else { self.settings.iterations };
        let mut accepted = vec![false; iterations];
        for accepted in &mut accepted {
            if tick().is_break() {
                return Ok(None);
            }
            let local = self.sample_window(&current, simulations, random).map(|sample_window| {
                Proposal::new(self.prepared.observed(), sample_window, self.gamma, self.strengths)
            });
            let proposal = local.as_ref().unwrap_or(self.initial);
            let candidate = proposal.sample(random);
            let threshold = threshold(
                libm::log(random.random()),
                likelihood,
                proposal.log_probability(&candidate),
                proposal.log_probability(&current),
            );
            if let Some(likelihood_of_candidate) = simulations.log_likelihood_above(&candidate, threshold)? {
                (current, likelihood) = (candidate, likelihood_of_candidate);
                *accepted = true;
            }
        }
        Ok(Some((current, likelihood, accepted)))
    }

    /// The window of ΔT steps to propose from next, drawn by e^{η Σ ‖ŝ − s‖₂}; `None` for the whole event.
    fn sample_window(
        &self,
        current: &Hypothesis,
        simulations: &Simulations<'_>,
        random: &mut Pcg64Mcg,
    ) -> Option<RangeInclusive<usize>> {
        if self.settings.update != Update::Local {
            return None;
        }
        let window = self.settings.window;
        let deviations = simulations.deviations(current)?;
        let starts = deviations.len().saturating_sub(window) + 1;
        let sums = (0..starts).map(|start| deviations.iter().skip(start).take(window).sum::<f64>());
        let mut logs: Vec<f64> = sums.map(|sum| self.settings.eta * sum).collect();
        log_softmax(&mut logs);
        let start = sample_index(&logs, random);
        Some(start..=start + window)
    }
}

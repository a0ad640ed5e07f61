//! Cache of simulated hypotheses.

use crate::{
    Hypothesis,
    generative::{Deviations, PreparedEvent},
};
use phase_pomcp::PomcpError;
use std::collections::BTreeMap;

/// Simulations of one event. Each hypothesis is simulated once: repeating it would use the same random
/// numbers again.
#[derive(Debug)]
pub(crate) struct Simulations<'a> {
    prepared: &'a PreparedEvent,
    resync_interval: Option<usize>,
    beta: f64,
    simulated: BTreeMap<Hypothesis, Deviations>,
}

impl<'a> Simulations<'a> {
    /// An empty cache. `resync_interval` is that of [`PreparedEvent::simulate`], `beta` that of the
    /// likelihood (1/u).
    #[must_use]
    pub(crate) const fn new(prepared: &'a PreparedEvent, resync_interval: Option<usize>, beta: f64) -> Self {
        Self { prepared, resync_interval, beta, simulated: BTreeMap::new() }
    }

    /// ln P(s | Y) = −β Σ ‖sᵗ − ŝᵗ‖₂.
    ///
    /// # Errors
    ///
    /// Invalid parameters of the agents' search.
    pub(crate) fn log_likelihood(&mut self, hypothesis: &Hypothesis) -> Result<f64, PomcpError> {
        Ok(self.log_likelihood_above(hypothesis, f64::NEG_INFINITY)?.unwrap_or(f64::NEG_INFINITY))
    }

    /// ln P(s | Y), or `None` if it is not above a threshold. A simulation whose deviation is already too
    /// large to reach it is stopped early, which does not change the result: deviations only add up.
    ///
    /// # Errors
    ///
    /// Invalid parameters of the agents' search.
    pub(crate) fn log_likelihood_above(
        &mut self,
        hypothesis: &Hypothesis,
        threshold: f64,
    ) -> Result<Option<f64>, PomcpError> {
        let steps = self.prepared.observed().steps();
        let limit = -threshold / self.beta;
        let enough = |known: &Deviations| known.len() == steps || known.iter().sum::<f64>() > limit;
        if !self.simulated.get(hypothesis).is_some_and(enough) {
            let deviations = self.prepared.simulate(hypothesis, self.resync_interval, limit)?;
            self.simulated.insert(*hypothesis, deviations);
        }
        Ok(self.known(hypothesis).filter(|&log| log > threshold))
    }

    /// The deviations of a hypothesis by step (u), as far as it has been simulated; `None` if it has not.
    #[must_use]
    pub(crate) fn deviations(&self, hypothesis: &Hypothesis) -> Option<&Deviations> {
        self.simulated.get(hypothesis)
    }

    /// The number of hypotheses that were simulated, to the end or not.
    #[must_use]
    pub(crate) fn count(&self) -> usize {
        self.simulated.len()
    }

    fn known(&self, hypothesis: &Hypothesis) -> Option<f64> {
        let deviations = self.simulated.get(hypothesis)?;
        let complete = deviations.len() == self.prepared.observed().steps();
        complete.then(|| -self.beta * deviations.iter().sum::<f64>())
    }
}

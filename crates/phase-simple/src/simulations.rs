//! Cache of simulated hypotheses.

use crate::{
    Hypothesis,
    generative::{Deviations, Stage},
};
use phase_pomcp::PomcpError;
use std::collections::BTreeMap;

/// Simulations of one event. Each hypothesis is simulated once: its simulation would draw the same numbers again.
#[derive(Debug)]
pub struct Simulations<'a> {
    stage: &'a Stage<'a>,
    anchor: Option<usize>,
    beta: f64,
    done: BTreeMap<Hypothesis, Deviations>,
}

impl<'a> Simulations<'a> {
    /// None so far. `anchor` is that of [`Stage::simulate`], `beta` that of the likelihood (1/u).
    #[must_use]
    pub const fn new(stage: &'a Stage<'a>, anchor: Option<usize>, beta: f64) -> Self {
        Self { stage, anchor, beta, done: BTreeMap::new() }
    }

    /// ln P(s | Y) = −β Σ ‖sᵗ − ŝᵗ‖₂.
    ///
    /// # Errors Invalid parameters of the minds' search.
    pub fn log_likelihood(&mut self, hypothesis: &Hypothesis) -> Result<f64, PomcpError> {
        Ok(self.above(hypothesis, f64::NEG_INFINITY)?.unwrap_or(f64::NEG_INFINITY))
    }

    /// The same if it is above a threshold. A simulation that has come too far from the event to get above it is
    /// broken off, which changes nothing: deviations only add up.
    ///
    /// # Errors Invalid parameters of the minds' search.
    pub fn above(&mut self, hypothesis: &Hypothesis, threshold: f64) -> Result<Option<f64>, PomcpError> {
        let steps = self.stage.observed().steps();
        let limit = -threshold / self.beta;
        let enough = |known: &Deviations| known.len() == steps || known.iter().sum::<f64>() > limit;
        if !self.done.get(hypothesis).is_some_and(enough) {
            let deviations = self.stage.simulate(hypothesis, self.anchor, limit)?;
            self.done.insert(*hypothesis, deviations);
        }
        Ok(self.known(hypothesis).filter(|&log| log > threshold))
    }

    /// How far a hypothesis deviates step by step, as far as it has been simulated.
    #[must_use]
    pub fn deviations(&self, hypothesis: &Hypothesis) -> Option<&Deviations> {
        self.done.get(hypothesis)
    }

    /// How many hypotheses were simulated, to the end or not.
    #[must_use]
    pub fn count(&self) -> usize {
        self.done.len()
    }

    fn known(&self, hypothesis: &Hypothesis) -> Option<f64> {
        let deviations = self.done.get(hypothesis)?;
        let complete = deviations.len() == self.stage.observed().steps();
        complete.then(|| -self.beta * deviations.iter().sum::<f64>())
    }
}

//! Algorithm 2: from an observed event to weighted hypotheses.

use crate::{
    Hypothesis, Posterior, Proposal, Settings, Update, chain,
    generative::{Deviations, Stage},
    proposal::drawn,
    strength::StrengthCue,
};
use phase_model::{
    ObservedEvent,
    random::{self, Pcg64Mcg, Purpose},
};
use phase_pomcp::PomcpError;
use rand::RngExt;
use std::collections::BTreeMap;

/// What an inference found, and how.
#[derive(Clone, PartialEq, Debug)]
pub struct Inference {
    /// What the particles say in the end.
    pub posterior: Posterior,
    /// Each particle's last hypothesis with ln P(s | Y).
    pub particles: Vec<(Hypothesis, f64)>,
    /// How many particles accepted their proposal, for each iteration.
    pub accepted: Vec<usize>,
    /// Hypotheses that were simulated, to the end or until they could not be accepted any more.
    pub simulated: usize,
}

/// Infers what explains an event. The same seed gives the same answer.
///
/// # Errors
/// Settings of minds that cannot be searched with.
pub fn infer(
    stage: &Stage<'_>,
    strengths: &dyn StrengthCue,
    seed: u64,
    settings: &Settings,
) -> Result<Inference, PomcpError> {
    let mut simulations = Simulations { stage, settings, done: BTreeMap::new() };
    let whole = 0..=stage.observed().steps();
    let initial = Proposal::new(stage.observed(), whole, settings.gamma, strengths);
    let mut accepted = vec![0; if settings.update == Update::Initial { 0 } else { settings.iterations }];
    let mut particles = Vec::with_capacity(settings.particles);
    for particle in 0..settings.particles.max(1) {
        let mut random = random::stream(seed, Purpose::Inference, particle as u64);
        let mut current = initial.sample(&mut random);
        let mut likelihood = simulations.log_likelihood(&current)?;
        for accepted in &mut accepted {
            let local = simulations
                .stretch(&current, &mut random)
                .map(|stretch| Proposal::new(stage.observed(), stretch, settings.gamma, strengths));
            let proposal = local.as_ref().unwrap_or(&initial);
            let candidate = proposal.sample(&mut random);
            let threshold = chain::threshold(
                libm::log(random.random()),
                likelihood,
                proposal.log_probability(&candidate),
                proposal.log_probability(&current),
            );
            if let Some(better) = simulations.above(&candidate, threshold)? {
                (current, likelihood) = (candidate, better);
                *accepted += 1;
            }
        }
        particles.push((current, likelihood));
    }
    let posterior = Posterior::new(particles.iter().copied());
    Ok(Inference { posterior, particles, accepted, simulated: simulations.done.len() })
}

/// Every hypothesis is simulated once: its simulation draws the same numbers every time.
struct Simulations<'a> {
    stage: &'a Stage<'a>,
    settings: &'a Settings,
    done: BTreeMap<Hypothesis, Deviations>,
}

impl Simulations<'_> {
    /// ln P(s | Y) = −β Σ ‖sᵗ − ŝᵗ‖₂.
    fn log_likelihood(&mut self, hypothesis: &Hypothesis) -> Result<f64, PomcpError> {
        Ok(self.above(hypothesis, f64::NEG_INFINITY)?.unwrap_or(f64::NEG_INFINITY))
    }

    /// The same if it is above a threshold. A simulation that has come too far from the event to get above it is
    /// broken off, which changes nothing: deviations only add up.
    fn above(&mut self, hypothesis: &Hypothesis, threshold: f64) -> Result<Option<f64>, PomcpError> {
        let steps = self.stage.observed().steps();
        let beta = self.settings.beta;
        let limit = -threshold / beta;
        let known = self.done.get(hypothesis);
        let enough =
            |deviations: &Deviations| deviations.len() == steps || deviations.iter().sum::<f64>() > limit;
        if !known.is_some_and(enough) {
            let deviations = self.stage.simulate(hypothesis, self.settings.anchor, limit)?;
            self.done.insert(*hypothesis, deviations);
        }
        let deviations = &self.done[hypothesis];
        let log = -beta * deviations.iter().sum::<f64>();
        Ok((deviations.len() == steps && log > threshold).then_some(log))
    }

    /// The stretch of ΔT steps to propose from next, drawn by e^{η Σ ‖ŝ − s‖₂}; `None` for the whole event.
    fn stretch(
        &self,
        current: &Hypothesis,
        random: &mut Pcg64Mcg,
    ) -> Option<core::ops::RangeInclusive<usize>> {
        if self.settings.update != Update::Local {
            return None;
        }
        let (window, deviations) = (self.settings.window, self.done.get(current)?);
        let starts = deviations.len().saturating_sub(window) + 1;
        let sums = (0..starts).map(|start| deviations.iter().skip(start).take(window).sum::<f64>());
        let logs = crate::cue::normalised(sums.map(|sum| self.settings.eta * sum).collect());
        let start = drawn(&logs, random);
        Some(start..=start + window)
    }
}

/// Prepares an event and infers what explains it.
///
/// # Errors
/// As [`infer`].
pub fn explain(
    observed: &ObservedEvent,
    strengths: &dyn StrengthCue,
    seed: u64,
    settings: &Settings,
) -> Result<Inference, PomcpError> {
    infer(&Stage::new(observed, settings.minds, seed), strengths, seed, settings)
}

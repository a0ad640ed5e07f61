//! From an observed event to weighted hypotheses.

use crate::{
    Algorithm, ChainSettings, InferenceSettings, Posterior, Proposal, generative::PreparedEvent,
    inverse_planning, metropolis::Chains, simulations::Simulations, strength::StrengthCue,
};
use core::ops::ControlFlow;
use phase_event::ObservedEvent;
use phase_model::random::{self, Purpose};
use phase_pomcp::PomcpError;

/// The result of an inference.
#[derive(Clone, PartialEq, Debug)]
pub struct Inference {
    /// The posterior.
    pub posterior: Posterior,
    /// How many chains accepted their proposal, for each iteration of Algorithm 2; empty for inverse planning.
    pub accepted: Vec<usize>,
    /// Hypotheses that Algorithm 2 simulated, completely or until rejection was certain; 0 for inverse
    /// planning.
    pub simulated: usize,
}

/// Infers what explains an event. The same seed gives the same result. `tick` is called about once a
/// simulation; if it breaks, the result is `None`.
///
/// # Errors
///
/// Invalid parameters of the agents' search.
pub fn infer(
    prepared: &PreparedEvent<'_>,
    strengths: &dyn StrengthCue,
    seed: u64,
    settings: &InferenceSettings,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Inference>, PomcpError> {
    match &settings.algorithm {
        Algorithm::InversePlanning(planning) => {
            let posterior = inverse_planning::posterior(prepared, planning, settings.gamma, tick)?;
            Ok(posterior.map(|posterior| Inference { posterior, accepted: Vec::new(), simulated: 0 }))
        }
        Algorithm::Chains(chains) => run_chains(prepared, strengths, seed, settings.gamma, chains, tick),
    }
}

fn run_chains(
    prepared: &PreparedEvent<'_>,
    strengths: &dyn StrengthCue,
    seed: u64,
    gamma: f64,
    settings: &ChainSettings,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Inference>, PomcpError> {
    let mut simulations = Simulations::new(prepared, settings.resync_interval, settings.beta);
    let initial = Proposal::new(prepared.observed(), 0..=prepared.observed().steps(), gamma, strengths);
    let chains = Chains { prepared, initial: &initial, strengths, gamma, settings };
    let mut accepted = vec![0; settings.iterations];
    let mut particles = Vec::with_capacity(settings.particles);
    for particle in 0..settings.particles.max(1) {
        let mut random = random::stream(seed, Purpose::Inference, particle as u64);
        if tick().is_break() {
            return Ok(None);
        }
        let chain = chains.run(&mut simulations, &mut random, tick)?;
        let Some((hypothesis, likelihood, accepts)) = chain else { return Ok(None) };
        particles.push((hypothesis, likelihood));
        accepted.iter_mut().zip(accepts).for_each(|(count, accept)| *count += usize::from(accept));
    }
    Ok(Some(Inference { posterior: Posterior::new(particles), accepted, simulated: simulations.count() }))
}

/// Prepares an event and infers what explains it.
///
/// # Errors
/// As [`infer`].
pub fn explain(
    observed: &ObservedEvent,
    strengths: &dyn StrengthCue,
    seed: u64,
    settings: &InferenceSettings,
) -> Result<Inference, PomcpError> {
    let prepared = PreparedEvent::new(observed, settings.minds, seed);
    let inference = infer(&prepared, strengths, seed, settings, &mut || ControlFlow::Continue(()))?;
    Ok(inference.unwrap_or_else(|| unreachable!("nobody breaks it off")))
}

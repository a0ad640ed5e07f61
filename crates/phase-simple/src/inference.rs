//! From an observed event to weighted hypotheses.

use crate::{
    Posterior, Proposal, Settings, Update,
    generative::Stage,
    metropolis::Chains,
    simulations::Simulations,
    strength::StrengthCue,
    sweep::{self, Parts},
};
use core::ops::ControlFlow;
use phase_model::{
    ObservedEvent,
    random::{self, Purpose},
};
use phase_pomcp::PomcpError;

/// What an inference found, and how.
#[derive(Clone, PartialEq, Debug)]
pub struct Inference {
    /// What it comes to.
    pub posterior: Posterior,
    /// How many chains accepted their proposal, for each iteration of Algorithm 2.
    pub accepted: Vec<usize>,
    /// Hypotheses that were simulated, to the end or until they could not matter any more.
    pub simulated: usize,
}

/// Infers what explains an event. The same seed gives the same answer. `tick` is called about once a simulation;
/// when it breaks, the answer is `None`.
///
/// # Errors
/// Settings of minds that cannot be searched with.
pub fn infer(
    stage: &Stage<'_>,
    strengths: &dyn StrengthCue,
    seed: u64,
    settings: &Settings,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Inference>, PomcpError> {
    let mut simulations = Simulations::new(stage, settings.anchor, settings.beta);
    let whole = 0..=stage.observed().steps();
    let initial = Proposal::new(stage.observed(), whole, settings.gamma, strengths);
    let chains = Chains { stage, initial: &initial, strengths, settings };
    let mut accepted = vec![0; settings.iterations];
    let mut particles = Vec::with_capacity(settings.particles);
    for particle in 0..settings.particles.max(1) {
        let mut random = random::stream(seed, Purpose::Inference, particle as u64);
        if tick().is_break() {
            return Ok(None);
        }
        if settings.update == Update::Sweep {
            let mut parts = Parts::guess(&initial, &mut random);
            for _ in 0..settings.iterations {
                let swept = sweep::sweep(parts, &initial, &mut simulations, &mut random, tick)?;
                let Some(swept) = swept else { return Ok(None) };
                parts = swept;
            }
        } else {
            let chain = chains.run(&mut simulations, &mut random, tick)?;
            let Some((hypothesis, likelihood, accepts)) = chain else { return Ok(None) };
            particles.push((hypothesis, likelihood));
            accepted.iter_mut().zip(accepts).for_each(|(count, accept)| *count += usize::from(accept));
        }
    }
    let goals = initial.goals(0).len();
    let posterior = match settings.update {
        // All that was ever simulated is known, so nothing is gained by looking at the chains' last states alone.
        Update::Sweep => Posterior::new(
            simulations.complete().map(|(hypothesis, log)| (hypothesis, log + hypothesis.log_prior(goals))),
        ),
        _ => Posterior::new(particles),
    };
    Ok(Some(Inference { posterior, accepted, simulated: simulations.count() }))
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
    let stage = Stage::new(observed, settings.minds, seed);
    let inference = infer(&stage, strengths, seed, settings, &mut || ControlFlow::Continue(()))?;
    Ok(inference.unwrap_or_else(|| unreachable!("nobody breaks it off")))
}

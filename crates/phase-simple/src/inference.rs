//! From an observed event to weighted hypotheses.

use crate::{
    Algorithm, Budget, ChainSettings, Guide, InferenceSettings, InferredStrengths, Posterior, Proposal,
    StrengthSource,
    answer::{Inference, MindPosterior},
    generative::PreparedEvent,
    kinds::{GuideCourse, Planners},
    metropolis::Chains,
    simulations::Simulations,
    strength::StrengthCue,
};
use core::ops::ControlFlow;
use phase_event::ObservedEvent;
use phase_model::random::{self, Purpose};
use phase_model::setting::RangeError;
use phase_pomcp::PomcpError;
use thiserror::Error;

/// Why nothing can be inferred.
#[derive(Debug, Error)]
pub enum InferenceError {
    /// A setting is out of its range.
    #[error(transparent)]
    Settings(#[from] RangeError),
    /// The agents' search failed.
    #[error("the minds cannot be simulated")]
    Search(#[from] PomcpError),
}

/// The learnt models that an inference uses.
#[derive(Clone)]
pub struct Cues<'a> {
    /// Proposals of strengths, for Algorithm 2.
    pub strengths: &'a dyn StrengthCue,
    /// The guide of inverse planning, if it has one.
    pub guide: Option<Guide>,
}

/// Infers what explains a prepared event, by the algorithm of the settings.
///
/// One seed gives one result, on every machine. `tick` is called about once a simulation; if it breaks, the
/// result is `None`. [`Simple`](crate::Simple) calls this with the settings of a named variant and the models
/// that come with the program.
///
/// # Errors
/// [`InferenceError`].
pub fn infer(
    prepared: &PreparedEvent,
    cues: &Cues<'_>,
    seed: u64,
    settings: &InferenceSettings,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Inference>, InferenceError> {
    settings.validate()?;
    let gamma = settings.gamma;
    match &settings.algorithm {
        Algorithm::InversePlanning(planning) => {
            let mut guide = cues.guide.as_ref().map(|guide| GuideCourse::new(guide, prepared.observed()));
            let mut planners = Planners::new(prepared, planning, settings);
            Ok(planners.weigh(gamma, guide.as_mut(), &mut Budget::UNLIMITED.clone(), tick)?)
        }
        Algorithm::Chains(chains) => Ok(run_chains(prepared, cues.strengths, seed, gamma, chains, tick)?),
    }
}

fn run_chains(
    prepared: &PreparedEvent,
    strengths: &dyn StrengthCue,
    seed: u64,
    gamma: f64,
    settings: &ChainSettings,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Inference>, PomcpError> {
    let inferred = InferredStrengths(prepared.motion().strengths());
    let strengths = match settings.strengths {
        StrengthSource::Network => strengths,
        StrengthSource::InverseDynamics => &inferred,
    };
    let mut simulations = Simulations::new(prepared, settings.resync_interval, settings.beta);
    let initial = Proposal::new(prepared.observed(), 0..=prepared.observed().steps(), gamma, strengths);
    let chains = Chains { prepared, initial: &initial, strengths, gamma, settings };
    let mut accepted = vec![0; settings.iterations];
    let mut particles = Vec::with_capacity(settings.particles);
    for particle in 0..settings.particles {
        let mut random = random::stream(seed, Purpose::Inference, particle as u64);
        if tick().is_break() {
            return Ok(None);
        }
        let chain = chains.run(&mut simulations, &mut random, tick)?;
        let Some((hypothesis, likelihood, accepts)) = chain else { return Ok(None) };
        particles.push((hypothesis, likelihood));
        accepted.iter_mut().zip(accepts).for_each(|(count, accept)| *count += usize::from(accept));
    }
    let posterior = Posterior::new(particles);
    let minds =
        vec![MindPosterior { agents: *prepared.agents(), probability: 1.0, posterior: posterior.clone() }];
    let simulated = simulations.count();
    let (impression, knowledge) = (None, None);
    Ok(Some(Inference { posterior, minds, impression, knowledge, accepted, simulated, foreign: false }))
}

/// Prepares an event and infers what explains it, without a guide: [`PreparedEvent::new`] and [`infer`] in
/// one call that cannot be cancelled. The front page has an example.
///
/// # Errors
/// [`InferenceError`].
pub fn explain(
    observed: &ObservedEvent,
    strengths: &dyn StrengthCue,
    seed: u64,
    settings: &InferenceSettings,
) -> Result<Inference, InferenceError> {
    settings.validate()?;
    let prepared = PreparedEvent::new(observed, settings.agents, seed);
    let cues = Cues { strengths, guide: None };
    let inference = infer(&prepared, &cues, seed, settings, &mut || ControlFlow::Continue(()))?;
    Ok(inference.unwrap_or_else(|| unreachable!("nobody breaks it off")))
}

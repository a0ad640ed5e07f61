//! From an observed event to weighted hypotheses.

use crate::{
    Algorithm, ChainSettings, Effort, Guide, Hypothesis, InferenceSettings, InferredStrengths, Posterior,
    Proposal, StrengthSource,
    generative::PreparedEvent,
    impression::Impression,
    metropolis::Chains,
    observer::{GuideCourse, planners, weigh},
    simulations::Simulations,
    strength::StrengthCue,
};
use core::ops::ControlFlow;
use phase_event::ObservedEvent;
use phase_minds::MindParameters;
use phase_model::random::{self, Purpose};
use phase_pomcp::PomcpError;

/// The result of an inference.
#[derive(Clone, PartialEq, Debug)]
pub struct Inference {
    /// The posterior, averaged over the kinds of minds.
    pub posterior: Posterior,
    /// Each kind of minds that was considered, in the order of the settings; their probabilities sum to 1.
    pub minds: Vec<MindPosterior>,
    /// What the event looked like while it was watched; `None` for Algorithm 2, which sees it at once, and before the first decision.
    pub impression: Option<Impression>,
    /// How many chains accepted their proposal, for each iteration of Algorithm 2; empty for inverse planning.
    pub accepted: Vec<usize>,
    /// Hypotheses that Algorithm 2 simulated, completely or until rejection was certain; 0 for inverse
    /// planning.
    pub simulated: usize,
}

/// What is inferred about one kind of minds.
#[derive(Clone, PartialEq, Debug)]
pub struct MindPosterior {
    /// Their parameters.
    pub minds: MindParameters,
    /// P(kind | motion), 0 to 1.
    pub probability: f64,
    /// P(Y | motion, kind).
    pub posterior: Posterior,
}

/// What was learnt about motion, for an inference.
#[derive(Clone, Copy)]
pub struct Cues<'a> {
    /// Proposals of strengths, for Algorithm 2.
    pub strengths: &'a dyn StrengthCue,
    /// The guide of inverse planning, if it has one.
    pub guide: Option<Guide<'a>>,
}

/// Infers what explains an event. The same seed gives the same result. `tick` is called about once a
/// simulation; if it breaks, the result is `None`.
///
/// # Errors
///
/// Invalid parameters of the agents' search.
pub fn infer(
    prepared: &PreparedEvent,
    cues: &Cues<'_>,
    seed: u64,
    settings: &InferenceSettings,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Inference>, PomcpError> {
    let gamma = settings.gamma;
    match &settings.algorithm {
        Algorithm::InversePlanning(planning) => {
            let guide = cues.guide.as_ref().map(|guide| GuideCourse::new(guide, prepared.observed()));
            let mut planners = planners(prepared, planning, settings.alternative);
            weigh(&mut planners, gamma, guide.as_ref(), &mut Effort::UNLIMITED.clone(), tick)
        }
        Algorithm::Chains(chains) => run_chains(prepared, cues.strengths, seed, gamma, chains, tick),
    }
}

/// Averages over kinds of minds with an even prior, given ln P(Y) P(motion | Y, kind) of every hypothesis.
pub(crate) fn average(
    kinds: Vec<(MindParameters, Vec<(Hypothesis, f64)>)>,
    impression: Option<Impression>,
) -> Inference {
    let all = kinds.iter().flat_map(|(_, joint)| joint.iter().copied());
    let posterior = Posterior::new(all);
    let greatest =
        |joint: &[(Hypothesis, f64)]| joint.iter().map(|it| it.1).fold(f64::NEG_INFINITY, f64::max);
    let reference = kinds.iter().map(|(_, joint)| greatest(joint)).fold(f64::NEG_INFINITY, f64::max);
    let evidence = |joint: &[(Hypothesis, f64)]| -> f64 {
        joint.iter().map(|(_, log)| libm::exp(log - reference)).sum()
    };
    let total: f64 = kinds.iter().map(|(_, joint)| evidence(joint)).sum();
    let minds = kinds.into_iter().map(|(minds, joint)| {
        let probability = evidence(&joint) / total;
        MindPosterior { minds, probability, posterior: Posterior::new(joint) }
    });
    Inference { posterior, minds: minds.collect(), impression, accepted: Vec::new(), simulated: 0 }
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
    let posterior = Posterior::new(particles);
    let minds =
        vec![MindPosterior { minds: *prepared.minds(), probability: 1.0, posterior: posterior.clone() }];
    Ok(Some(Inference { posterior, minds, impression: None, accepted, simulated: simulations.count() }))
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
    let cues = Cues { strengths, guide: None };
    let inference = infer(&prepared, &cues, seed, settings, &mut || ControlFlow::Continue(()))?;
    Ok(inference.unwrap_or_else(|| unreachable!("nobody breaks it off")))
}

//! The answer of an inference: the posterior, and what is known of its parts.

use crate::{Hypothesis, Posterior, impression::Impression};
use phase_minds::MindParameters;

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

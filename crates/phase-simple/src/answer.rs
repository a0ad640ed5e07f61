//! The answer of an inference: the posterior, and what is known of its parts.

use crate::{Hypothesis, ImaginedAgents, Posterior, ReportModel, impression::Impression};
use phase_model::Judgement;
use phase_statistics::{log_softmax, log_sum_exp};

/// The result of an inference: a posterior over hypotheses, averaged over the kinds of minds.
///
/// [`infer`](crate::infer), [`explain`](crate::explain) and [`Observer`](crate::Observer) give it.
/// [`judgement`](Self::judgement) makes the answer of a method of it, and [`futures`](crate::futures) a
/// forecast.
#[derive(Clone, PartialEq, Debug)]
pub struct Inference {
    /// The posterior, averaged over the kinds of minds.
    pub posterior: Posterior,
    /// Each kind of minds that was considered, in the order of the settings; their probabilities sum to 1.
    pub minds: Vec<MindPosterior>,
    /// The impression that the event made while it was watched; `None` for Algorithm 2, which sees it at
    /// once, and before the first decision.
    pub impression: Option<Impression>,
    /// The number of chains that accepted their proposal, for each iteration of Algorithm 2; empty for
    /// inverse planning.
    pub accepted: Vec<usize>,
    /// Hypotheses that Algorithm 2 simulated, completely or until rejection was certain; 0 for inverse
    /// planning.
    pub simulated: usize,
    /// Whether the motion obeys another physics or shows other bodies, so that no minds were simulated: the
    /// posterior is a mixture of the intent network's, that of distances alone, and the prior.
    pub foreign: bool,
}

impl Inference {
    /// The answer to Task 1: goals, relation and roles, and people's predicted reports of the relation.
    /// Reports are `None` without an impression.
    #[must_use]
    pub fn judgement(&self, reports: &ReportModel) -> Judgement {
        let reported = self.impression.as_ref().map(|impression| reports.reports(impression));
        Judgement { reported, ..self.posterior.judgement() }
    }
}

/// The result of an inference for one kind of minds.
#[derive(Clone, PartialEq, Debug)]
pub struct MindPosterior {
    /// The agents with such minds.
    pub agents: ImaginedAgents,
    /// P(kind | motion), 0 to 1.
    pub probability: f64,
    /// P(Y | motion, kind).
    pub posterior: Posterior,
}

/// The evidence that one kind of minds finds in an event: ln P(Y) P(motion | Y, kind) of every hypothesis but
/// for a constant, and ln P(motion | kind).
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct KindEvidence {
    pub(crate) joint: Vec<(Hypothesis, f64)>,
    pub(crate) log_evidence: f64,
}

/// ln Σ P(Y) P(motion | Y), from the logarithms.
pub(crate) fn log_evidence(joint: &[(Hypothesis, f64)]) -> f64 {
    log_sum_exp(joint.iter().map(|(_, log)| *log))
}

/// The posterior averaged over kinds of minds with an even prior, and the probability of each kind.
pub(crate) fn mixture(kinds: &[KindEvidence]) -> (Posterior, Vec<f64>) {
    let mut shares: Vec<f64> = kinds.iter().map(|kind| kind.log_evidence).collect();
    log_softmax(&mut shares);
    let weighted = kinds.iter().zip(&shares).flat_map(|(kind, share)| {
        let shift = share - log_evidence(&kind.joint);
        kind.joint.iter().map(move |&(hypothesis, log)| (hypothesis, log + shift))
    });
    (Posterior::new(weighted), shares.iter().map(|share| libm::exp(*share)).collect())
}

/// The answer to motion that minds and physics of PHASE cannot explain.
pub(crate) fn foreign(
    agents: ImaginedAgents,
    posterior: Posterior,
    impression: Option<Impression>,
) -> Inference {
    let minds = vec![MindPosterior { agents, probability: 1.0, posterior: posterior.clone() }];
    Inference { posterior, minds, impression, accepted: Vec::new(), simulated: 0, foreign: true }
}

/// The answer of all kinds of minds together.
pub(crate) fn average(
    agents: &[ImaginedAgents],
    kinds: Vec<KindEvidence>,
    impression: Option<Impression>,
) -> Inference {
    let (posterior, probabilities) = mixture(&kinds);
    let of_kind = |((&agents, kind), probability): ((&ImaginedAgents, KindEvidence), f64)| MindPosterior {
        agents,
        probability,
        posterior: Posterior::new(kind.joint),
    };
    let minds = agents.iter().zip(kinds).zip(probabilities).map(of_kind).collect();
    Inference { posterior, minds, impression, accepted: Vec::new(), simulated: 0, foreign: false }
}

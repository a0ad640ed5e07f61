//! The answer of an inference: the posterior, and what is known of its parts.

use crate::{
    Hypothesis, ImaginedAgents, Posterior, ReportModel, impression::Impression, uninformed::UninformedBeliefs,
};
use phase_model::{AGENT_COUNT, Attitude, Goal, Intent, Judgement, Level};
use phase_statistics::{log_softmax, log_sum_exp};
use std::collections::BTreeMap;

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
    /// For each agent what it is taken to know of the other's goal if it helps or hinders; `None` where all
    /// agents are imagined to know it.
    pub knowledge: Option<[KnowledgeOfGoal; AGENT_COUNT]>,
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

/// The knowledge of the other's goal that an agent is taken to have if it helps or hinders.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct KnowledgeOfGoal {
    /// Probability that the agent helps or hinders, 0 to 1. All others are given that it does.
    pub social: f64,
    /// Probability that it knows the other's goal, 0 to 1.
    pub knows: f64,
    /// Probability of each level of reasoning at which it does not, 0 to 1. Levels 1 and 2 of a helper do not
    /// differ; both are counted as level 1.
    pub levels: [f64; Level::ALL.len()],
    /// The intents that it takes the other to have at the end, with their probabilities: the other's goal if
    /// it knows that, else what its particles suppose.
    pub believed: BTreeMap<Intent, f64>,
}

impl KnowledgeOfGoal {
    /// Adds a hypothesis in which the agent is social: its weight, the other's goal, the probabilities of
    /// levels of an agent that does not know it, and what such an agent believes.
    pub(crate) fn add(
        &mut self,
        weight: f64,
        goal: Goal,
        levels: [f64; Level::ALL.len()],
        uninformed: Option<&UninformedBeliefs>,
    ) {
        let knows = 1.0 - levels.iter().sum::<f64>();
        self.social += weight;
        self.knows += weight * knows;
        *self.believed.entry(Intent { attitude: Attitude::Neutral, goal }).or_default() += weight * knows;
        for (level, share) in Level::ALL.into_iter().zip(levels) {
            self.levels[usize::from(u8::from(level))] += weight * share;
            let intents = uninformed.filter(|_| share > 0.0).map(|beliefs| beliefs.intents(level));
            for (intent, probability) in intents.into_iter().flatten() {
                *self.believed.entry(intent).or_default() += weight * share * probability;
            }
        }
    }

    /// All but the probability that the agent is social given that it is; unchanged if it cannot be.
    pub(crate) fn conditional(mut self) -> Self {
        if self.social > 0.0 {
            let shares = self.levels.iter_mut().chain(self.believed.values_mut()).chain([&mut self.knows]);
            shares.for_each(|share| *share /= self.social);
        }
        self
    }
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

/// ln P(kind | motion) of each kind of minds, with an even prior.
fn log_probabilities(kinds: &[KindEvidence]) -> Vec<f64> {
    let mut shares: Vec<f64> = kinds.iter().map(|kind| kind.log_evidence).collect();
    log_softmax(&mut shares);
    shares
}

/// P(kind | motion) of each kind of minds, with an even prior.
pub(crate) fn probabilities(kinds: &[KindEvidence]) -> impl Iterator<Item = f64> {
    log_probabilities(kinds).into_iter().map(libm::exp)
}

/// ln P(Y, kind | motion) of every hypothesis of every kind of minds, with an even prior over kinds.
pub(crate) fn weighted(kinds: &[KindEvidence]) -> impl Iterator<Item = (Hypothesis, f64)> {
    kinds.iter().zip(log_probabilities(kinds)).flat_map(|(kind, share)| {
        let shift = share - log_evidence(&kind.joint);
        kind.joint.iter().map(move |&(hypothesis, log)| (hypothesis, log + shift))
    })
}

/// The posterior averaged over kinds of minds, and the probability of each kind.
pub(crate) fn mixture(kinds: &[KindEvidence]) -> (Posterior, Vec<f64>) {
    (Posterior::new(weighted(kinds)), probabilities(kinds).collect())
}

/// The answer to motion that minds and physics of PHASE cannot explain.
pub(crate) fn foreign(
    agents: ImaginedAgents,
    posterior: Posterior,
    impression: Option<Impression>,
) -> Inference {
    let minds = vec![MindPosterior { agents, probability: 1.0, posterior: posterior.clone() }];
    let (knowledge, accepted) = (None, Vec::new());
    Inference { posterior, minds, impression, knowledge, accepted, simulated: 0, foreign: true }
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
    let (knowledge, accepted) = (None, Vec::new());
    Inference { posterior, minds, impression, knowledge, accepted, simulated: 0, foreign: false }
}

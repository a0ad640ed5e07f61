//! One event: the evidence on every intent for each kind of minds, and SIMPLE's answer for any weights.

use super::weights::Weights;
use crate::{
    check_minds::{is_true, truth},
    recognition::Recognition,
};
use phase_event::{MethodError, ObservedEvent, ProgressCallback, Recording};
use phase_model::{AGENT_COUNT, AgentId, EventKind, Goal, Strength};
use phase_runs::error::RunError;
use phase_simple::{
    ActionLikelihoods, Budget, Hypothesis, ImaginedAgents, Intent, IntentEvidence, IntentNetwork,
    InversePlanningSettings, Posterior, PreparedEvent, Proposal, UniformStrength, choice::Chance, cue::GAMMA,
    intent::joint_logs,
};
use phase_statistics::{log_softmax, log_sum_exp};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Number of intents of an agent in an event with two objects.
pub(super) const INTENTS: usize = 42;

/// An event whose labels are known, with the evidence on all intents.
pub(super) struct InferenceCase {
    /// Its id.
    pub(super) id: String,
    /// Its kind.
    pub(super) kind: EventKind,
    evidence: EventEvidence,
    intents: [Vec<Intent>; AGENT_COUNT],
    truth: Hypothesis,
    /// Number of goals that an agent can have.
    goals: usize,
}

/// All that simulations and the intent network tell about an event.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub(super) struct EventEvidence {
    strengths: [Strength; AGENT_COUNT],
    /// ln Q of every intent of each agent.
    network: [Vec<f64>; AGENT_COUNT],
    /// By kind of minds.
    kinds: Vec<AgentEvidence>,
}

/// The evidence on all intents of each agent, in the order of [`Intent::all`]: the chance of each choice that
/// is looked at, the mind's and a uniform one's.
pub(super) type AgentEvidence = [Vec<Vec<(f64, f64)>>; AGENT_COUNT];

/// ln P(choices | intent) of every intent of each agent at some lapse rate.
pub(super) type LogChoices = [Vec<f64>; AGENT_COUNT];

/// An answer beside the truth, with the probability of the last kind of minds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Answer {
    /// Goals, relation and attitudes.
    pub(super) recognition: Recognition,
    /// P(kind | motion) of the last kind, 0 to 1; 1 if it is the only one.
    pub(super) last_kind: f64,
}

impl EventEvidence {
    /// Simulates all intents of both agents with each kind of minds; `None` if it was interrupted. An agent
    /// that is not social takes the other's likeliest goal by the cue for the other's goal.
    pub(super) fn of(
        recording: &Recording,
        kinds: &[ImaginedAgents],
        planning: &InversePlanningSettings,
        network: &Arc<IntentNetwork>,
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> Result<Option<Self>, RunError> {
        let failed = |error| RunError::Method { id: recording.id.clone(), source: error };
        let observed = recording.observed().map_err(|error| failed(MethodError::new(error)))?;
        let cue = cue(&observed);
        let assumed = AgentId::ALL.map(|agent| cue.most_likely_goal(agent));
        let mut evidence = Vec::with_capacity(kinds.len());
        let mut prepared: Option<PreparedEvent> = None;
        for imagined in kinds {
            let event = match &prepared {
                Some(other) => other.with_agents(*imagined),
                None => PreparedEvent::new(&observed, *imagined, seed),
            };
            match agents(&event, planning, assumed, tick).map_err(failed)? {
                Some(of_kind) => evidence.push(of_kind),
                None => return Ok(None),
            }
            prepared = Some(event);
        }
        let strengths = prepared.map(|event| event.motion().strengths());
        let network = network.weigh(&observed).map(|intents| intents.into_iter().map(|it| it.1).collect());
        Ok(strengths.map(|strengths| Self { strengths, network, kinds: evidence }))
    }
}

impl InferenceCase {
    /// An event with the evidence on it.
    pub(super) fn new(recording: &Recording, evidence: EventEvidence) -> Result<Self, RunError> {
        let failed = |error| RunError::Method { id: recording.id.clone(), source: MethodError::new(error) };
        let observed = recording.observed().map_err(failed)?;
        let objects = observed.object_sizes().len();
        Ok(Self {
            id: recording.id.clone(),
            kind: recording.scene.kind,
            evidence,
            intents: AgentId::ALL.map(|agent| Intent::all(agent, objects)),
            truth: truth(&recording.scene),
            goals: cue(&observed).goals(AgentId::ZERO).len(),
        })
    }

    /// Number of kinds of minds.
    pub(super) const fn kinds(&self) -> usize {
        self.evidence.kinds.len()
    }

    /// ln P(choices | intent) for one kind of minds at a lapse rate.
    pub(super) fn log_choices(&self, kind: usize, lapse_rate: f64) -> LogChoices {
        let log = |&(mind, uniform): &(f64, f64)| Chance { mind, uniform }.log(lapse_rate);
        let one = |chances: &Vec<(f64, f64)>| chances.iter().map(log).sum();
        self.evidence.kinds[kind].each_ref().map(|evidence| evidence.iter().map(one).collect())
    }

    /// For each agent, the log likelihood ratio of every other intent and the true one (nat), by decision, of
    /// each kind of minds.
    pub(super) fn log_ratios(&self, lapse_rates: &[f64]) -> Vec<Vec<f64>> {
        let mut ratios = Vec::new();
        for (kind, &rate) in self.evidence.kinds.iter().zip(lapse_rates) {
            for agent in AgentId::ALL {
                let Some(meant) = self.intents[agent].iter().position(|it| is_true(it, &self.truth, agent))
                else {
                    continue;
                };
                let log = |&(mind, uniform): &(f64, f64)| Chance { mind, uniform }.log(rate);
                let logs: Vec<Vec<f64>> =
                    kind[agent].iter().map(|chances| chances.iter().map(log).collect()).collect();
                let others = logs.iter().enumerate().filter(|(intent, _)| *intent != meant);
                let ratio = |other: &[f64]| other.iter().zip(&logs[meant]).map(|(a, b)| a - b).collect();
                ratios.extend(others.map(|(_, other)| ratio(other)));
            }
        }
        ratios
    }

    /// SIMPLE's answer beside the truth. `choices` are those of each kind of minds at its lapse rate,
    /// `compared` at the one at which kinds are compared.
    pub(super) fn answer(
        &self,
        choices: &[&LogChoices],
        compared: Option<&[LogChoices]>,
        weights: &Weights,
    ) -> Answer {
        let joint: Vec<Vec<(Hypothesis, f64)>> =
            choices.iter().map(|choices| self.joint(choices, weights)).collect();
        let evidence: Vec<f64> = match compared {
            Some(compared) => {
                compared.iter().map(|choices| log_evidence(&self.joint(choices, weights))).collect()
            }
            None => joint.iter().map(|joint| log_evidence(joint)).collect(),
        };
        let mut shares = evidence.clone();
        log_softmax(&mut shares);
        let last_kind = shares.last().map_or(0.0, |share| libm::exp(*share));
        let weighted = joint.iter().zip(&evidence).flat_map(|(joint, evidence)| {
            let shift = evidence - log_evidence(joint);
            joint.iter().map(move |&(hypothesis, log)| (hypothesis, log + shift))
        });
        Answer { recognition: Recognition::of(&Posterior::new(weighted), &self.truth), last_kind }
    }

    /// ln P(Y) P(motion | Y) of every hypothesis for one kind of minds.
    fn joint(&self, choices: &LogChoices, weights: &Weights) -> Vec<(Hypothesis, f64)> {
        let decision = weights.inverse_temperature * weights.interval as f64;
        let weighted = AgentId::ALL.map(|agent| {
            let weigh = |((intent, guess), log): ((&Intent, &f64), &f64)| {
                (*intent, decision * log + weights.exponent * guess)
            };
            let guesses = self.intents[agent].iter().zip(&self.evidence.network[agent]);
            guesses.zip(&choices[agent]).map(weigh).collect()
        });
        joint_logs(&weighted, self.evidence.strengths, self.goals)
    }
}

/// ln Σ P(Y) P(motion | Y), from the logarithms.
fn log_evidence(joint: &[(Hypothesis, f64)]) -> f64 {
    log_sum_exp(joint.iter().map(|(_, log)| *log))
}

fn cue(observed: &ObservedEvent) -> Proposal {
    Proposal::new(observed, 0..=observed.steps(), GAMMA, &UniformStrength)
}

/// The evidence on all intents for one kind of minds; `None` if it was interrupted.
fn agents(
    prepared: &PreparedEvent,
    planning: &InversePlanningSettings,
    assumed: [Goal; AGENT_COUNT],
    tick: ProgressCallback<'_>,
) -> Result<Option<AgentEvidence>, MethodError> {
    let mut likelihoods = ActionLikelihoods::new(planning);
    likelihoods.follow(prepared);
    let strengths = prepared.motion().strengths();
    let mut evidence = [Vec::new(), Vec::new()];
    let mut budget = Budget::UNLIMITED;
    for agent in AgentId::ALL {
        let others = assumed[agent.other()];
        for intent in Intent::all(agent, prepared.observed().object_sizes().len()) {
            if tick().is_break() {
                return Ok(None);
            }
            let mut one =
                IntentEvidence::new(prepared, agent, intent, others, strengths).map_err(MethodError::new)?;
            one.follow(prepared, &likelihoods, &mut budget).map_err(MethodError::new)?;
            evidence[agent].push(one.chances().map(|chance| (chance.mind, chance.uniform)).collect());
        }
    }
    Ok(Some(evidence))
}

//! One event, and how well minds with some parameters explain it.

use crate::{
    check_minds::{is_true, truth},
    recognition::Recognition,
};
use cpu_time::ThreadTime;
use phase_event::{MethodError, ObservedEvent, Recording};
use phase_files::checksum::{hexadecimal, sha256};
use phase_minds::{MindParameters, PhaseParameters};
use phase_model::{AGENT_COUNT, AgentId, Attitude, EventKind};
use phase_runs::{error::RunError, interrupt::requested};
use phase_simple::{
    Hypothesis, Intent, InversePlanningSettings, Posterior, PreparedEvent,
    choice::{self, ByChoice, Chance, log_likelihood, policy},
    intent::{WeightedIntents, joint_logs},
    physical_goals,
};
use serde::{Deserialize, Serialize};

/// Probability with which a mind lapses into a uniformly random choice: that of a calibrated model of
/// recorded choices.
pub(super) const LAPSE: f64 = 0.07;

/// Settings of the evaluation of events.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub(super) struct Method {
    /// Minds decide at one of so many observed states; at least 1.
    pub(super) thin: usize,
    /// POMCP simulations a decision; at least 1.
    pub(super) simulations: usize,
    /// The seed of all random draws.
    pub(super) seed: u64,
    /// [`LAPSE`].
    pub(super) lapse: f64,
    /// Exponent of the likelihood of a choice.
    pub(super) exponent: f64,
}

impl Method {
    /// SIMPLE's exponent κ allows for errors that are correlated over steps. One of `thin` steps stands for
    /// all of them, hence κ · `thin`; but no step counts more than once.
    pub(super) fn new(thin: usize, simulations: usize, seed: u64) -> Self {
        let exponent = (InversePlanningSettings::default().inverse_temperature * thin as f64).min(1.0);
        Self { thin, simulations, seed, lapse: LAPSE, exponent }
    }
}

/// Measures of how well minds explain one event.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub(super) struct Explanation {
    /// ln of the posterior probability of the true goals and attitudes among all hypotheses (nat).
    pub(super) log_posterior: f64,
    /// Mean log likelihood of what an agent did in a step under the truth (nat).
    pub(super) log_likelihood: f64,
    /// Mean chance of what an agent did in a step under the truth, without lapses.
    pub(super) chance: f64,
    /// CPU time of a decision (s).
    pub(super) cpu_seconds: f64,
}

/// An event whose labels are known, prepared for many evaluations.
pub(super) struct MindsCase<'a> {
    /// Its id.
    pub(super) id: &'a str,
    /// Its kind.
    pub(super) kind: EventKind,
    /// SHA-256 of the whole event in hexadecimal.
    pub(super) digest: String,
    prepared: PreparedEvent,
    likelihoods: Vec<[ByChoice; AGENT_COUNT]>,
    truth: Hypothesis,
    method: Method,
    /// The steps in which the minds decide.
    steps: Vec<usize>,
}

impl<'a> MindsCase<'a> {
    /// Prepares an event, of which `observed` is what an observer sees, for minds with so many particles.
    ///
    /// # Errors
    /// If its labels are none of the hypotheses.
    pub(super) fn new(
        recording: &'a Recording,
        observed: &'a ObservedEvent,
        method: Method,
        particles: usize,
    ) -> Result<Self, RunError> {
        let truth = truth(&recording.scene);
        let objects = observed.object_sizes().len();
        for agent in AgentId::ALL {
            let meant = Intent::all(agent, objects).iter().any(|intent| is_true(intent, &truth, agent));
            if !meant || truth.attitudes.iter().all(|attitude| *attitude != Attitude::Neutral) {
                let agent = agent.number();
                let rule = format!("event {}: no hypothesis has the goal of agent {agent}", recording.id);
                return Err(RunError::Usage(rule));
            }
        }
        let text = recording.to_json().map_err(RunError::EventWrite)?;
        let minds = PhaseParameters { particles, ..PhaseParameters::default() };
        let prepared = PreparedEvent::new(observed, MindParameters::from(minds), method.seed);
        let likelihoods = choice::action_likelihoods(&prepared, InversePlanningSettings::default().tolerance);
        let count = observed.steps();
        // From the middle of the first interval on: at the start of an event nobody has moved yet.
        let first = (method.thin / 2).min(count.saturating_sub(1));
        Ok(Self {
            id: &recording.id,
            kind: recording.scene.kind,
            digest: hexadecimal(&sha256(text.as_bytes())),
            prepared,
            likelihoods,
            truth,
            method,
            steps: (first..count).step_by(method.thin).collect(),
        })
    }

    /// Measures how well minds with these parameters explain the event; `None` if it was interrupted. The
    /// agents have their true strengths. In weighing the own goals of an agent, the other pursues its true
    /// goal.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub(super) fn evaluate(&self, parameters: PhaseParameters) -> Result<Option<Explanation>, RunError> {
        let failed = |error| RunError::Method { id: self.id.to_owned(), source: MethodError::new(error) };
        let minds = PhaseParameters { simulations: self.method.simulations, ..parameters };
        let objects = self.prepared.observed().object_sizes().len();
        let begun = ThreadTime::now();
        let mut decisions = 0;
        let mut weighted: [WeightedIntents; AGENT_COUNT] = [Vec::new(), Vec::new()];
        let mut under_truth = Vec::new();
        for agent in AgentId::ALL {
            for intent in Intent::all(agent, objects) {
                if requested() {
                    return Ok(None);
                }
                let others = self.truth.goals[agent.other()];
                let hypothesis = Hypothesis::of_intent(intent, agent, others, self.truth.strengths);
                let decided =
                    self.prepared.decide_at(&hypothesis, agent, minds.into(), &self.steps).map_err(failed)?;
                let chances = decided
                    .iter()
                    .zip(&self.steps)
                    .map(|(decided, &step)| Chance::of(&policy(decided), &self.likelihoods[step][agent]));
                let chances: Vec<Chance> = chances.collect();
                decisions += chances.len();
                let log = log_likelihood(&chances, LAPSE).unwrap_or(0.0) * chances.len() as f64;
                weighted[agent].push((intent, self.method.exponent * log));
                if is_true(&intent, &self.truth, agent) {
                    under_truth.extend(chances);
                }
            }
        }
        let cpu_seconds = begun.elapsed().as_secs_f64() / decisions.max(1) as f64;
        let goals = physical_goals(AgentId::ZERO, objects).len();
        let posterior = Posterior::new(joint_logs(&weighted, self.truth.strengths, goals));
        let chance_sum: f64 = under_truth.iter().map(|chance| chance.mind).sum();
        Ok(Some(Explanation {
            log_posterior: Recognition::of(&posterior, &self.truth).log_posterior,
            log_likelihood: log_likelihood(&under_truth, LAPSE).unwrap_or(0.0),
            chance: chance_sum / under_truth.len().max(1) as f64,
            cpu_seconds,
        }))
    }
}

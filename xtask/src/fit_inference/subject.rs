//! One event: the evidence on every intent, and SIMPLE's answer for any weights.

use crate::check_minds::{recognition::Recognition, truth};
use core::ops::ControlFlow;
use phase_agent::MindParameters;
use phase_cli::error::CliError;
use phase_eval::MethodError;
use phase_event::Recording;
use phase_model::{AGENT_COUNT, AgentId, EventKind, Strength};
use phase_simple::{
    Hypothesis, Intent, IntentEvidence, InversePlanningSettings, PreparedEvent, Proposal, UniformStrength,
    choice, cue::GAMMA, intent::joint_posterior,
};

/// Number of intents of an agent in an event with two objects.
pub(super) const INTENTS: usize = 42;

/// An event whose labels are known, with the evidence on all intents.
pub(super) struct Subject {
    /// Its id.
    pub(super) id: String,
    /// Its kind.
    pub(super) kind: EventKind,
    evidence: [Vec<IntentEvidence>; AGENT_COUNT],
    strengths: [Strength; AGENT_COUNT],
    truth: Hypothesis,
    /// Number of goals that an agent can have.
    goals: usize,
}

impl Subject {
    /// Simulates all intents of both agents; `None` if it was interrupted. An agent that is not social takes
    /// the other's likeliest goal by the cue for the other's goal.
    pub(super) fn new(
        recording: &Recording,
        minds: MindParameters,
        seed: u64,
        tick: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Option<Self>, CliError> {
        let failed = |error| CliError::Method { id: recording.id.clone(), source: error };
        let observed = recording.observed().map_err(|error| failed(MethodError::new(error)))?;
        let prepared = PreparedEvent::new(&observed, minds, seed);
        let settings = InversePlanningSettings::default();
        let likelihoods = choice::action_likelihoods(&prepared, settings.tolerance);
        let strengths = prepared.motion().strengths();
        let cue = Proposal::new(&observed, 0..=observed.steps(), GAMMA, &UniformStrength);
        let mut evidence = [Vec::new(), Vec::new()];
        for agent in AgentId::ALL {
            let others = cue.most_likely_goal(agent.other());
            for intent in Intent::all(agent, observed.object_sizes().len()) {
                if tick().is_break() {
                    return Ok(None);
                }
                let interval = settings.resync_interval;
                let one =
                    IntentEvidence::of(&prepared, &likelihoods, agent, intent, others, strengths, interval);
                evidence[agent].push(one.map_err(|error| failed(MethodError::new(error)))?);
            }
        }
        let goals = cue.goals(AgentId::ZERO).len();
        let (id, kind) = (recording.id.clone(), recording.scene.kind);
        Ok(Some(Self { id, kind, evidence, strengths, truth: truth(&recording.scene), goals }))
    }

    /// ln P(choices | intent) of every intent at a lapse rate, and its deviation.
    pub(super) fn at_lapse_rate(&self, lapse_rate: f64) -> [Vec<(f64, f64)>; AGENT_COUNT] {
        let one = |evidence: &IntentEvidence| (evidence.log_choices(lapse_rate), evidence.deviation);
        self.evidence.each_ref().map(|evidence| evidence.iter().map(one).collect())
    }

    /// SIMPLE's answer beside the truth for a weight of the choices and one of the deviations (1/u).
    pub(super) fn recognise(
        &self,
        terms: &[Vec<(f64, f64)>; AGENT_COUNT],
        inverse_temperature: f64,
        beta: f64,
    ) -> Recognition {
        let weighted = AgentId::ALL.map(|agent| {
            let weigh = |(evidence, (log, deviation)): (&IntentEvidence, &(f64, f64))| {
                (evidence.intent, inverse_temperature * log - beta * deviation)
            };
            self.evidence[agent].iter().zip(&terms[agent]).map(weigh).collect()
        });
        Recognition::of(&joint_posterior(&weighted, self.strengths, self.goals), &self.truth)
    }
}

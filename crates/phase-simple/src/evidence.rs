//! What one agent's part of the motion says about one intent, before it is weighed.

use crate::{
    Intent, InversePlanningSettings, PreparedEvent,
    choice::{self, ByChoice, Chance},
};
use phase_model::{AGENT_COUNT, AgentId, Goal, Strength};
use phase_pomcp::PomcpError;

/// The evidence on one intent of one agent: the chance of each of its choices, and how far simulations stray.
#[derive(Clone, PartialEq, Debug)]
pub struct IntentEvidence {
    /// The intent.
    pub intent: Intent,
    /// The chance of what the agent did, by step.
    pub chances: Vec<Chance>,
    /// Sum over the steps of the deviation of resynchronised simulations (u).
    pub deviation: f64,
}

impl IntentEvidence {
    /// Lets the mind of an intent decide at every observed state, and simulates it from every
    /// `resync_interval`th. `likelihoods` are those of [`choice::action_likelihoods`]; `others` is the goal
    /// that the other agent pursues if the intent does not say.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub fn of(
        prepared: &PreparedEvent<'_>,
        likelihoods: &[[ByChoice; AGENT_COUNT]],
        agent: AgentId,
        intent: Intent,
        others: Goal,
        strengths: [Strength; AGENT_COUNT],
        resync_interval: usize,
    ) -> Result<Self, PomcpError> {
        let hypothesis = intent.hypothesis(agent, others, strengths);
        let chances = choice::chances(prepared, likelihoods, &hypothesis, agent)?;
        let simulated = prepared.simulate_agent(&hypothesis, agent, resync_interval)?;
        let deviation = simulated.iter().map(|step| step.deviation).sum();
        Ok(Self { intent, chances, deviation })
    }

    /// Sum over the steps of the log likelihood of what the agent did (nat), relative to the best choice,
    /// which is the same under every intent.
    #[must_use]
    pub fn log_choices(&self, lapse_rate: f64) -> f64 {
        self.chances.iter().map(|chance| chance.log(lapse_rate)).sum()
    }

    /// ln P(motion | intent) of the agent's part of the motion, but for a constant.
    #[must_use]
    pub fn log_likelihood(&self, settings: &InversePlanningSettings) -> f64 {
        settings.inverse_temperature * self.log_choices(settings.lapse_rate) - settings.beta * self.deviation
    }
}

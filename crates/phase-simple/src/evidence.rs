//! Evidence of one agent's part of the motion on one intent, before it is weighed.

use crate::{
    Hypothesis, Intent, InversePlanningSettings, PreparedEvent,
    choice::{self, ByChoice, Chance},
    simulation_run::SimulationRun,
};
use phase_model::{AGENT_COUNT, AgentId, Goal, Strength};
use phase_pomcp::PomcpError;

/// Decisions of simulated minds that an inference may spend. One takes some milliseconds.
///
/// ```
/// use phase_simple::Budget;
///
/// // Whoever watches an event as it happens limits what a row may take.
/// let budget = Budget { decisions: Some(20) };
/// assert_ne!(budget, Budget::UNLIMITED);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Budget {
    /// Decisions of simulated minds left; `None` for as many as it takes.
    pub decisions: Option<usize>,
}

impl Budget {
    /// As many decisions as it takes.
    pub const UNLIMITED: Self = Self { decisions: None };

    /// Takes a decision, if there is one left.
    const fn take(&mut self) -> bool {
        match &mut self.decisions {
            None => true,
            Some(0) => false,
            Some(left) => {
                *left -= 1;
                true
            }
        }
    }
}

/// Likelihoods of all actions given the motion, in the steps whose decisions are looked at. All intents share
/// them.
#[derive(Clone, PartialEq, Debug)]
pub struct ActionLikelihoods {
    tolerance: f64,
    interval: usize,
    of_decisions: Vec<[ByChoice; AGENT_COUNT]>,
}

impl ActionLikelihoods {
    /// The likelihoods of no step yet.
    #[must_use]
    pub const fn new(settings: &InversePlanningSettings) -> Self {
        Self { tolerance: settings.tolerance, interval: settings.interval, of_decisions: Vec::new() }
    }

    /// The steps whose decisions are looked at: one of each interval, from the middle of the first one on. At
    /// the start of an event nobody has moved yet.
    fn step(&self, decision: usize) -> usize {
        let interval = self.interval.max(1);
        interval / 2 + decision * interval
    }

    /// Catches up with an event.
    pub fn follow(&mut self, prepared: &PreparedEvent) {
        loop {
            let step = self.step(self.of_decisions.len());
            if step >= prepared.observed().steps() {
                break;
            }
            self.of_decisions.push(choice::likelihoods_in(prepared.motion(), step, self.tolerance));
        }
    }

    /// Number of decisions that were looked at.
    #[must_use]
    pub const fn decisions(&self) -> usize {
        self.of_decisions.len()
    }

    /// The row after which so many decisions, at least one, are known.
    pub(crate) fn row_after(&self, decisions: usize) -> usize {
        self.step(decisions.saturating_sub(1)) + 1
    }

    /// Number of decisions in steps before the one that leads to row `rows`, of rows that are explained as
    /// before.
    fn decisions_before(&self, rows: usize) -> usize {
        (0..).take_while(|&decision| self.step(decision) + 1 < rows).count()
    }

    /// Forgets the steps after some rows that are explained as before.
    pub(crate) fn forget(&mut self, rows: usize) {
        let known = self.decisions_before(rows);
        self.of_decisions.truncate(known);
    }
}

/// The evidence on one intent of one agent: the chance of each of its choices that is looked at.
#[derive(Debug)]
pub struct IntentEvidence {
    agent: AgentId,
    run: SimulationRun,
    chances: Vec<Chance>,
}

impl IntentEvidence {
    /// Evidence of no decision yet on an agent's intent. `others` is the goal that the other agent pursues if
    /// the intent does not say.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub fn new(
        prepared: &PreparedEvent,
        agent: AgentId,
        intent: Intent,
        others: Goal,
        strengths: [Strength; AGENT_COUNT],
    ) -> Result<Self, PomcpError> {
        let run = prepared.run(&Hypothesis::of_intent(intent, agent, others, strengths))?;
        Ok(Self { agent, run, chances: Vec::new() })
    }

    /// Lets the mind of the intent decide in every state that is looked at and is not yet part of the
    /// evidence. `likelihoods` must have caught up with the same event.
    ///
    /// It stops when the budget is spent, and says whether it has caught up with the event.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub fn follow(
        &mut self,
        prepared: &PreparedEvent,
        likelihoods: &ActionLikelihoods,
        budget: &mut Budget,
    ) -> Result<bool, PomcpError> {
        for (decision, of_step) in likelihoods.of_decisions.iter().enumerate().skip(self.chances.len()) {
            if !budget.take() {
                return Ok(false);
            }
            let (action, thought) = prepared.decide(&mut self.run, self.agent, likelihoods.step(decision))?;
            self.chances.push(Chance::of(&choice::policy_of(action, &thought), &of_step[self.agent]));
        }
        Ok(true)
    }

    /// Forgets the steps after some rows that are explained as before.
    pub(crate) fn forget(&mut self, likelihoods: &ActionLikelihoods, rows: usize) {
        self.chances.truncate(likelihoods.decisions_before(rows));
    }

    /// The chance of the agent's action at each decision that was looked at.
    #[must_use]
    pub fn chances(&self) -> &[Chance] {
        &self.chances
    }

    /// ln P(motion | intent) of the agent's part of the motion, but for a constant: relative to the best
    /// choices, which are the same under every intent.
    #[must_use]
    pub fn log_likelihood(&self, settings: &InversePlanningSettings) -> f64 {
        self.log_likelihood_of(self.chances.len(), settings)
    }

    /// ln P(motion | intent) of the first so many decisions.
    pub(crate) fn log_likelihood_of(&self, decisions: usize, settings: &InversePlanningSettings) -> f64 {
        let first = self.chances.iter().take(decisions);
        let log: f64 = first.map(|chance| chance.log(settings.lapse_rate)).sum();
        settings.weight_of_decision() * log
    }
}

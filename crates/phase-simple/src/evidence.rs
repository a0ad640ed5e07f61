//! Evidence of one agent's part of the motion on one intent, before it is weighed.

use crate::{
    Hypothesis, Intent, InversePlanningSettings, PreparedEvent,
    beliefs::EstimatedBeliefs,
    choice::{self, ByChoice, Chance},
    simulation_run::SimulationRun,
    uninformed,
};
use phase_model::{AGENT_COUNT, AgentId, Attitude, Goal, Level, Strength};
use phase_pomcp::PomcpError;

/// Decisions of simulated minds that an inference may spend. One takes about a millisecond.
///
/// ```
/// use phase_simple::Budget;
///
/// // To watch an event as it happens, limit what a row may take.
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

/// The closeness of a look at an intent: at one of so many of the decisions that are looked at, a power of
/// two up to [`Stride::COARSEST`]. A smaller stride looks at more decisions, those of a larger one among
/// them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Stride(usize);

impl Stride {
    /// Every decision.
    pub(crate) const EVERY: Self = Self(1);
    /// The largest stride, 24 steps at the default interval: four times the time after which decisions tell
    /// something new (docs/explanation/simple.md).
    const COARSEST: usize = 8;
    /// The first decision at the largest stride: from there on each is the middle of those it stands for.
    const FIRST: usize = Self::COARSEST / 2;

    /// The largest stride at which at least two of so many decisions are looked at, the fewest that show how
    /// much decisions differ.
    pub(crate) fn coarsest(decisions: usize) -> Self {
        let mut stride = Self(Self::COARSEST);
        while let Some(closer) = stride.closer().filter(|_| stride.of(decisions).nth(1).is_none()) {
            stride = closer;
        }
        stride
    }

    /// The next smaller stride, if there is one.
    pub(crate) fn closer(self) -> Option<Self> {
        (self.0 > 1).then_some(Self(self.0 / 2))
    }

    /// Those of so many decisions that are looked at.
    fn of(self, decisions: usize) -> impl Iterator<Item = usize> {
        (Self::FIRST % self.0..decisions).step_by(self.0)
    }

    /// The decision of these that stands for a decision: the nearest, and of two the earlier.
    fn nearest(self, decision: usize, decisions: usize) -> Option<usize> {
        let since = (decision + Self::COARSEST - Self::FIRST) % self.0;
        let before = decision.checked_sub(since);
        let after = Some(decision + self.0 - since).filter(|after| *after < decisions);
        if 2 * since <= self.0 { before.or(after) } else { after.or(before) }
    }
}

/// The evidence on one intent of one agent: the chance of each of its choices that is looked at.
#[derive(Debug)]
pub struct IntentEvidence {
    agent: AgentId,
    run: SimulationRun,
    /// The level of reasoning, if the agent does not know the other's goal.
    level: Option<Level>,
    /// The policy of each decision that was looked at. It stays what it is when a later row shows the step
    /// after the decision in another light.
    policies: Vec<Option<ByChoice>>,
    /// By decision.
    chances: Vec<Option<Chance>>,
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
        Ok(Self::of(agent, run, None))
    }

    /// Evidence of no decision yet on an agent that helps or hinders whatever it takes the other to want,
    /// which it does not know. The event has to be prepared for such agents.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub(crate) fn uninformed(
        prepared: &PreparedEvent,
        agent: AgentId,
        attitude: Attitude,
        level: Level,
    ) -> Result<Self, PomcpError> {
        let scene = uninformed::scene(prepared.observed(), prepared.motion(), agent, attitude, level);
        Ok(Self::of(agent, prepared.run_in(&scene)?, Some(level)))
    }

    const fn of(agent: AgentId, run: SimulationRun, level: Option<Level>) -> Self {
        Self { agent, run, level, policies: Vec::new(), chances: Vec::new() }
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
        self.follow_at(Stride::EVERY, prepared, likelihoods, budget)
    }

    /// As [`follow`](Self::follow), at fewer of the decisions.
    pub(crate) fn follow_at(
        &mut self,
        stride: Stride,
        prepared: &PreparedEvent,
        likelihoods: &ActionLikelihoods,
        budget: &mut Budget,
    ) -> Result<bool, PomcpError> {
        self.policies.resize(likelihoods.decisions(), None);
        self.chances.resize(likelihoods.decisions(), None);
        for decision in stride.of(likelihoods.decisions()) {
            if self.chances[decision].is_some() {
                continue;
            }
            let policy = match self.policies[decision] {
                Some(known) => known,
                None if !budget.take() => return Ok(false),
                None => self.policy(prepared, likelihoods.step(decision))?,
            };
            self.policies[decision] = Some(policy);
            let of_step = &likelihoods.of_decisions[decision][self.agent];
            self.chances[decision] = Some(Chance::of(&policy, of_step));
        }
        Ok(true)
    }

    /// The policy of the intent's mind at a step.
    fn policy(&mut self, prepared: &PreparedEvent, step: usize) -> Result<ByChoice, PomcpError> {
        match self.level.zip(prepared.uninformed(self.agent)) {
            Some((level, beliefs)) => {
                policy_without_knowledge(prepared, &mut self.run, self.agent, step, beliefs.at(level))
            }
            None => {
                let (action, thought) = prepared.decide(&mut self.run, self.agent, step)?;
                Ok(choice::policy_of(action, &thought))
            }
        }
    }

    /// Forgets the steps after some rows that are explained as before. The decision in the last of their
    /// states is still the same, but not what led on from there.
    pub(crate) fn forget(&mut self, likelihoods: &ActionLikelihoods, rows: usize) {
        self.policies.truncate(likelihoods.decisions_before(rows + 1));
        self.chances.truncate(likelihoods.decisions_before(rows));
    }

    /// The chance of the agent's action at each decision that was looked at.
    pub fn chances(&self) -> impl Iterator<Item = Chance> {
        self.chances.iter().flatten().copied()
    }

    /// ln P(motion | intent) of the first so many decisions of the agent's part of the motion, but for a
    /// constant: relative to the best choices, which are the same under every intent. Each decision counts as
    /// the nearest one that a stride looks at.
    pub(crate) fn log_likelihood(
        &self,
        decisions: usize,
        stride: Stride,
        settings: &InversePlanningSettings,
    ) -> f64 {
        let all = self.chances.len();
        let log = |decision| {
            let chance = stride.nearest(decision, all).and_then(|nearest| self.chances[nearest]);
            chance.map_or(0.0, |chance| chance.log(settings.lapse_rate))
        };
        settings.weight_of_decision() * (0..decisions.min(all)).map(log).sum::<f64>()
    }

    /// The logarithms of the chances that a stride looks at (nat).
    pub(crate) fn logs(&self, stride: Stride, lapse_rate: f64) -> impl Iterator<Item = f64> {
        let looked_at = stride.of(self.chances.len()).filter_map(|decision| self.chances[decision]);
        looked_at.map(move |chance| chance.log(lapse_rate))
    }
}

/// More steps than any event has.
const LONG: u32 = 1_000_000;

/// The policy of a helper or hinderer that does not know the other's goal. A viewer does not know how long it
/// has already watched: where it depends on that whether the agent acts, both are as likely.
fn policy_without_knowledge(
    prepared: &PreparedEvent,
    run: &mut SimulationRun,
    agent: AgentId,
    step: usize,
    beliefs: &EstimatedBeliefs,
) -> Result<ByChoice, PomcpError> {
    let mut decide = |watched: u32| {
        run.has_watched(agent, watched);
        prepared.decide_believing(run, agent, step, beliefs)
    };
    let (action, watchful) = decide(0)?;
    let mut policy = choice::policy_of(action, &watchful);
    if watchful.plan.is_empty() {
        let (action, eager) = decide(LONG)?;
        let of_eager = choice::policy_of(action, &eager);
        policy.iter_mut().zip(of_eager).for_each(|(one, other)| *one = f64::midpoint(*one, other));
    }
    Ok(policy)
}

#[cfg(test)]
mod tests {
    use super::Stride;

    /// A closer look adds decisions, until all are looked at; each stands for itself and those nearest to it.
    #[test]
    fn strides_are_nested_and_evenly_spread() {
        for decisions in 1..60 {
            let mut stride = Stride::coarsest(decisions);
            let mut seen: Vec<usize> = stride.of(decisions).collect();
            assert!(seen.len() >= 2.min(decisions) && seen.len() <= decisions.div_ceil(8).max(3), "{seen:?}");
            loop {
                for decision in 0..decisions {
                    let near = stride.nearest(decision, decisions).expect("there is one");
                    let least = seen.iter().map(|it| it.abs_diff(decision)).min();
                    assert!(seen.contains(&near) && Some(near.abs_diff(decision)) == least, "{stride:?}");
                }
                let Some(closer) = stride.closer() else { break };
                let more: Vec<usize> = closer.of(decisions).collect();
                assert!(seen.iter().all(|decision| more.contains(decision)));
                (stride, seen) = (closer, more);
            }
            assert_eq!(seen, (0..decisions).collect::<Vec<_>>());
        }
    }
}

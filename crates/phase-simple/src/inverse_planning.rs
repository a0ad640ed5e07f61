//! Inverse planning: the likelihood of each agent's motion under each of its possible intents.
//!
//! Both agents decide at the same time from the same state, so given the states their actions are
//! conditionally independent. P(motion | Y) is therefore a product of one factor per agent, and instead of 14
//! · 14 + 2 · 28 hypotheses it suffices to simulate 42 intents of each agent, with the other replaying its
//! inferred actions.
//!
//! All evidence is kept by what it is about and catches up with the event when it is asked for, so that an
//! event can be followed while it is watched, and the answer is the same as if it had been seen at once.

use crate::{
    Hypothesis, Intent, IntentEvidence, InversePlanningSettings, KnowledgeSettings, Posterior,
    evidence::{ActionLikelihoods, Budget, Stride},
    generative::PreparedEvent,
    guide::Guess,
    ignorance::{Explained, UninformedEvidence},
    intent::{WeightedIntents, joint_logs},
    physical_goals, settling,
};
use core::ops::ControlFlow;
use phase_model::{AGENT_COUNT, AgentId, Attitude, Goal, Level, Strength};
use phase_pomcp::PomcpError;
use std::collections::{BTreeMap, btree_map::Entry};

/// Whose intent it is, and the other's goal if the intent does not say.
type Key = (AgentId, Intent, Option<Goal>);

/// Probability from which a hypothesis is likely enough for a close look at what its agents know.
const LIKELY: f64 = 0.05;

/// The evidence on an event for one kind of minds.
#[derive(Debug)]
pub(crate) struct InversePlanner {
    pub(crate) prepared: PreparedEvent,
    settings: InversePlanningSettings,
    strengths: [Strength; AGENT_COUNT],
    likelihoods: ActionLikelihoods,
    evidence: BTreeMap<Key, IntentEvidence>,
    /// The evidence on agents that do not know each other's goals, if such are imagined.
    uninformed: Option<[UninformedEvidence; AGENT_COUNT]>,
    /// The evidence that the last answer used.
    asked: [Vec<Asked>; AGENT_COUNT],
    /// The goals that agents who are not social attribute to each other in it.
    assumed: Option<[Goal; AGENT_COUNT]>,
}

/// Evidence that an answer uses.
#[derive(Clone, Copy, Debug)]
struct Asked {
    key: Key,
    stride: Stride,
}

/// The evidence on an intent that an answer uses.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct IntentLog {
    pub(crate) intent: Intent,
    /// ln P(motion | intent) (nat).
    pub(crate) log: f64,
    /// Its standard error (nat), from what the decisions that were not looked at may add; 0 if all were.
    pub(crate) error: f64,
}

impl InversePlanner {
    pub(crate) fn new(prepared: PreparedEvent, settings: &InversePlanningSettings) -> Self {
        Self {
            strengths: prepared.motion().strengths(),
            prepared,
            settings: *settings,
            likelihoods: ActionLikelihoods::new(settings),
            evidence: BTreeMap::new(),
            uninformed: None,
            asked: [Vec::new(), Vec::new()],
            assumed: None,
        }
    }

    /// ε of its minds.
    pub(crate) const fn lapse_rate(&self) -> f64 {
        self.settings.lapse_rate
    }

    /// The change of the posterior that may be left unmade.
    pub(crate) const fn tolerated_change(&self) -> f64 {
        self.settings.tolerated_change
    }

    /// Drops the evidence on all but some first rows of an event that was followed, which are explained as
    /// before.
    pub(crate) fn forget(&mut self, rows: usize) {
        let strengths = self.prepared.motion().strengths();
        if strengths == self.strengths {
            self.evidence.values_mut().for_each(|evidence| evidence.forget(&self.likelihoods, rows));
            let uninformed = self.uninformed.iter_mut().flatten();
            uninformed.for_each(|evidence| evidence.forget(&self.likelihoods, rows));
            self.likelihoods.forget(rows);
        } else {
            *self = Self::new(self.prepared.clone(), &self.settings);
        }
    }

    /// Catches up with the event, as far as all intents have it in common.
    pub(crate) fn follow(&mut self) {
        self.likelihoods.follow(&self.prepared);
    }

    /// Asks for some intents anew, each looked at as little as may be. `assumed` are the goals that agents
    /// who are not social attribute to each other.
    pub(crate) fn ask(&mut self, intents: &[(AgentId, Intent)], assumed: [Goal; AGENT_COUNT]) {
        let stride = self.first_stride();
        self.asked = [Vec::new(), Vec::new()];
        for &(agent, intent) in intents {
            self.asked[agent].push(Asked { key: key(agent, intent, assumed[agent.other()]), stride });
        }
        self.assumed = Some(assumed);
    }

    /// The closeness of the first look at an intent.
    fn first_stride(&self) -> Stride {
        if self.settings.tolerated_change > 0.0 { Stride::coarsest(self.decisions()) } else { Stride::EVERY }
    }

    /// Catches up with an intent of an agent, the other pursuing `others`. Whether it could, within the
    /// budget.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub(crate) fn catch_up(
        &mut self,
        agent: AgentId,
        intent: Intent,
        others: Goal,
        budget: &mut Budget,
    ) -> Result<bool, PomcpError> {
        self.follow_intent(Asked { key: key(agent, intent, others), stride: self.first_stride() }, budget)
    }

    /// Looks at all that was asked for, as far as the budget suffices; the rest is no longer asked for.
    /// Whether `tick`, which is called about once per intent, let it.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub(crate) fn look(
        &mut self,
        budget: &mut Budget,
        tick: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<bool, PomcpError> {
        for agent in AgentId::ALL {
            for asked in core::mem::take(&mut self.asked[agent]) {
                if tick().is_break() {
                    return Ok(false);
                }
                if self.follow_intent(asked, budget)? {
                    self.asked[agent].push(asked);
                }
            }
        }
        Ok(true)
    }

    /// Catches up with agents that do not know each other's goals, if such are imagined, as far as the budget
    /// suffices.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub(crate) fn look_at_uninformed(&mut self, budget: &mut Budget) -> Result<(), PomcpError> {
        for agent in AgentId::ALL {
            if self.prepared.uninformed(agent).is_none() {
                return Ok(());
            }
        }
        if self.uninformed.is_none() {
            let of = |agent| UninformedEvidence::new(&self.prepared, agent);
            self.uninformed = Some([of(AgentId::ZERO)?, of(AgentId::ONE)?]);
        }
        for evidence in self.uninformed.iter_mut().flatten() {
            evidence.follow(&self.prepared, &self.likelihoods, budget)?;
        }
        Ok(())
    }

    /// Looks at all decisions of the helpers and hinderers that are likely, if such may not know the other's
    /// goal: whether they do often shows in few decisions.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub(crate) fn settle_knowledge(
        &mut self,
        posterior: &Posterior,
        budget: &mut Budget,
    ) -> Result<(), PomcpError> {
        if self.uninformed.is_none() {
            return Ok(());
        }
        for (hypothesis, _) in posterior.hypotheses.iter().filter(|(_, weight)| *weight >= LIKELY) {
            let Some(agent) = hypothesis.social_agent() else { continue };
            let intent =
                Intent { attitude: hypothesis.attitudes[agent], goal: hypothesis.goals[agent.other()] };
            let Some(place) = self.asked[agent].iter().position(|asked| asked.key.1 == intent) else {
                continue;
            };
            let every = Asked { stride: Stride::EVERY, ..self.asked[agent][place] };
            if self.follow_intent(every, budget)? {
                self.asked[agent][place] = every;
            }
        }
        Ok(())
    }

    /// For an intent of an agent that was asked for the probability of each level of reasoning, at which the
    /// agent does not know the other's goal; the rest is that it knows.
    pub(crate) fn levels(&self, agent: AgentId, intent: Intent) -> [f64; Level::ALL.len()] {
        let asked = self.asked[agent].iter().find(|asked| asked.key.1 == intent);
        // What decisions tell of knowledge is not tempered, as what they tell of objects is not.
        let inverse_temperature =
            KnowledgeSettings::default().inverse_temperature / self.settings.interval.max(1) as f64;
        let settings = InversePlanningSettings { inverse_temperature, ..self.settings };
        let explained = asked.map(|asked| self.explain(agent, asked, self.decisions(), &settings));
        explained.map_or([0.0; Level::ALL.len()], |explained| explained.levels)
    }

    fn explain(
        &self,
        agent: AgentId,
        &Asked { key, stride }: &Asked,
        decisions: usize,
        settings: &InversePlanningSettings,
    ) -> Explained {
        let evidence = self.evidence.get(&key);
        let log = evidence.map_or(0.0, |it| it.log_likelihood(decisions, stride, settings));
        match &self.uninformed {
            Some(uninformed) => uninformed[agent].explain(key.1.attitude, log, decisions, settings),
            None => Explained { log, levels: [0.0; Level::ALL.len()] },
        }
    }

    /// Looks at an intent that was asked for more closely, if that is possible within the budget.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub(crate) fn look_closer(
        &mut self,
        agent: AgentId,
        place: usize,
        budget: &mut Budget,
    ) -> Result<bool, PomcpError> {
        let asked = self.asked[agent][place];
        let Some(stride) = asked.stride.closer() else { return Ok(false) };
        let closer = Asked { stride, ..asked };
        let could = self.follow_intent(closer, budget)?;
        if could {
            self.asked[agent][place] = closer;
        }
        Ok(could)
    }

    /// Lets agents who are not social attribute to each other the goals that are likeliest, given what a
    /// guide guesses, and looks at their intents again as far as the budget suffices. Whether those are
    /// others than before; `None` if `tick` did not let it.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub(crate) fn reconsider(
        &mut self,
        guess: Option<&Guess>,
        budget: &mut Budget,
        tick: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Option<bool>, PomcpError> {
        let logs = self.logs(self.decisions(), self.settings.lapse_rate);
        let posterior = Posterior::new(self.joint(&logs, guess));
        let likeliest = posterior.hypotheses.first().map(|(best, _)| best.goals);
        let (Some(before), Some(likeliest)) = (self.assumed, likeliest) else { return Ok(Some(false)) };
        for agent in
            AgentId::ALL.into_iter().filter(|agent| likeliest[agent.other()] != before[agent.other()])
        {
            for place in 0..self.asked[agent].len() {
                let Asked { key: (_, intent, _), stride } = self.asked[agent][place];
                if intent.attitude != Attitude::Neutral {
                    continue;
                }
                if tick().is_break() {
                    return Ok(None);
                }
                let asked = Asked { key: key(agent, intent, likeliest[agent.other()]), stride };
                if self.follow_intent(asked, budget)? {
                    self.asked[agent][place] = asked;
                }
            }
        }
        self.assumed = Some(likeliest);
        Ok(Some(likeliest != before))
    }

    /// Number of decisions that were looked at.
    pub(crate) fn decisions(&self) -> usize {
        self.likelihoods.decisions()
    }

    /// The row after which so many decisions are known.
    pub(crate) fn row_after(&self, decisions: usize) -> usize {
        self.likelihoods.row_after(decisions)
    }

    /// The evidence on all that was asked for, at a lapse rate, in the first so many decisions.
    pub(crate) fn logs(&self, decisions: usize, lapse_rate: f64) -> [Vec<IntentLog>; AGENT_COUNT] {
        let settings = InversePlanningSettings { lapse_rate, ..self.settings };
        let deviation = self.deviation(lapse_rate);
        AgentId::ALL.map(|agent| {
            let log = |asked: &Asked| {
                let Asked { key, stride } = *asked;
                let evidence = self.evidence.get(&key);
                let Explained { log, levels } = self.explain(agent, asked, decisions, &settings);
                let looked_at = evidence.map_or(0, |it| it.logs(stride, lapse_rate).count()).max(1) as f64;
                let all = self.decisions() as f64;
                // Of a mean of some of so many decisions.
                let error = deviation * libm::sqrt((1.0 / looked_at - 1.0 / all).max(0.0));
                // All decisions of agents that do not know are looked at.
                let knows = 1.0 - levels.iter().sum::<f64>();
                IntentLog { intent: key.1, log, error: knows * settings.weight_of_decision() * all * error }
            };
            self.asked[agent].iter().map(log).collect()
        })
    }

    /// The standard deviation of the log likelihoods of single decisions (nat), from the differences of
    /// successive ones that were looked at, as for a systematic sample, because near decisions are alike;
    /// pooled over all intents asked for.
    fn deviation(&self, lapse_rate: f64) -> f64 {
        let mut squares = 0.0;
        let mut count = 0;
        for Asked { key, stride } in self.asked.iter().flatten() {
            let Some(evidence) = self.evidence.get(key) else { continue };
            let logs: Vec<f64> = evidence.logs(*stride, lapse_rate).collect();
            squares += logs.windows(2).map(|pair| (pair[1] - pair[0]) * (pair[1] - pair[0])).sum::<f64>();
            count += logs.len().saturating_sub(1);
        }
        libm::sqrt(squares / (2 * count.max(1)) as f64)
    }

    /// ln P(Y) P(motion | Y) of every hypothesis from the evidence on intents, those that were not simulated
    /// included, when the guide said `guess`.
    pub(crate) fn joint(
        &self,
        logs: &[Vec<IntentLog>; AGENT_COUNT],
        guess: Option<&Guess>,
    ) -> Vec<(Hypothesis, f64)> {
        let joint = self.joint_of_simulated(logs, guess);
        match guess {
            Some(guess) => guess.complete(joint),
            None => joint,
        }
    }

    /// The share that the hypotheses with each intent have among all that were simulated.
    pub(crate) fn shares(
        &self,
        logs: &[Vec<IntentLog>; AGENT_COUNT],
        guess: Option<&Guess>,
    ) -> [Vec<f64>; AGENT_COUNT] {
        let joint = self.joint_of_simulated(logs, guess);
        AgentId::ALL.map(|agent| settling::shares(&joint, agent, logs[agent].iter().map(|it| it.intent)))
    }

    fn joint_of_simulated(
        &self,
        logs: &[Vec<IntentLog>; AGENT_COUNT],
        guess: Option<&Guess>,
    ) -> Vec<(Hypothesis, f64)> {
        let weighted_intents: [WeightedIntents; AGENT_COUNT] = AgentId::ALL.map(|agent| {
            let guessed = |intent| guess.map_or(0.0, |guess| guess.log(agent, intent));
            logs[agent].iter().map(|it| (it.intent, it.log + guessed(it.intent))).collect()
        });
        let goals = physical_goals(AgentId::ZERO, self.prepared.observed().object_sizes().len()).len();
        joint_logs(&weighted_intents, self.strengths, goals)
    }

    /// Catches up with an intent; whether it could within the budget.
    fn follow_intent(
        &mut self,
        Asked { key, stride }: Asked,
        budget: &mut Budget,
    ) -> Result<bool, PomcpError> {
        let (agent, intent, others) = key;
        let evidence = match self.evidence.entry(key) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(unknown) => {
                // A social agent's own intent says what the other pursues.
                let others = others.unwrap_or(intent.goal);
                let evidence = IntentEvidence::new(&self.prepared, agent, intent, others, self.strengths)?;
                unknown.insert(evidence)
            }
        };
        evidence.follow_at(stride, &self.prepared, &self.likelihoods, budget)
    }
}

/// The key of the evidence on an intent, which depends on the other's goal only if the agent is not social.
fn key(agent: AgentId, intent: Intent, others: Goal) -> Key {
    (agent, intent, (intent.attitude == Attitude::Neutral).then_some(others))
}

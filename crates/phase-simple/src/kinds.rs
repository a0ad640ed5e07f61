//! Inverse planning with every kind of minds, and what the guide said while the event was watched.

use crate::{
    AlternativeAgents, Budget, Guidance, Guide, ImaginedAgents, InferenceSettings, Intent,
    InversePlanningSettings, Posterior, Proposal, UniformStrength,
    answer::{self, Inference, KindEvidence, KnowledgeOfGoal, average, log_evidence, mixture, weighted},
    generative::PreparedEvent,
    guide::Guess,
    impression::{Impression, happenings},
    intent::WeightedIntents,
    intent_network::IntentReader,
    inverse_planning::{IntentLog, InversePlanner},
    settling::{Settling, ShareInKinds},
};
use core::ops::ControlFlow;
use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, AgentId, Body, MAX_ENTITIES, Strength};
use phase_pomcp::PomcpError;
use std::{collections::BTreeMap, sync::Arc};

/// The guide's guesses after every row of an event.
#[derive(Clone, Debug)]
pub(crate) struct GuideCourse {
    guidance: Guidance,
    reader: IntentReader,
    /// ln Q of every intent of each agent after each row.
    intents: Vec<[WeightedIntents; AGENT_COUNT]>,
    /// The guess after each row, given what it depends on beside the row.
    guesses: BTreeMap<usize, Guess>,
    given: Option<(usize, [Strength; AGENT_COUNT])>,
}

impl GuideCourse {
    /// Watches all rows that have been observed.
    pub(crate) fn new(guide: &Guide, observed: &ObservedEvent) -> Self {
        let reader = guide.network.watch(observed);
        let guidance = guide.guidance;
        let guesses = BTreeMap::new();
        let mut course = Self { guidance, reader, intents: Vec::new(), guesses, given: None };
        observed.rows().iter().for_each(|row| course.push(row));
        course
    }

    pub(crate) fn push(&mut self, row: &[Body; MAX_ENTITIES]) {
        self.reader.push(row);
        self.intents.push(self.reader.intents());
    }

    /// Guesses from now on for an event with so many objects, whose agents have these strengths.
    fn given(&mut self, objects: usize, strengths: [Strength; AGENT_COUNT]) {
        if self.given.replace((objects, strengths)) != Some((objects, strengths)) {
            self.guesses.clear();
        }
    }

    /// The guess after a row, or after the last one that was watched.
    fn guess(&mut self, row: usize) -> Option<&Guess> {
        let row = row.min(self.intents.len().checked_sub(1)?);
        let (objects, strengths) = self.given?;
        let guess = || Guess::new(&self.guidance, self.intents[row].clone(), objects, strengths);
        Some(self.guesses.entry(row).or_insert_with(guess))
    }
}

/// Refinement passes: how often the intents are re-evaluated with an updated goal of the other agent.
const REFINEMENT_PASSES: usize = 2;

/// Shares of the intent network and of distances in the answer to motion that PHASE cannot explain. The prior
/// has the rest, so that no answer is certain.
const FOREIGN_SHARES: [f64; 2] = [0.4, 0.4];

/// The findings of a planner about all intents that it was asked for.
#[derive(Clone, Debug)]
struct Findings {
    /// At its own lapse rate.
    own: [Vec<IntentLog>; AGENT_COUNT],
    /// At the rate at which kinds are compared, if there are two.
    compared: Option<[Vec<IntentLog>; AGENT_COUNT]>,
}

impl Findings {
    fn evidence(&self, planner: &InversePlanner, guess: Option<&Guess>) -> KindEvidence {
        let joint = planner.joint(&self.own, guess);
        let compared = self.compared.as_ref().map(|logs| planner.joint(logs, guess));
        let log_evidence = log_evidence(compared.as_ref().unwrap_or(&joint));
        KindEvidence { joint, log_evidence }
    }

    fn intents(&self) -> [Vec<Intent>; AGENT_COUNT] {
        self.own.each_ref().map(|logs| logs.iter().map(|it| it.intent).collect())
    }

    fn shares(&self, planner: &InversePlanner, guess: Option<&Guess>) -> [Vec<ShareInKinds>; AGENT_COUNT] {
        let of = |logs: &[Vec<IntentLog>; AGENT_COUNT]| planner.shares(logs, guess);
        let own = of(&self.own);
        let compared = self.compared.as_ref().map_or_else(|| own.clone(), of);
        let both = |agent: AgentId| own[agent].iter().zip(&compared[agent]);
        AgentId::ALL
            .map(|agent| both(agent).map(|(&own, &compared)| ShareInKinds { own, compared }).collect())
    }
}

/// One planner for each kind of minds.
#[derive(Debug)]
pub(crate) struct Planners {
    /// In the order of the settings.
    pub(crate) planners: Vec<InversePlanner>,
    agents: Vec<ImaginedAgents>,
    /// ε at which kinds are compared, if there are two.
    comparison: Option<f64>,
}

impl Planners {
    pub(crate) fn new(
        prepared: &PreparedEvent,
        planning: &InversePlanningSettings,
        settings: &InferenceSettings,
    ) -> Self {
        let alternative = settings.alternative;
        let uninformed = |prepared: PreparedEvent| {
            if settings.latent_knowledge { prepared.with_uninformed() } else { prepared }
        };
        let mut planners = vec![InversePlanner::new(uninformed(prepared.clone()), planning)];
        if let Some(AlternativeAgents { agents, lapse_rate, .. }) = alternative {
            let planning = InversePlanningSettings { lapse_rate, ..*planning };
            planners.push(InversePlanner::new(uninformed(prepared.with_agents(agents)), &planning));
        }
        let agents = planners.iter().map(|planner| *planner.prepared.agents()).collect();
        Self { planners, agents, comparison: alternative.map(|it| it.comparison_lapse_rate) }
    }

    /// The evidence that each kind finds in the first so many decisions, given the guide's guess.
    fn evidence(&self, decisions: usize, guess: Option<&Guess>) -> Vec<KindEvidence> {
        let one = |planner: &InversePlanner| self.findings(planner, decisions).evidence(planner, guess);
        self.planners.iter().map(one).collect()
    }

    fn findings(&self, planner: &InversePlanner, decisions: usize) -> Findings {
        Findings {
            own: planner.logs(decisions, planner.lapse_rate()),
            compared: self.comparison.map(|lapse| planner.logs(decisions, lapse)),
        }
    }

    /// Looks more closely at the intents of which one standard error more or less of ln P(motion | intent)
    /// would change the posterior by more than is tolerated, until there are none or the budget is spent.
    fn settle(
        &mut self,
        tolerated: f64,
        guess: Option<&Guess>,
        budget: &mut Budget,
        tick: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, PomcpError> {
        loop {
            let mut closer = false;
            for (kind, agent, place) in self.unsettled(tolerated, guess) {
                if tick().is_break() {
                    return Ok(ControlFlow::Break(()));
                }
                closer |= self.planners[kind].look_closer(agent, place, budget)?;
            }
            if !closer {
                return Ok(ControlFlow::Continue(()));
            }
        }
    }

    /// The intents that are worth a closer look: kind, agent and place among those asked for.
    fn unsettled(&self, tolerated: f64, guess: Option<&Guess>) -> Vec<(usize, AgentId, usize)> {
        let decisions = self.planners[0].decisions();
        let findings: Vec<Findings> =
            self.planners.iter().map(|planner| self.findings(planner, decisions)).collect();
        let both = || self.planners.iter().zip(&findings);
        let evidence: Vec<KindEvidence> =
            both().map(|(planner, findings)| findings.evidence(planner, guess)).collect();
        let simulated: Vec<_> = findings.iter().map(Findings::intents).collect();
        let settling = Settling::new(&evidence, &simulated);
        let mut unsettled = Vec::new();
        for (kind, (planner, of_kind)) in both().enumerate() {
            let shares = of_kind.shares(planner, guess);
            for agent in AgentId::ALL {
                for (place, found) in of_kind.own[agent].iter().enumerate() {
                    let changes = |sign: f64| {
                        let compared = of_kind.compared.as_ref().unwrap_or(&of_kind.own);
                        let errors = [found.error, compared[agent][place].error].map(|it| sign * it);
                        let share = shares[agent][place];
                        // Most intents cannot change much, which is quickly known.
                        share.greatest_change(errors, settling.probability(kind)) >= tolerated
                            && settling.change(kind, agent, found.intent, share, errors) > tolerated
                    };
                    if found.error > 0.0 && (changes(1.0) || changes(-1.0)) {
                        unsettled.push((kind, agent, place));
                    }
                }
            }
        }
        unsettled
    }

    /// The answer of all kinds of minds together, and how it came about. Intents that the budget does not
    /// suffice for are left to the guide.
    pub(crate) fn weigh(
        &mut self,
        gamma: f64,
        mut guide: Option<&mut GuideCourse>,
        budget: &mut Budget,
        tick: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Option<Inference>, PomcpError> {
        let prepared = &self.planners[0].prepared;
        let observed = Arc::clone(prepared.shared_observed());
        let objects = observed.object_sizes().len();
        let strengths = prepared.motion().strengths();
        if let Some(guide) = guide.as_deref_mut() {
            guide.given(objects, strengths);
        }
        let last = guide.as_deref_mut().and_then(|guide| guide.guess(observed.steps())).cloned();
        if prepared.motion().is_foreign() || observed.missing().forms {
            let posterior = foreign(&observed, gamma, last.as_ref());
            let likely = happenings(&observed, posterior.hypotheses.iter().copied());
            let impression = Impression::of(&observed, [likely]);
            return Ok(Some(answer::foreign(self.agents[0], posterior, impression)));
        }
        // The goal that each agent attributes to the other if it is not social.
        let assumed = last.as_ref().and_then(Guess::goals).unwrap_or_else(|| {
            let cue = Proposal::new(&observed, 0..=observed.steps(), gamma, &UniformStrength);
            AgentId::ALL.map(|agent| cue.most_likely_goal(agent))
        });
        let all = || {
            let of = |agent| Intent::all(agent, objects).into_iter().map(move |intent| (agent, intent));
            AgentId::ALL.into_iter().flat_map(of).collect()
        };
        let mut intents: Vec<(AgentId, Intent)> = last.as_ref().map_or_else(all, Guess::kept);
        self.planners.iter_mut().for_each(InversePlanner::follow);
        if budget.decisions.is_some() {
            // Those for which every kind of minds knows what the others know.
            let mut ready = Vec::with_capacity(intents.len());
            for (agent, intent) in intents {
                let mut known = true;
                for planner in &mut self.planners {
                    known &= planner.catch_up(agent, intent, assumed[agent.other()], budget)?;
                }
                if known {
                    ready.push((agent, intent));
                }
            }
            intents = ready;
        }
        for planner in &mut self.planners {
            planner.ask(&intents, assumed);
            if !planner.look(budget, tick)? {
                return Ok(None);
            }
            planner.look_at_uninformed(budget)?;
        }
        let tolerated = self.planners[0].tolerated_change();
        for pass in 0..=REFINEMENT_PASSES {
            if self.settle(tolerated, last.as_ref(), budget, tick)?.is_break() {
                return Ok(None);
            }
            let mut changed = false;
            for planner in self.planners.iter_mut().filter(|_| pass < REFINEMENT_PASSES) {
                let Some(others) = planner.reconsider(last.as_ref(), budget, tick)? else { return Ok(None) };
                changed |= others;
            }
            if !changed {
                break;
            }
        }
        let first = &self.planners[0];
        let course = (1..=first.decisions()).map(|decisions| {
            let row = first.row_after(decisions);
            let guess = guide.as_deref_mut().and_then(|guide| guide.guess(row));
            let evidence = self.evidence(decisions, guess);
            happenings(&observed, weighted(&evidence).map(|(hypothesis, log)| (hypothesis, libm::exp(log))))
        });
        let impression = Impression::of(&observed, course);
        let decisions = first.decisions();
        let likely = mixture(&self.evidence(decisions, last.as_ref())).0;
        for planner in &mut self.planners {
            planner.settle_knowledge(&likely, budget)?;
        }
        let evidence = self.evidence(decisions, last.as_ref());
        let inference = average(&self.agents, evidence, impression);
        let knowledge = self.knowledge(&inference);
        Ok(Some(Inference { posterior: inference.posterior.judged(&observed), knowledge, ..inference }))
    }
}

impl Planners {
    /// The knowledge that each agent is taken to have; `None` if all agents are imagined to know it.
    fn knowledge(&self, inference: &Inference) -> Option<[KnowledgeOfGoal; AGENT_COUNT]> {
        let prepared = self.planners.iter().map(|planner| &planner.prepared);
        let informed = prepared.clone().all(|prepared| prepared.uninformed(AgentId::ZERO).is_none());
        let parts = |agent: AgentId| {
            let mut knowledge = KnowledgeOfGoal::default();
            for (planner, minds) in self.planners.iter().zip(&inference.minds) {
                for (hypothesis, weight) in &minds.posterior.hypotheses {
                    if hypothesis.social_agent() != Some(agent) {
                        continue;
                    }
                    let weight = minds.probability * weight;
                    let goal = hypothesis.goals[agent.other()];
                    let attitude = hypothesis.attitudes[agent];
                    let levels = planner.levels(agent, Intent { attitude, goal });
                    knowledge.add(weight, goal, levels, planner.prepared.uninformed(agent));
                }
            }
            knowledge.conditional()
        };
        (!informed).then(|| AgentId::ALL.map(parts))
    }
}

/// The answer of the intent network and of distances to motion that the minds cannot have made.
fn foreign(observed: &ObservedEvent, gamma: f64, guess: Option<&Guess>) -> Posterior {
    let cue = |gamma| Proposal::new(observed, 0..=observed.steps(), gamma, &UniformStrength).posterior();
    let [of_network, of_distances] = FOREIGN_SHARES;
    let of_network = if guess.is_some() { of_network } else { 0.0 };
    let mut parts = vec![(cue(gamma), of_distances), (cue(0.0), 1.0 - of_network - of_distances)];
    parts.extend(guess.map(|guess| (guess.posterior().clone(), of_network)));
    Posterior::mixture(&parts).judged(observed)
}

#[cfg(test)]
mod tests {
    use super::Planners;
    use crate::{Budget, Inference, InferenceSettings, InversePlanningSettings, PreparedEvent};
    use core::ops::ControlFlow;
    use phase_event::{ObservedEvent, Recording};
    use phase_model::{
        EventKind,
        random::{Purpose, stream},
    };
    use phase_sim::SimulationSettings;

    /// An event whose agents search little.
    fn observed(kind: EventKind) -> ObservedEvent {
        let scene = phase_sampler::sample_kind(kind, &mut stream(4, Purpose::Scene, 0)).expect("a scene");
        let mut settings = SimulationSettings { max_steps: 60, ..SimulationSettings::default() };
        settings.minds = settings.minds.with_simulations(50);
        let event = phase_sim::simulate(&scene, 1, &settings).expect("a sound scene");
        let recording = Recording::of_event("event", event, "test".into(), serde_json::Value::Null);
        recording.observed().expect("a sound event")
    }

    /// The answer with a tolerated change of the posterior, and the decisions that it took.
    fn weigh(prepared: &PreparedEvent, tolerated_change: f64) -> (Inference, usize) {
        const PLENTY: usize = 1_000_000;
        let planning = InversePlanningSettings { tolerated_change, ..InversePlanningSettings::default() };
        let mut budget = Budget { decisions: Some(PLENTY) };
        let gamma = InferenceSettings::default().gamma;
        let tick = &mut || ControlFlow::Continue(());
        let mut planners = Planners::new(prepared, &planning, &InferenceSettings::default());
        let inference =
            planners.weigh(gamma, None, &mut budget, tick).expect("sound").expect("not cancelled");
        (inference, PLENTY - budget.decisions.unwrap_or(PLENTY))
    }

    /// Many decisions would not change the answer, and are not simulated.
    #[test]
    fn decisions_that_change_nothing_are_not_simulated() {
        let mut agents = InferenceSettings::default().agents;
        agents.minds = agents.minds.with_particles(5).with_simulations(20);
        let mut taken = [0; 2];
        for kind in [EventKind::Helping, EventKind::Chasing] {
            let prepared = PreparedEvent::new(&observed(kind), agents, 1);
            let [(all, most), (some, fewer)] = [0.0, 0.01].map(|tolerated| weigh(&prepared, tolerated));
            let change = all.posterior.total_variation(&some.posterior);
            assert!(change < 0.1, "{kind:?}: {change}");
            taken = [taken[0] + most, taken[1] + fewer];
        }
        assert!(taken[1] * 3 < taken[0] * 2, "{taken:?}");
    }
}

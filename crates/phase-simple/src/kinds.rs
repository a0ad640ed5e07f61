//! Inverse planning with every kind of minds, and what the guide said while the event was watched.

use crate::{
    AlternativeAgents, Budget, Guidance, Guide, ImaginedAgents, Intent, InversePlanningSettings, Proposal,
    UniformStrength,
    answer::{Inference, KindEvidence, average, log_evidence, mixture},
    generative::PreparedEvent,
    guide::Guess,
    impression::Impression,
    intent::WeightedIntents,
    intent_network::IntentReader,
    inverse_planning::InversePlanner,
};
use core::ops::ControlFlow;
use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, AgentId, Body, MAX_ENTITIES, Strength};
use phase_pomcp::PomcpError;
use std::sync::Arc;

/// The guide's guesses after every row of an event.
#[derive(Clone, Debug)]
pub(crate) struct GuideCourse {
    guidance: Guidance,
    reader: IntentReader,
    /// ln Q of every intent of each agent after each row.
    intents: Vec<[WeightedIntents; AGENT_COUNT]>,
}

impl GuideCourse {
    /// Watches all rows that have been observed.
    pub(crate) fn new(guide: &Guide, observed: &ObservedEvent) -> Self {
        let reader = guide.network.watch(observed);
        let mut course = Self { guidance: guide.guidance, reader, intents: Vec::new() };
        observed.rows().iter().for_each(|row| course.push(row));
        course
    }

    pub(crate) fn push(&mut self, row: &[Body; MAX_ENTITIES]) {
        self.reader.push(row);
        self.intents.push(self.reader.intents());
    }

    /// The guess after a row of an event with so many objects, whose agents have these strengths.
    fn guess(&self, row: usize, objects: usize, strengths: [Strength; AGENT_COUNT]) -> Guess {
        let last = self.intents.len().saturating_sub(1);
        let intents = self.intents.get(row.min(last)).cloned().unwrap_or_default();
        Guess::new(&self.guidance, intents, objects, strengths)
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
        alternative: Option<AlternativeAgents>,
    ) -> Self {
        let mut planners = vec![InversePlanner::new(prepared.clone(), planning)];
        if let Some(AlternativeAgents { agents, lapse_rate, .. }) = alternative {
            let planning = InversePlanningSettings { lapse_rate, ..*planning };
            planners.push(InversePlanner::new(prepared.with_agents(agents), &planning));
        }
        let agents = planners.iter().map(|planner| *planner.prepared.agents()).collect();
        Self { planners, agents, comparison: alternative.map(|it| it.comparison_lapse_rate) }
    }

    /// The evidence that each kind finds in the first so many decisions, given the guide's guess.
    fn evidence(&self, decisions: usize, guess: Option<&Guess>) -> Vec<KindEvidence> {
        let one = |planner: &InversePlanner| {
            let joint = planner.weighted_after(decisions, guess, None);
            let compared = self.comparison.map(|lapse| planner.weighted_after(decisions, guess, Some(lapse)));
            let log_evidence = log_evidence(compared.as_ref().unwrap_or(&joint));
            KindEvidence { joint, log_evidence }
        };
        self.planners.iter().map(one).collect()
    }

    /// The answer of all kinds of minds together, and how it came about. Intents that the budget does not
    /// suffice for are left to the guide.
    pub(crate) fn weigh(
        &mut self,
        gamma: f64,
        guide: Option<&GuideCourse>,
        budget: &mut Budget,
        tick: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Option<Inference>, PomcpError> {
        let prepared = &self.planners[0].prepared;
        let observed = Arc::clone(prepared.shared_observed());
        let objects = observed.object_sizes().len();
        let strengths = prepared.motion().strengths();
        let guess = |row| guide.map(|guide| guide.guess(row, objects, strengths));
        let last = guess(observed.steps());
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
            if !planner.simulate(&intents, assumed, last.as_ref(), budget, tick)? {
                return Ok(None);
            }
        }
        let first = &self.planners[0];
        let course = (1..=first.decisions()).map(|decisions| {
            let guess = guess(first.row_after(decisions));
            mixture(&self.evidence(decisions, guess.as_ref())).0
        });
        let impression = Impression::of(&observed, course);
        let evidence = self.evidence(first.decisions(), last.as_ref());
        Ok(Some(average(&self.agents, evidence, impression)))
    }
}

//! An observer that watches an event row by row.

use crate::{
    Algorithm, AlternativeMinds, Effort, Guidance, Guide, Inference, InferenceSettings,
    InversePlanningSettings, Posterior, Proposal, UniformStrength,
    generative::PreparedEvent,
    guide::Guess,
    impression::Impression,
    inference::average,
    intent::{Intent, WeightedIntents},
    intent_network::IntentReader,
    inverse_dynamics::MotionTracker,
    inverse_planning::InversePlanner,
};
use core::ops::ControlFlow;
use phase_event::{ObservedError, ObservedEvent};
use phase_minds::MindParameters;
use phase_model::{AGENT_COUNT, AgentId, Body, MAX_ENTITIES, Strength};
use phase_pomcp::PomcpError;
use std::sync::Arc;
use thiserror::Error;

/// Why an event cannot be watched row by row.
#[derive(Debug, Error)]
pub enum ObserverError {
    /// Algorithm 2 simulates whole events.
    #[error("only inverse planning can watch an event row by row, not the chains of Algorithm 2")]
    Chains,
    /// A row that is no observation.
    #[error("the next row cannot be observed")]
    Row(#[from] ObservedError),
    /// Invalid parameters of the agents' search.
    #[error("the minds cannot be simulated")]
    Search(#[from] PomcpError),
}

/// What the guide said after every row.
#[derive(Clone, Debug)]
pub(crate) struct GuideCourse<'a> {
    guidance: Guidance,
    reader: IntentReader<'a>,
    /// ln Q of every intent of each agent after each row.
    intents: Vec<[WeightedIntents; AGENT_COUNT]>,
}

impl<'a> GuideCourse<'a> {
    /// Watches all rows that have been observed.
    pub(crate) fn new(guide: &Guide<'a>, observed: &ObservedEvent) -> Self {
        let reader = guide.network.watch(observed);
        let mut course = Self { guidance: guide.guidance, reader, intents: Vec::new() };
        observed.rows().iter().for_each(|row| course.push(row));
        course
    }

    fn push(&mut self, row: &[Body; MAX_ENTITIES]) {
        self.reader.push(row);
        self.intents.push(self.reader.intents());
    }

    /// What it said after a row, of an event with so many objects whose agents have these strengths.
    fn guess(&self, row: usize, objects: usize, strengths: [Strength; AGENT_COUNT]) -> Guess {
        let last = self.intents.len().saturating_sub(1);
        let intents = self.intents.get(row.min(last)).cloned().unwrap_or_default();
        Guess::new(&self.guidance, intents, objects, strengths)
    }
}

/// Watches an event row by row, and says after each what explains it.
///
/// What is learnt later about earlier steps is taken back, so [`Observer::inference`] gives the answer of
/// [`infer`](crate::infer) for the rows seen so far, bit for bit. [`Observer::push`] gives the same with limited effort, so that an
/// event can be watched as it happens; the two differ while intents that have just become likely are being simulated.
#[derive(Debug)]
pub struct Observer<'a> {
    observed: Arc<ObservedEvent>,
    tracker: MotionTracker,
    planners: Vec<(MindParameters, InversePlanner)>,
    guide: Option<GuideCourse<'a>>,
    gamma: f64,
    effort: Effort,
}

/// What an observer spends on a row by default (POMCP simulations): less than the 250 ms that a step lasts in a video on a
/// core of 2020.
const EFFORT: usize = 12_000;

impl<'a> Observer<'a> {
    /// Watches an event from its beginning: `observed` has the rows seen so far, at least one.
    ///
    /// # Errors
    /// [`ObserverError::Chains`] unless the settings are those of inverse planning.
    pub fn new(
        observed: &ObservedEvent,
        guide: Option<&Guide<'a>>,
        seed: u64,
        settings: &InferenceSettings,
    ) -> Result<Self, ObserverError> {
        let Algorithm::InversePlanning(planning) = settings.algorithm else {
            return Err(ObserverError::Chains);
        };
        let tracker = MotionTracker::new(observed);
        let observed = Arc::new(observed.clone());
        let motion = Arc::new(tracker.motion().clone());
        let prepared = PreparedEvent::with_motion(Arc::clone(&observed), motion, settings.minds, seed);
        let planners = planners(&prepared, &planning, settings.alternative);
        let guide = guide.map(|guide| GuideCourse::new(guide, &observed));
        let effort = Effort { simulations: Some(EFFORT) };
        Ok(Self { observed, tracker, planners, guide, gamma: settings.gamma, effort })
    }

    /// Watches the next row, and infers what explains the event so far with at most as much effort as
    /// [`Observer::set_effort`] says: intents that have become likely and cannot all be simulated at once are taken one after the
    /// other, the likeliest first, and have what the guide gives them until it is their turn.
    ///
    /// # Errors
    /// [`ObserverError::Row`] for numbers that are not finite; the row is then ignored. [`ObserverError::Search`].
    pub fn push(&mut self, row: [Body; MAX_ENTITIES]) -> Result<Inference, ObserverError> {
        self.watch(row)?;
        // Without a guide there is nothing to say of what is not simulated.
        let mut effort = if self.guide.is_some() { self.effort } else { Effort::UNLIMITED };
        let tick = &mut || ControlFlow::Continue(());
        let inference = weigh(&mut self.planners, self.gamma, self.guide.as_ref(), &mut effort, tick)?;
        Ok(inference.unwrap_or_else(|| unreachable!("not cancelled")))
    }

    /// Sets what [`Observer::push`] may spend on a row if the observer has a guide; without one it spends what it takes.
    pub const fn set_effort(&mut self, effort: Effort) {
        self.effort = effort;
    }

    /// Watches the next row without asking what explains it, which is left to the next [`Observer::inference`].
    ///
    /// # Errors
    /// [`ObserverError::Row`].
    pub fn watch(&mut self, row: [Body; MAX_ENTITIES]) -> Result<(), ObserverError> {
        Arc::make_mut(&mut self.observed).push(row)?;
        let unchanged = self.tracker.push(&self.observed)?;
        let motion = Arc::new(self.tracker.motion().clone());
        for (_, planner) in &mut self.planners {
            planner.prepared.follow(Arc::clone(&self.observed), Arc::clone(&motion), unchanged);
            planner.forget(unchanged);
        }
        if let Some(guide) = &mut self.guide {
            guide.push(&row);
        }
        Ok(())
    }

    /// What explains the event so far, with as much effort as it takes; `None` if `tick`, which is called once for each intent of each kind of minds, cancelled it.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub fn inference(
        &mut self,
        tick: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Option<Inference>, PomcpError> {
        weigh(&mut self.planners, self.gamma, self.guide.as_ref(), &mut Effort::UNLIMITED.clone(), tick)
    }

    /// What has been observed so far.
    #[must_use]
    pub fn observed(&self) -> &ObservedEvent {
        &self.observed
    }

    /// The event as prepared for the first kind of minds, such as for [`forecast()`](crate::forecast()).
    #[must_use]
    pub fn prepared(&self) -> Option<&PreparedEvent> {
        self.planners.first().map(|(_, planner)| &planner.prepared)
    }
}

/// One planner for each kind of minds, in the order of the settings.
pub(crate) fn planners(
    prepared: &PreparedEvent,
    planning: &InversePlanningSettings,
    alternative: Option<AlternativeMinds>,
) -> Vec<(MindParameters, InversePlanner)> {
    let mut planners = vec![(*prepared.minds(), InversePlanner::new(prepared.clone(), planning))];
    if let Some(AlternativeMinds { minds, lapse_rate }) = alternative {
        let planning = InversePlanningSettings { lapse_rate, ..*planning };
        planners.push((minds, InversePlanner::new(prepared.with_minds(minds), &planning)));
    }
    planners
}

/// The answer of all kinds of minds together, and how it came about. Intents that the effort does not suffice for are left to the
/// guide.
pub(crate) fn weigh(
    planners: &mut [(MindParameters, InversePlanner)],
    gamma: f64,
    guide: Option<&GuideCourse<'_>>,
    effort: &mut Effort,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Inference>, PomcpError> {
    let Some((_, first)) = planners.first() else { return Ok(Some(average(Vec::new(), None))) };
    let observed = Arc::clone(first.prepared.shared_observed());
    let objects = observed.object_sizes().len();
    let strengths = first.prepared.motion().strengths();
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
    for (_, planner) in &mut *planners {
        planner.follow();
    }
    if effort.simulations.is_some() {
        // Those for which every kind of minds knows what the others know.
        let mut ready = Vec::with_capacity(intents.len());
        for (agent, intent) in intents {
            let mut known = true;
            for (_, planner) in &mut *planners {
                known &= planner.catch_up(agent, intent, assumed[agent.other()], effort)?;
            }
            if known {
                ready.push((agent, intent));
            }
        }
        intents = ready;
    }
    let mut kinds = Vec::with_capacity(planners.len());
    for (minds, planner) in &mut *planners {
        let own = planner.weighted_hypotheses(&intents, assumed, last.as_ref(), effort, tick)?;
        let Some(own) = own else { return Ok(None) };
        kinds.push((*minds, own));
    }
    let (_, first) = &planners[0];
    let course = (1..=first.decisions()).map(|decisions| {
        let guess = guess(first.row_after(decisions));
        let of_kinds = planners.iter().map(|(_, planner)| planner.weighted_after(decisions, guess.as_ref()));
        Posterior::new(of_kinds.flatten())
    });
    let impression = Impression::of(&observed, course);
    Ok(Some(average(kinds, impression)))
}

//! An observer that watches an event row by row.

use crate::{
    Algorithm, AlternativeMinds, Guidance, Guide, Inference, InferenceSettings, InversePlanningSettings,
    Posterior,
    generative::PreparedEvent,
    guide::Guess,
    impression::Impression,
    inference::average,
    intent::WeightedIntents,
    intent_network::IntentReader,
    inverse_dynamics::MotionTracker,
    inverse_planning::InversePlanner,
};
use core::ops::ControlFlow;
use phase_event::{ObservedError, ObservedEvent};
use phase_minds::MindParameters;
use phase_model::{AGENT_COUNT, Body, MAX_ENTITIES, Strength};
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
/// Every answer is that of [`infer`](crate::infer) for the rows seen so far, bit for bit: what is learnt later about earlier steps
/// is taken back. A step takes a small part of the time that the whole takes at once.
#[derive(Debug)]
pub struct Observer<'a> {
    observed: Arc<ObservedEvent>,
    tracker: MotionTracker,
    planners: Vec<(MindParameters, InversePlanner)>,
    guide: Option<GuideCourse<'a>>,
    gamma: f64,
}

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
        Ok(Self { observed, tracker, planners, guide, gamma: settings.gamma })
    }

    /// Watches the next row, and infers what explains the event so far.
    ///
    /// # Errors
    /// [`ObserverError::Row`] for numbers that are not finite; the row is then ignored. [`ObserverError::Search`].
    pub fn push(&mut self, row: [Body; MAX_ENTITIES]) -> Result<Inference, ObserverError> {
        self.watch(row)?;
        Ok(self.inference(&mut || ControlFlow::Continue(()))?.unwrap_or_else(|| unreachable!("not cancelled")))
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

    /// What explains the event so far; `None` if `tick`, which is called once for each intent of each kind of minds, cancelled it.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub fn inference(
        &mut self,
        tick: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Option<Inference>, PomcpError> {
        weigh(&mut self.planners, self.gamma, self.guide.as_ref(), tick)
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

/// The answer of all kinds of minds together, and how it came about.
pub(crate) fn weigh(
    planners: &mut [(MindParameters, InversePlanner)],
    gamma: f64,
    guide: Option<&GuideCourse<'_>>,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Inference>, PomcpError> {
    let Some((_, first)) = planners.first() else { return Ok(Some(average(Vec::new(), None))) };
    let objects = first.prepared.observed().object_sizes().len();
    let strengths = first.prepared.motion().strengths();
    let guess = |row| guide.map(|guide| guide.guess(row, objects, strengths));
    let last = guess(first.prepared.observed().steps());
    let mut kinds = Vec::with_capacity(planners.len());
    for (minds, planner) in &mut *planners {
        let Some(own) = planner.weighted_hypotheses(gamma, last.as_ref(), tick)? else { return Ok(None) };
        kinds.push((*minds, own));
    }
    let (_, first) = &planners[0];
    let course = (1..=first.decisions()).map(|decisions| {
        let guess = guess(first.row_after(decisions));
        let of_kinds = planners.iter().map(|(_, planner)| planner.weighted_after(decisions, guess.as_ref()));
        Posterior::new(of_kinds.flatten())
    });
    let impression = Impression::of(first.prepared.observed(), course);
    Ok(Some(average(kinds, impression)))
}

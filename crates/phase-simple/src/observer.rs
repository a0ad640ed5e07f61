//! An observer that watches an event row by row.

use crate::{
    Algorithm, Budget, Guide, InferenceSettings,
    answer::Inference,
    generative::PreparedEvent,
    inverse_dynamics::MotionTracker,
    kinds::{GuideCourse, Planners},
};
use core::ops::ControlFlow;
use phase_event::{ObservedError, ObservedEvent};
use phase_model::{Body, MAX_ENTITIES, setting::RangeError};
use phase_pomcp::PomcpError;
use std::sync::Arc;
use thiserror::Error;

/// Why an event cannot be watched row by row.
#[derive(Debug, Error)]
pub enum ObserverError {
    /// Algorithm 2 simulates whole events.
    #[error("only inverse planning can watch an event row by row, not the chains of Algorithm 2")]
    Chains,
    /// A setting is out of its range.
    #[error(transparent)]
    Settings(#[from] RangeError),
    /// A row that is no observation.
    #[error("the next row cannot be observed: {0}")]
    Row(#[from] ObservedError),
    /// Invalid parameters of the agents' search.
    #[error("the minds cannot be simulated")]
    Search(#[from] PomcpError),
}

/// Watches an event row by row, and infers after each row what explains it.
///
/// ```
/// use phase_event::ObservedEvent;
/// use phase_model::{Body, Layout, Size, Vec2};
/// use phase_simple::{Budget, Simple};
///
/// let row = |x| {
///     let places = [Vec2::new(x, 6.0), Vec2::new(8.5, 19.5), Vec2::ZERO, Vec2::ZERO];
///     places.map(|place| Body::at_rest(place, 0.0))
/// };
/// let start = ObservedEvent::new(Layout::new(0, None)?, [Size::Small; 2], Vec::new(), vec![row(23.5)])?;
/// let mut observer = Simple::bundled()?.observer(&start, 1)?;
/// observer.set_budget(Budget { decisions: Some(1) });
/// let inference = observer.push(row(23.4))?;
/// assert!((inference.posterior.hypotheses.iter().map(|(_, p)| p).sum::<f64>() - 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Conclusions about earlier steps are taken back where later ones contradict them, so
/// [`Observer::inference`] gives the answer of [`infer`](crate::infer) for the rows seen so far, bit for bit.
/// [`Observer::push`] gives the same within a budget, so that an event can be watched as it happens; the two
/// differ while intents that have just become likely are being simulated.
#[derive(Debug)]
pub struct Observer {
    observed: Arc<ObservedEvent>,
    tracker: MotionTracker,
    planners: Planners,
    guide: Option<GuideCourse>,
    gamma: f64,
    budget: Budget,
}

/// Decisions that an observer spends on a row by default: less than the 250 ms that a step lasts in a video.
/// A decision takes about a millisecond (docs/results/performance.md).
const BUDGET: usize = 20;

impl Observer {
    /// Watches an event from its beginning: `observed` has the rows seen so far, at least one.
    ///
    /// # Errors
    /// [`ObserverError::Chains`] unless the settings are those of inverse planning, and
    /// [`ObserverError::Settings`].
    pub fn new(
        observed: &ObservedEvent,
        guide: Option<&Guide>,
        seed: u64,
        settings: &InferenceSettings,
    ) -> Result<Self, ObserverError> {
        let Algorithm::InversePlanning(planning) = settings.algorithm else {
            return Err(ObserverError::Chains);
        };
        settings.validate()?;
        let tracker = MotionTracker::new(observed);
        let observed = Arc::new(observed.clone());
        let motion = Arc::new(tracker.motion().clone());
        let prepared = PreparedEvent::with_motion(Arc::clone(&observed), motion, settings.agents, seed);
        let planners = Planners::new(&prepared, &planning, settings);
        let guide = guide.map(|guide| GuideCourse::new(guide, &observed));
        let budget = Budget { decisions: Some(BUDGET) };
        Ok(Self { observed, tracker, planners, guide, gamma: settings.gamma, budget })
    }

    /// Watches the next row, and infers what explains the event so far with no more decisions than
    /// [`Observer::set_budget`] says: intents that have become likely and cannot all be simulated at once are
    /// taken one after the other, the likeliest first, and have what the guide gives them until it is their
    /// turn.
    ///
    /// # Errors
    /// [`ObserverError::Row`] for numbers that are not finite; the row is then ignored.
    /// [`ObserverError::Search`].
    pub fn push(&mut self, row: [Body; MAX_ENTITIES]) -> Result<Inference, ObserverError> {
        self.watch(row)?;
        // Without a guide there is nothing to say of what is not simulated.
        let mut budget = if self.guide.is_some() { self.budget } else { Budget::UNLIMITED };
        let tick = &mut || ControlFlow::Continue(());
        let inference = self.planners.weigh(self.gamma, self.guide.as_mut(), &mut budget, tick)?;
        Ok(inference.unwrap_or_else(|| unreachable!("not cancelled")))
    }

    /// Sets what [`Observer::push`] may spend on a row if the observer has a guide; without one it spends
    /// what it takes.
    pub const fn set_budget(&mut self, budget: Budget) {
        self.budget = budget;
    }

    /// Watches the next row without asking what explains it, which is left to the next
    /// [`Observer::inference`].
    ///
    /// # Errors
    /// [`ObserverError::Row`].
    pub fn watch(&mut self, row: [Body; MAX_ENTITIES]) -> Result<(), ObserverError> {
        Arc::make_mut(&mut self.observed).push(row)?;
        let unchanged = self.tracker.push(&self.observed)?;
        let motion = Arc::new(self.tracker.motion().clone());
        for planner in &mut self.planners.planners {
            planner.prepared.follow(Arc::clone(&self.observed), Arc::clone(&motion), unchanged);
            planner.forget(unchanged);
        }
        if let Some(guide) = &mut self.guide {
            guide.push(&row);
        }
        Ok(())
    }

    /// Infers what explains the event so far, with as many decisions as it takes; `None` if `tick`, which is
    /// called once for each intent of each kind of minds, cancelled it.
    ///
    /// # Errors
    /// Invalid parameters of the agents' search.
    pub fn inference(
        &mut self,
        tick: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Option<Inference>, PomcpError> {
        self.planners.weigh(self.gamma, self.guide.as_mut(), &mut Budget::UNLIMITED.clone(), tick)
    }

    /// The part of the event that has been observed so far.
    #[must_use]
    pub fn observed(&self) -> &ObservedEvent {
        &self.observed
    }

    /// The event as prepared for the first kind of minds, such as for [`futures`](crate::futures).
    #[must_use]
    pub fn prepared(&self) -> Option<&PreparedEvent> {
        self.planners.planners.first().map(|planner| &planner.prepared)
    }
}

//! One attempt at a slot: its scenes, the simulations that it takes, and their judgement.
//!
//! An attempt depends on the dataset's seed, the slot and the attempt's number alone, and its judgement on
//! its simulations, whoever runs them when. Where several events are simulated, or compared with what happens
//! while an agent is idle, the first in order that fails is the reason for rejection.

use super::schedule::{Need, Part};
use core::ops::ControlFlow;
use phase_dataset::acceptance::Refusal;
use phase_event::Event;
use phase_evidence::{
    Track,
    selection::{Counterfactual, RejectionReason, possibly_idle, with_neutral},
};
use phase_model::{AgentId, Scene};
use phase_sampler::{Stance, Variant};
use phase_sim::SimulationSettings;
use std::{
    collections::BTreeMap,
    sync::{
        Mutex, MutexGuard, OnceLock, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
};

/// The scenes of an attempt.
#[derive(Debug)]
pub(super) struct Cast {
    pub(super) seed: u64,
    /// The agent whose stance differs, in a set.
    pub(super) changed: Option<AgentId>,
    /// One for each event.
    pub(super) members: Vec<CastMember>,
    /// Whether events are compared with what happens while an agent is idle.
    pub(super) compared: bool,
}

/// A scene to be simulated.
#[derive(Debug)]
pub(super) struct CastMember {
    /// The stance of the changed agent, in a set.
    pub(super) stance: Option<Stance>,
    pub(super) variant: Variant,
    pub(super) scene: Scene,
    pub(super) settings: SimulationSettings,
}

/// An event that has passed the tests on itself, and the comparison that it needs.
#[derive(Debug)]
pub(super) struct Member {
    pub(super) event: Event,
    pub(super) track: Track,
    pub(super) counterfactual: Option<Counterfactual>,
}

/// Judgement of an attempt, from the simulations so far.
#[derive(Debug)]
pub(super) enum Judgement {
    /// It takes further simulations; see [`super::schedule::Standing::Needs`].
    Needs(Vec<Need>),
    Refused(Refusal),
    Accepted,
}

/// An attempt that has been begun.
#[derive(Debug, Default)]
pub(super) struct Attempt {
    abandoned: AtomicBool,
    cast: OnceLock<Cast>,
    results: Mutex<Results>,
}

/// The simulations so far.
#[derive(Debug, Default)]
pub(super) struct Results {
    members: BTreeMap<usize, Result<Member, RejectionReason>>,
    idle: BTreeMap<(usize, AgentId), Track>,
}

impl Attempt {
    /// Nothing that it results in is wanted any longer.
    pub(super) fn abandon(&self) {
        self.abandoned.store(true, Ordering::Relaxed);
    }

    pub(super) fn is_abandoned(&self) -> bool {
        self.abandoned.load(Ordering::Relaxed)
    }

    /// To be asked after every step of a simulation.
    pub(super) fn goes_on(&self, interrupted: bool) -> ControlFlow<()> {
        if interrupted || self.is_abandoned() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// The scenes, once they have been drawn.
    pub(super) fn cast(&self) -> Option<&Cast> {
        self.cast.get()
    }

    /// Stores the scenes. There is one thread that draws them.
    pub(super) fn set_cast(&self, cast: Cast) {
        let _ = self.cast.set(cast);
    }

    pub(super) fn results(&self) -> MutexGuard<'_, Results> {
        self.results.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Cast {
    /// The scene and the settings of a simulation.
    pub(super) fn simulation(&self, part: Part) -> Option<(Scene, SimulationSettings)> {
        match part {
            Part::Member(k) => {
                let member = self.members.get(k)?;
                Some((member.scene.clone(), member.settings))
            }
            Part::Idle { member, agent } => {
                let member = self.members.get(member)?;
                let settings = SimulationSettings { idle: Some(agent), ..member.settings };
                Some((with_neutral(&member.scene, agent), settings))
            }
        }
    }

    /// Agents that may have to be idle, with the event and the chance of each; where that is not known
    /// yet, whatever is possible.
    fn comparisons(&self, results: &Results) -> Vec<Need> {
        let mut comparisons: Vec<Need> = Vec::new();
        for (member, cast) in self.members.iter().enumerate().filter(|_| self.compared) {
            let agents = match results.members.get(&member) {
                Some(Ok(member)) => member.counterfactual.map(|it| it.idle).into_iter().collect(),
                Some(Err(_)) => Vec::new(),
                None => possibly_idle(&cast.scene),
            };
            let share = 1.0 / agents.len().max(1) as f64;
            for agent in agents {
                // Where the changed agent does nothing, its stance makes no difference: one simulation serves
                // all comparisons with it.
                let served =
                    |need: &Need| matches!(need.part, Part::Idle { agent: other, .. } if other == agent);
                if !comparisons.iter().any(served) {
                    comparisons.push(Need { part: Part::Idle { member, agent }, share });
                }
            }
        }
        comparisons
    }
}

impl Results {
    /// Stores an event, or why it was rejected.
    pub(super) fn add_member(&mut self, number: usize, member: Result<Member, RejectionReason>) {
        self.members.insert(number, member);
    }

    /// Stores what happens while an agent is idle.
    pub(super) fn add_idle(&mut self, member: usize, agent: AgentId, track: Track) {
        self.idle.insert((member, agent), track);
    }

    /// The events of an accepted attempt, in order.
    pub(super) fn take_events(&mut self) -> Vec<Event> {
        core::mem::take(&mut self.members).into_values().flatten().map(|member| member.event).collect()
    }

    /// Number of events that have passed the tests on themselves, and the judgement of the attempt.
    pub(super) fn judge(&self, cast: &Cast) -> (usize, Judgement) {
        let refused =
            |k: usize, reason| Judgement::Refused(Refusal { variant: cast.members[k].variant, reason });
        let mut needs = Vec::new();
        for k in 0..cast.members.len() {
            match self.members.get(&k) {
                None => needs.push(Need { part: Part::Member(k), share: 1.0 }),
                Some(Ok(_)) => {}
                Some(&Err(reason)) if needs.is_empty() => return (k, refused(k, reason)),
                // It is refused, but one before it may give another reason.
                Some(Err(_)) => return (self.passed(), Judgement::Needs(needs)),
            }
        }
        let comparisons = cast.comparisons(self);
        let missing = comparisons.iter().filter(|need| self.idle_of(need.part).is_none());
        if !needs.is_empty() {
            needs.extend(missing);
            return (self.passed(), Judgement::Needs(needs));
        }
        for (k, member) in &self.members {
            let Ok(member) = member else { continue };
            let Some(counterfactual) = member.counterfactual else { continue };
            let serves =
                |need: &&Need| matches!(need.part, Part::Idle { agent, .. } if agent == counterfactual.idle);
            let without = comparisons.iter().find(serves).and_then(|need| self.idle_of(need.part));
            let Some(without) = without else {
                return (self.members.len(), Judgement::Needs(missing.copied().collect()));
            };
            if let Err(reason) = counterfactual.judge(&member.event.scene, &member.track, without) {
                return (self.members.len(), refused(*k, reason));
            }
        }
        (self.members.len(), Judgement::Accepted)
    }

    /// Number of events, counted from the first without a gap, that have passed the tests on themselves.
    fn passed(&self) -> usize {
        let passes = |k: &usize| self.members.get(k).is_some_and(Result::is_ok);
        (0..self.members.len()).take_while(passes).count()
    }

    fn idle_of(&self, part: Part) -> Option<&Track> {
        match part {
            Part::Idle { member, agent } => self.idle.get(&(member, agent)),
            Part::Member(_) => None,
        }
    }
}

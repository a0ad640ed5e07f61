//! Whether an event shows its label: whether the intended social event is visible.
//!
//! [`check_event`] applies every test that needs the event alone: its length, its end, whether the goals can
//! be recognised in it, and what its kind requires to be seen. Where the label concerns the effect of one
//! agent on the other, it names the [`Counterfactual`] that is still to be simulated: the same scene and seed
//! with that agent neutral and idle, which is as expensive as the event itself and therefore comes last.

mod common;
mod drawn;
mod kinds;
mod limits;

use crate::{Discovery, Effect, GoalOutcome, Manner, Track, contact};
use core::ops::RangeInclusive;
use phase_event::Event;
use phase_model::{AgentId, Attitude, Entity, Goal, Scene, Sign};
use serde::{Deserialize, Serialize};

pub use kinds::decisive_agent;
pub use limits::{Limit, Quantity};

/// Minimum duration for something to be seen (steps): three quarters of a second of video.
pub const MIN_VISIBLE_STEPS: usize = 3;
/// Steps at the end of an event over which nothing may move, where everything has to come to rest: a second
/// of video.
pub const FINAL_REST_STEPS: usize = 4;

/// The reason why an event does not show its label.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RejectionReason {
    /// It ends before the minimum length.
    TooShort,
    /// It exceeds the maximum length.
    TooLong,
    /// Something still moves or is still held at the end of a non-adversarial event.
    Restless,
    /// A goal that must be reached for the label was missed.
    GoalMissed,
    /// A goal was reached before its pursuit was visible.
    TooSoon,
    /// An agent did nothing that would reveal its goal.
    Aimless,
    /// The social agent had nothing to do with the other or with the other's goal.
    NoContact,
    /// Two agents with the same goal did not pursue it together.
    NotTogether,
    /// Two agents that compete for an object did not both reach it, or it had no result.
    Uncontested,
    /// No pursuit was seen.
    NoPursuit,
    /// No evasion was seen.
    NoFlight,
    /// Independent agents interfered with each other.
    Interference,
    /// Nothing moves for most of the time, or everything stays in its place for 6 s.
    Lifeless,
    /// Both agents hold on to an object and get nowhere, for too long or at the end.
    Knotted,
    /// A hinderer seems to help.
    Misleading,
    /// An agent did not come closer to its goal.
    NoProgress,
    /// Motion does not show which landmark an agent wants its goal's subject on.
    Unshown,
    /// The manner of helping, hindering or meeting that the variant is about was not seen.
    OtherManner,
    /// The object is still in the room where it was at the start when the agent that waited acts, or that
    /// agent has seen it or its place meanwhile.
    Unmoved,
    /// The agent that waited did not go where it believes the object to be, or did not look there first.
    Unsearched,
    /// A helper or hinderer that has to find out the other's goal hardly acted on the right one.
    Mistaken,
    /// Without the agent that is to make a difference the result would have been the same.
    NoEffect,
}

impl RejectionReason {
    /// All reasons, in the order in which they are checked.
    pub const ALL: [Self; 22] = [
        Self::TooShort,
        Self::TooLong,
        Self::Restless,
        Self::GoalMissed,
        Self::TooSoon,
        Self::Aimless,
        Self::NoContact,
        Self::NotTogether,
        Self::Uncontested,
        Self::NoPursuit,
        Self::NoFlight,
        Self::Interference,
        Self::Lifeless,
        Self::Knotted,
        Self::Misleading,
        Self::NoProgress,
        Self::Unshown,
        Self::OtherManner,
        Self::Unmoved,
        Self::Unsearched,
        Self::Mistaken,
        Self::NoEffect,
    ];

    /// The name used in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::TooShort => "too-short",
            Self::TooLong => "too-long",
            Self::Restless => "restless",
            Self::GoalMissed => "goal-missed",
            Self::TooSoon => "too-soon",
            Self::Aimless => "aimless",
            Self::NoContact => "no-contact",
            Self::NotTogether => "not-together",
            Self::Uncontested => "uncontested",
            Self::NoPursuit => "no-pursuit",
            Self::NoFlight => "no-flight",
            Self::Interference => "interference",
            Self::Lifeless => "lifeless",
            Self::Knotted => "knotted",
            Self::Misleading => "misleading",
            Self::NoProgress => "no-progress",
            Self::Unshown => "unshown",
            Self::OtherManner => "other-manner",
            Self::Unmoved => "unmoved",
            Self::Unsearched => "unsearched",
            Self::Mistaken => "mistaken",
            Self::NoEffect => "no-effect",
        }
    }
}

/// The effect that an agent is to have had on the other's goal.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum CausalEffect {
    /// Reached only thanks to it, or at least a tenth sooner.
    Helped,
    /// Missed because of it, or reached at least a tenth later; or, for touching, kept up from the first
    /// touch on for at most half as much of the time.
    Hindered,
}

/// A comparison with the same event in which one agent does nothing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Counterfactual {
    /// The agent that is to do nothing: `idle` of the simulation's settings.
    pub idle: AgentId,
    /// The agent whose goal is compared.
    pub judged: AgentId,
    /// The required result.
    pub change: CausalEffect,
    /// Whether the event may have been cut before the outcome; then it counts, too, how far the goal's
    /// subject still has to go.
    pub cut: bool,
}

impl Counterfactual {
    /// The scene to simulate, with the event's own seed: the idle agent is neutral.
    #[must_use]
    pub fn scene(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        scene.agents[self.idle].attitude = Attitude::Neutral;
        scene
    }

    /// Compares the event with the one in which the agent did nothing. Goals are the event's own.
    ///
    /// # Errors
    /// [`RejectionReason::NoEffect`].
    pub fn judge(&self, scene: &Scene, event: &Track, without: &Track) -> Result<(), RejectionReason> {
        let goal = scene.agents[self.judged].goal;
        let effect = Effect { with: GoalOutcome::of(event, goal), without: GoalOutcome::of(without, goal) };
        let [nearer, farther] = [(event, without), (without, event)]
            .map(|(one, other)| self.cut && remaining(goal, one) + MIN_DIFFERENCE <= remaining(goal, other));
        let shown = match self.change {
            CausalEffect::Helped => effect.helped() || nearer,
            CausalEffect::Hindered => effect.hindered() || farther || escapes(goal, event, without),
        };
        if shown { Ok(()) } else { Err(RejectionReason::NoEffect) }
    }
}

/// Least difference that an agent must make to the place of the goal's subject at the end (u).
const MIN_DIFFERENCE: f32 = 2.0;

/// The rule by which events end, and therefore what may be required of them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Ending {
    /// Once everything is settled; an adversarial event may end earlier.
    Settled,
    /// At a sampled step, before or after the outcome.
    Drawn {
        /// The manner that has to be seen, if any.
        manner: Option<Manner>,
    },
}

/// Everything that can be checked on an event alone; `lengths` are those allowed (steps). `Ok(None)` means
/// that it shows its label.
///
/// # Errors
/// The first reason for rejection.
pub fn check_event(
    scene: &Scene,
    track: &Track,
    lengths: RangeInclusive<usize>,
    ending: Ending,
) -> Result<Option<Counterfactual>, RejectionReason> {
    let steps = track.steps();
    if steps < *lengths.start() {
        return Err(RejectionReason::TooShort);
    }
    if steps > *lengths.end() {
        return Err(RejectionReason::TooLong);
    }
    match ending {
        Ending::Settled => {
            common::check_rest_at_end(scene, track)?;
            kinds::judge(scene, track)
        }
        Ending::Drawn { manner } => drawn::judge(scene, track, manner),
    }
}

/// Checks that a helper or hinderer that has to find out the other's goal acts on the right one.
///
/// # Errors
/// [`RejectionReason::Mistaken`].
pub fn check_discovery(event: &Event) -> Result<(), RejectionReason> {
    let finds = Discovery::of(event).is_none_or(|discovery| discovery.succeeds());
    if finds { Ok(()) } else { Err(RejectionReason::Mistaken) }
}

/// A reason for which [`check_event`] will reject every event that begins with this track and has one of the
/// allowed lengths, where that is certain already; `None` where it is not. Asked after every step, it finds
/// the first such step. The rest of the event need not be simulated.
#[must_use]
pub fn certain_rejection(
    scene: &Scene,
    track: &Track,
    lengths: RangeInclusive<usize>,
    ending: Ending,
) -> Option<RejectionReason> {
    let Ending::Drawn { .. } = ending else { return None };
    if drawn::is_lifeless_however_it_goes_on(track, *lengths.end()) {
        return Some(RejectionReason::Lifeless);
    }
    drawn::is_searched_in_vain(scene, track)
}

/// Distance of the goal's subject from the goal at the end (u); infinite for tracks without states.
fn remaining(goal: Goal, track: &Track) -> f32 {
    let positive = if goal.sign() == Sign::Positive { goal } else { goal.negated() };
    track.states.last().map_or(f32::INFINITY, |state| positive.distance(state))
}

/// Whether the touched agent escapes again: a chase with a catch and an escape still counts.
fn escapes(goal: Goal, event: &Track, without: &Track) -> bool {
    if !matches!(goal, Goal::Touch { sign: Sign::Positive, .. }) {
        return false;
    }
    let [(held, left), (held_without, left_without)] = [event, without].map(|track| {
        let touches =
            contact::steps_touching(track, Entity::Agent(AgentId::ZERO), Entity::Agent(AgentId::ONE));
        (touches.len(), touches.first().map_or(0, |first| track.states.len() - first))
    });
    held > 0 && 2 * held * left_without <= held_without * left
}

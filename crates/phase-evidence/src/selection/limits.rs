//! The quantities that selection limits in events that end at a drawn step, and their limits.

use super::{common::object_of, drawn};
use crate::{Clarity, Track, clarity, contest, manner, rest};
use phase_model::{EventKind, Scene};
use phase_predicates::lead::MIN_LANDMARK_LEAD;

/// A limit of a quantity, which is itself allowed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Limit {
    /// No less than this.
    AtLeast(f32),
    /// No more than this.
    AtMost(f32),
}

impl Limit {
    /// Whether a value is within the limit.
    #[must_use]
    pub fn keeps(self, value: f32) -> bool {
        match self {
            Self::AtLeast(least) => value >= least,
            Self::AtMost(most) => value <= most,
        }
    }
}

/// A quantity of an event that selection limits and that trajectories alone give, so that recordings have it,
/// too.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Quantity {
    /// Share of the steps in which nothing moves.
    Still,
    /// Longest time for which every body stays in its place (steps).
    Standstill,
    /// Share of the steps in [knots](Clarity::knotted).
    Knotted,
    /// Duration of the knot that the event ends in (steps).
    KnotAtEnd,
    /// Time for which the agent that is helped, or whose object is hindered, is seen to try (steps).
    Trying,
    /// Least distance by which a competitor gets the object its way (u).
    Favour,
    /// Least lead by which motion [shows the landmark](clarity::landmark_shown) of an agent's goal (u).
    Shown,
}

impl Quantity {
    /// All quantities.
    pub const ALL: [Self; 7] = [
        Self::Still,
        Self::Standstill,
        Self::Knotted,
        Self::KnotAtEnd,
        Self::Trying,
        Self::Favour,
        Self::Shown,
    ];

    /// Its name, with the unit at the end.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Still => "still_share",
            Self::Standstill => "standstill_steps",
            Self::Knotted => "knotted_share",
            Self::KnotAtEnd => "knot_at_end_steps",
            Self::Trying => "trying_steps",
            Self::Favour => "favour_u",
            Self::Shown => "shown_u",
        }
    }

    /// The limit within which events are selected.
    #[must_use]
    pub fn limit(self) -> Limit {
        match self {
            Self::Still => Limit::AtMost(drawn::MAX_STILL_PERCENT as f32 / 100.0),
            Self::Standstill => Limit::AtMost((drawn::MAX_STANDSTILL - 1) as f32),
            Self::Knotted => Limit::AtMost(drawn::MAX_KNOTTED as f32),
            Self::KnotAtEnd => Limit::AtMost(0.0),
            Self::Trying => Limit::AtLeast(drawn::MIN_ATTEMPT as f32),
            Self::Favour => Limit::AtLeast(drawn::MIN_FAVOUR),
            Self::Shown => Limit::AtLeast(MIN_LANDMARK_LEAD),
        }
    }

    /// Its value in an event; `None` where selection does not limit it, and in an event without steps.
    #[must_use]
    pub fn of(self, scene: &Scene, track: &Track) -> Option<f32> {
        let steps = track.steps();
        let clarity = Clarity::of(scene, track)?;
        match self {
            Self::Still => {
                let still = (1..=steps).filter(|&step| rest::is_still(track, step)).count();
                Some(still as f32 / steps as f32)
            }
            Self::Standstill => {
                (0..steps).map(|from| drawn::standstill(track, from)).max().map(|steps| steps as f32)
            }
            Self::Knotted => Some(clarity.knotted as f32),
            Self::KnotAtEnd => Some(clarity.knot_at_end as f32),
            Self::Trying => {
                let served = || manner::social_agent(scene).other();
                let who = match scene.kind {
                    EventKind::Helping => served(),
                    EventKind::Hindering if object_of(scene.agents[served()].goal).is_some() => served(),
                    _ => return None,
                };
                Some(clarity::steps_trying(track, who, scene.agents[who].goal) as f32)
            }
            Self::Favour => {
                let about_objects = scene.goals().into_iter().all(|goal| object_of(goal).is_some());
                let favours = || contest::favours(track, scene.goals()).into_iter();
                (scene.kind == EventKind::Competing && about_objects)
                    .then(|| favours().fold(f32::INFINITY, f32::min))
            }
            Self::Shown => clarity.shown.into_iter().flatten().reduce(f64::min).map(|lead| lead as f32),
        }
    }
}

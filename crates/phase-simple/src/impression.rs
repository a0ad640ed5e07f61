//! Impressions of an event while it is watched, from which people's reports are predicted.
//!
//! A posterior at the end of an event says what is true given all of the motion. People's reports also carry
//! what they thought on the way there and what they could see happen between the two: of help from a distance
//! many say that nothing went on. The impression therefore holds the posterior of what goes on averaged over
//! the time watched, and how much the two had to do with each other. [`ReportModel`](crate::ReportModel)
//! predicts reports from it.

use crate::Hypothesis;
use phase_event::ObservedEvent;
use phase_model::{AgentId, Attitude, Body, Entity, Goal, MAX_ENTITIES, ObjectId, Relation};
use serde::{Deserialize, Serialize};

/// Number of things that can go on between two agents ([`Happening`]).
pub(crate) const HAPPENINGS: usize = Happening::ALL.len();

/// Outlines that are closer than this are in contact (u).
const CONTACT: f32 = 0.3;
/// Agents whose outlines are closer than this are near each other (u): about the size of two agents.
const NEAR: f32 = 2.0;

/// Things that can go on between two agents under a hypothesis, as far as people tell them apart.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Happening {
    /// One helps the other.
    Help,
    /// One hinders the other.
    Hindrance,
    /// Both pursue the same goal.
    SharedGoal,
    /// Both want an object in different places.
    Competition,
    /// One wants to touch the other, which wants to get away.
    Chase,
    /// Neither has to do with the other.
    Nothing,
}

impl Happening {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Help, Self::Hindrance, Self::SharedGoal, Self::Competition, Self::Chase, Self::Nothing];

    /// The thing that goes on if a hypothesis is true.
    #[must_use]
    pub fn of(hypothesis: &Hypothesis) -> Self {
        let social = hypothesis.attitudes.into_iter().find(|attitude| *attitude != Attitude::Neutral);
        let touches = hypothesis.goals.iter().any(|goal| matches!(goal, Goal::Touch { .. }));
        match (social, hypothesis.relation()) {
            (Some(Attitude::Help), _) => Self::Help,
            (Some(_), _) => Self::Hindrance,
            (None, Relation::Friendly) => Self::SharedGoal,
            (None, Relation::Adversarial) if touches => Self::Chase,
            (None, Relation::Adversarial) => Self::Competition,
            (None, Relation::Neutral) => Self::Nothing,
        }
    }
}

/// The probability of each happening.
pub(crate) type Happenings = [f64; HAPPENINGS];

/// The probability of each happening, from hypotheses with their weights; weights need not sum to 1. Of an
/// event in which no landmark was seen only goals elsewhere can be judged
/// ([`Posterior::judged`](crate::Posterior::judged)).
pub(crate) fn happenings(
    observed: &ObservedEvent,
    hypotheses: impl Iterator<Item = (Hypothesis, f64)>,
) -> Happenings {
    let [mut all, mut elsewhere] = [[0.0; HAPPENINGS]; 2];
    for (hypothesis, weight) in hypotheses {
        let happening = Happening::of(&hypothesis) as usize;
        all[happening] += weight;
        if hypothesis.is_elsewhere() {
            elsewhere[happening] += weight;
        }
    }
    let judged = if observed.missing().landmarks && elsewhere != [0.0; HAPPENINGS] { elsewhere } else { all };
    let sum: f64 = judged.iter().sum();
    if sum > 0.0 { judged.map(|weight| weight / sum) } else { judged }
}

/// The extent to which two agents had to do with each other: shares of the time watched, 0 to 1.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Interaction {
    /// Share in which they were near each other.
    pub near: f64,
    /// The geometric mean of the shares in which either touched an object, of the object for which it is
    /// greatest.
    pub shared_object: f64,
}

impl Interaction {
    /// The interaction in the rows that were observed.
    #[must_use]
    pub fn of(observed: &ObservedEvent) -> Self {
        let physics = observed.physics([0.0; 2]);
        let radius = |entity: Entity| match entity {
            Entity::Agent(agent) => physics.agents[agent].radius,
            Entity::Object(object) => physics.object_radii[object],
        };
        let gap = |row: &[Body; MAX_ENTITIES], a: Entity, b: Entity| {
            row[a].position.distance(row[b].position) - radius(a) - radius(b)
        };
        let share = |holds: &dyn Fn(&[Body; MAX_ENTITIES]) -> bool| {
            let rows = observed.rows();
            rows.iter().filter(|row| holds(row)).count() as f64 / rows.len() as f64
        };
        let [one, other] = AgentId::ALL.map(Entity::Agent);
        let objects = ObjectId::ALL.into_iter().take(observed.object_sizes().len()).map(Entity::Object);
        let at = |agent, object| share(&|row| gap(row, agent, object) < CONTACT);
        let shared = |object| libm::sqrt(at(one, object) * at(other, object));
        Self {
            near: share(&|row| gap(row, one, other) < NEAR),
            shared_object: objects.map(shared).fold(0.0, f64::max),
        }
    }

    /// The extent to which they had to do with each other in either way.
    #[must_use]
    pub fn involvement(&self) -> f64 {
        self.near.max(self.shared_object)
    }
}

/// The impression that an event made while it was watched.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Impression {
    /// P([`Happening`] | motion so far), averaged over the time watched; they sum to 1.
    pub happenings: [f64; HAPPENINGS],
    /// The extent to which the two had to do with each other.
    pub interaction: Interaction,
}

impl Impression {
    /// The mean over evenly spaced times of how likely each happening was; `None` without any.
    pub(crate) fn of(observed: &ObservedEvent, course: impl IntoIterator<Item = Happenings>) -> Option<Self> {
        let mut happenings = [0.0; HAPPENINGS];
        let mut times = 0_usize;
        for likely in course {
            times += 1;
            happenings.iter_mut().zip(likely).for_each(|(sum, likely)| *sum += likely);
        }
        (times > 0).then(|| Self {
            happenings: happenings.map(|sum| sum / times as f64),
            interaction: Interaction::of(observed),
        })
    }
}

//! Whether and when an agent's goal was reached.

use crate::{Track, contact};
use phase_model::{Entity, Goal, LandmarkId, PhysicsConfig, Sign, State, arena};
use phase_predicates::threshold::{ON_AGENT, ON_OBJECT};
use serde::{Deserialize, Serialize};

/// The outcome of one agent's goal.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GoalOutcome {
    /// Whether it was reached. Goals of being (or keeping another) somewhere are evaluated at the end of the
    /// event, touching at any time, and getting away from another again at the end.
    pub reached: bool,
    /// Steps until a positive goal was reached permanently, or for the first time for touch goals.
    pub steps: Option<usize>,
}

impl GoalOutcome {
    /// Judges a goal on the states of a track, using bodies alone: contacts and grips, which recordings lack,
    /// are not used for simulations either.
    #[must_use]
    pub fn of(track: &Track, goal: Goal) -> Self {
        let holds: Vec<bool> =
            track.states.iter().map(|state| condition(&track.physics, state, goal)).collect();
        let at_the_end = holds.last().copied().unwrap_or(false);
        match (goal, goal.sign()) {
            (_, Sign::Negative) => Self { reached: !at_the_end, steps: None },
            (Goal::Touch { .. }, Sign::Positive) => {
                let first = holds.iter().position(|&holds| holds);
                Self { reached: first.is_some(), steps: first }
            }
            (_, Sign::Positive) => {
                let since = holds.iter().rposition(|&holds| !holds).map_or(0, |last_not| last_not + 1);
                Self { reached: at_the_end, steps: at_the_end.then_some(since) }
            }
        }
    }
}

/// Whether the condition of the goal holds, whatever the goal's sign.
#[must_use]
pub fn condition(physics: &PhysicsConfig, state: &State, goal: Goal) -> bool {
    match goal {
        Goal::AgentOnLandmark { agent, landmark, .. } => is_on(state, Entity::Agent(agent), landmark),
        Goal::ObjectOnLandmark { object, landmark, .. } => is_on(state, Entity::Object(object), landmark),
        Goal::Touch { agent, other, .. } => {
            contact::near(physics, state, Entity::Agent(agent), Entity::Agent(other))
        }
    }
}

/// Whether an entity is on a landmark.
#[must_use]
pub fn is_on(state: &State, entity: Entity, landmark: LandmarkId) -> bool {
    let limit = match entity {
        Entity::Agent(_) => ON_AGENT,
        Entity::Object(_) => ON_OBJECT,
    };
    state.position(entity).distance(arena::LANDMARKS[landmark]) < limit
}

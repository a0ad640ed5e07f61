//! The four predicates and their negations, with their textual form.

use crate::{AgentId, Entity, Goal, LandmarkId, ObjectId, Sign};
use core::fmt;
use serde::{Deserialize, Serialize};

/// Something an entity can be close to.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PredicateTarget {
    /// An agent or object.
    Entity(Entity),
    /// A landmark.
    Landmark(LandmarkId),
}

/// A predicate of the paper's table of definitions, with its arguments.
///
/// It is a name without a truth value; the crate `phase-predicates` evaluates it in a state. Its text, such
/// as `On(object 0, landmark 1)`, is that of files and pages.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Predicate {
    /// An agent or object is on a landmark.
    On(Entity, LandmarkId),
    /// An agent touches another agent or an object.
    Touch(AgentId, Entity),
    /// An object is attached to an agent's body.
    Attach(AgentId, ObjectId),
    /// An agent or object is near something; near a landmark means in the landmark's room.
    Close(Entity, PredicateTarget),
}

/// A predicate or its negation: the form of subgoals, and of goals by `From`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub struct Literal {
    /// The predicate.
    pub predicate: Predicate,
    /// Whether the predicate has to hold (`true`) or not to hold.
    pub holds: bool,
}

impl Literal {
    /// The predicate itself.
    #[must_use]
    pub const fn is(predicate: Predicate) -> Self {
        Self { predicate, holds: true }
    }

    /// The predicate's negation.
    #[must_use]
    pub const fn not(predicate: Predicate) -> Self {
        Self { predicate, holds: false }
    }
}

impl From<Goal> for Literal {
    /// The final goal state as a predicate or its negation.
    fn from(goal: Goal) -> Self {
        let predicate = match goal {
            Goal::AgentOnLandmark { agent, landmark, .. } => Predicate::On(Entity::Agent(agent), landmark),
            Goal::ObjectOnLandmark { object, landmark, .. } => {
                Predicate::On(Entity::Object(object), landmark)
            }
            Goal::Touch { agent, other, .. } => Predicate::Touch(agent, Entity::Agent(other)),
        };
        Self { predicate, holds: goal.sign() == Sign::Positive }
    }
}

impl fmt::Display for Predicate {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::On(entity, landmark) => write!(formatter, "On({entity}, landmark {landmark})"),
            Self::Touch(agent, entity) => write!(formatter, "Touch(agent {agent}, {entity})"),
            Self::Attach(agent, object) => write!(formatter, "Attach(agent {agent}, object {object})"),
            Self::Close(entity, PredicateTarget::Entity(other)) => {
                write!(formatter, "Close({entity}, {other})")
            }
            Self::Close(entity, PredicateTarget::Landmark(landmark)) => {
                write!(formatter, "Close({entity}, landmark {landmark})")
            }
        }
    }
}

impl fmt::Display for Literal {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.holds {
            formatter.write_str("not ")?;
        }
        self.predicate.fmt(formatter)
    }
}

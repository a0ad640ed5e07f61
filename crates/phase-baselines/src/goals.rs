//! The goal classes of the networks: one list, relative to an agent rather than by agent number.

use phase_model::{AgentId, Goal, LandmarkId, MAX_OBJECTS, ObjectId, Sign, arena::LANDMARKS};

/// Number of classes.
pub const CLASSES: usize = PLACES + 2 * PLACES + MAX_OBJECTS * 2 * PLACES + 2;

/// Number of landmarks.
const PLACES: usize = LANDMARKS.len();

/// The goals of an agent in the order of the classes: itself on each landmark (4); the other on each
/// landmark, then kept off each, as helpers and hinderers have it (8); each object on each landmark, then
/// kept off each (8 an object); approaching the other, getting away from it (2).
///
/// "The other" makes the list the same for both agents, so that one network serves both. These are the goals
/// of `phase_simple::physical_goals` together with what the other's become if one helps or hinders it.
/// Keeping oneself off a landmark is not among them: an agent that hinders itself does not exist.
#[must_use]
pub fn classes(agent: AgentId) -> [Goal; CLASSES] {
    let me = agent;
    let other = agent.other();
    let places = |agent: AgentId, sign: Sign| {
        LandmarkId::ALL.into_iter().map(move |landmark| Goal::AgentOnLandmark { agent, landmark, sign })
    };
    let things = |object: ObjectId, sign: Sign| {
        LandmarkId::ALL.into_iter().map(move |landmark| Goal::ObjectOnLandmark { object, landmark, sign })
    };
    let approach = Goal::Touch { agent: me, other, sign: Sign::Positive };
    // In a chase both goals name the chaser first.
    let get_away = Goal::Touch { agent: other, other: me, sign: Sign::Negative };
    let mut goals = places(me, Sign::Positive)
        .chain(places(other, Sign::Positive))
        .chain(places(other, Sign::Negative))
        .chain(
            ObjectId::ALL
                .into_iter()
                .flat_map(|object| things(object, Sign::Positive).chain(things(object, Sign::Negative))),
        )
        .chain([approach, get_away]);
    core::array::from_fn(|_| goals.next().unwrap_or(approach))
}

/// The class of an agent's goal; `None` if it has none. Of touching goals only the sign counts, since they
/// are about both agents alike.
#[must_use]
pub fn class_of(agent: AgentId, goal: Goal) -> Option<usize> {
    match goal {
        Goal::Touch { sign: Sign::Positive, .. } => Some(CLASSES - 2),
        Goal::Touch { sign: Sign::Negative, .. } => Some(CLASSES - 1),
        _ => classes(agent).iter().position(|class| *class == goal),
    }
}

/// Whether a class refers to an object that is absent in an event with the given number of objects.
#[must_use]
pub fn is_absent(class: usize, objects: usize) -> bool {
    let first = 3 * PLACES;
    (first + objects * 2 * PLACES..first + MAX_OBJECTS * 2 * PLACES).contains(&class)
}

//! Places at which agents believe entities to be.

use crate::{MethodResult, ObservedEvent, ProgressCallback};
use phase_model::{AGENT_COUNT, AgentId, Entity, RoomId, State, layout::room_of};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Places where an agent can believe an entity to be: the four rooms, in the order of [`RoomId::ALL`], and
/// before its eyes.
pub const PLACES: usize = RoomId::ALL.len() + 1;

/// The place of an entity that the agent sees.
pub const SEEN: usize = PLACES - 1;

/// The probability of each place, 0 to 1; they sum to 1.
pub type Whereabouts = [f64; PLACES];

/// The beliefs of both agents about all other entities, by agent and the order of [`others`].
pub type Beliefs = [Vec<Whereabouts>; AGENT_COUNT];

/// The entities that an agent has beliefs about: the other agent, then the objects.
pub fn others(agent: AgentId, objects: usize) -> impl Iterator<Item = Entity> {
    let own = Entity::Agent(agent);
    Entity::ALL.into_iter().take(AGENT_COUNT + objects).filter(move |&entity| entity != own)
}

/// The certain belief that an entity is in a place.
#[must_use]
pub fn certain(place: usize) -> Whereabouts {
    core::array::from_fn(|k| f64::from(u8::from(k == place)))
}

/// The share of particles, which are equally likely, that have an entity in each room; certain of an entity
/// that is seen, and even over the rooms without particles.
#[must_use]
pub fn whereabouts(particles: &[State], entity: Entity, is_seen: bool) -> Whereabouts {
    if is_seen {
        return certain(SEEN);
    }
    let rooms = RoomId::ALL.len();
    let mut shares = [0.0; PLACES];
    for state in particles {
        shares[room_of(state.position(entity)).index()] += 1.0 / particles.len() as f64;
    }
    if particles.is_empty() {
        shares[..rooms].fill(1.0 / rooms as f64);
    }
    shares
}

/// The beliefs that are asked about.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BeliefOrder {
    /// About the places of entities: where each agent believes each other entity to be.
    #[default]
    First,
    /// About the other's beliefs: where each agent believes the other to believe each entity to be, itself
    /// included. The entry of an agent in [`Beliefs`] has the entities that are [`others`] to the other
    /// agent.
    Second,
}

impl BeliefOrder {
    /// The agent whose view of entities the beliefs of an agent are about: its own, or the other's.
    #[must_use]
    pub const fn viewer(self, agent: AgentId) -> AgentId {
        match self {
            Self::First => agent,
            Self::Second => agent.other(),
        }
    }
}

/// A method that tells where each agent of an event believes each entity to be.
///
/// The whole event is shown, so that what an agent does later tells what it believed before. A
/// [`Recogniser`](crate::Recogniser)'s rules for seeds and threads hold for it too.
pub trait BeliefReader: Sync {
    /// The settings that determine the answers beside event and seed, to be stored with the answers; null for
    /// a method without settings.
    fn settings(&self) -> Value {
        Value::Null
    }

    /// Approximate number of calls of the [`ProgressCallback`] for one event, at least 1, to estimate the
    /// remaining time.
    fn ticks(&self) -> usize {
        1
    }

    /// The beliefs of an order after each of some numbers of steps.
    ///
    /// # Errors
    /// [`MethodError`](crate::MethodError) if the method has no answer for such an event.
    fn read_beliefs(
        &self,
        observed: &ObservedEvent,
        order: BeliefOrder,
        steps: &[usize],
        seed: u64,
        tick: ProgressCallback<'_>,
    ) -> MethodResult<Vec<Beliefs>>;
}

#[cfg(test)]
mod tests {
    use super::{SEEN, certain, others, whereabouts};
    use phase_model::{AgentId, Body, Entity, MAX_ENTITIES, ObjectId, State, arena::LANDMARKS};

    #[test]
    fn shares_of_particles_are_probabilities_of_rooms() {
        let object = Entity::Object(ObjectId::ZERO);
        let particle = |landmark: usize| State::new([Body::at_rest(LANDMARKS[landmark], 0.0); MAX_ENTITIES]);
        let particles = [particle(0), particle(0), particle(0), particle(2)];
        let mut shares = whereabouts(&particles, object, false).to_vec();
        shares.sort_by(f64::total_cmp);
        assert_eq!(shares, [0.0, 0.0, 0.0, 0.25, 0.75]);
        assert_eq!(whereabouts(&particles, object, true), certain(SEEN));
        assert_eq!(whereabouts(&[], object, false), [0.25, 0.25, 0.25, 0.25, 0.0]);
        let about: Vec<Entity> = others(AgentId::ONE, 1).collect();
        assert_eq!(about, [Entity::Agent(AgentId::ZERO), object]);
    }
}

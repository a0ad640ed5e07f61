//! Beliefs that an agent ascribes to the other agent, from its own particles.

use phase_model::{AgentId, Entity, MAX_ENTITIES, PhysicsConfig, RoomId, Sight, State, layout::room_of};
use phase_perception::observed_set;

const ROOMS: usize = RoomId::ALL.len();

/// The view of the other agent in the particles of an agent.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Glance {
    /// By entity and room where it is: the share of particles in which the other perceives it there.
    perceived: [[f64; ROOMS]; MAX_ENTITIES],
    /// The share of those in which it does not.
    missed: [[f64; ROOMS]; MAX_ENTITIES],
}

impl Glance {
    /// The view of `other` in equally likely states, with its own eyes and touch.
    #[must_use]
    pub fn of(physics: &PhysicsConfig, particles: &[State], other: AgentId) -> Self {
        let mut glance = Self::default();
        for state in particles {
            let seen = observed_set(physics, state, other);
            for entity in physics.entities() {
                let shares = if seen.contains(entity) { &mut glance.perceived } else { &mut glance.missed };
                let room = room_of(state.position(entity)).index();
                shares[entity.index()][room] += 1.0 / particles.len() as f64;
            }
        }
        glance
    }

    /// The share of particles with an entity in each room.
    fn rooms(&self, entity: Entity) -> [f64; ROOMS] {
        core::array::from_fn(|room| self.perceived[entity.index()][room] + self.missed[entity.index()][room])
    }
}

/// Places where an agent believes the other to believe bodies to be: before its eyes, or where it last
/// perceived them.
///
/// In every step the other perceives an entity with the probability p that the particles of the agent give
/// it; with 1 − p it goes on believing what it did. Whether it perceives it is taken to be independent of
/// earlier steps. Before it has perceived it, the other believes it in any room, or what its senses tell it:
/// they are taken to be known, as its goal is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AscribedBelief {
    /// By entity: the probability of each room where the other believes it to be without perceiving it, and
    /// that it perceives it.
    places: [[f64; ROOMS + 1]; MAX_ENTITIES],
}

impl AscribedBelief {
    /// The beliefs ascribed in the states of an event, from its start on, to an agent with these senses.
    #[must_use]
    pub fn along(glances: &[Glance], sees: Sight) -> Vec<Self> {
        let Some(first) = glances.first() else { return Vec::new() };
        let is_told = |entity: Entity| sees != Sight::Own && matches!(entity, Entity::Object(_));
        let mut believed = Entity::ALL.map(|entity| match is_told(entity) {
            true => first.rooms(entity),
            false => [1.0 / ROOMS as f64; ROOMS],
        });
        let step = |glance: &Glance| {
            let mut places = [[0.0; ROOMS + 1]; MAX_ENTITIES];
            let entities = places.iter_mut().zip(&mut believed).zip(&glance.perceived).zip(&glance.missed);
            for (entity, (((places, believed), perceived), missed)) in Entity::ALL.into_iter().zip(entities) {
                let all_missed: f64 = missed.iter().sum();
                for room in 0..ROOMS {
                    let is_known = sees == Sight::Objects && is_told(entity);
                    places[room] = if is_known { missed[room] } else { all_missed * believed[room] };
                    places[ROOMS] += perceived[room];
                    believed[room] = perceived[room] + places[room];
                }
            }
            Self { places }
        };
        glances.iter().map(step).collect()
    }

    /// The probability that the other believes an entity to be in each room without perceiving it, in the
    /// order of [`RoomId::ALL`], and that it perceives it.
    #[must_use]
    pub fn places(&self, entity: Entity) -> [f64; ROOMS + 1] {
        self.places[entity.index()]
    }
}

//! Entities of a scene: two agents and up to two objects.

use crate::{AgentId, ObjectId};
use serde::{Deserialize, Serialize};

/// Number of agents in every scene (the paper: "always exactly two").
pub const AGENT_COUNT: usize = 2;
/// Maximum number of objects in a scene.
pub const MAX_OBJECTS: usize = 2;
/// Maximum number of entities in a scene.
pub const MAX_ENTITIES: usize = AGENT_COUNT + MAX_OBJECTS;

/// One agent or object.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Entity {
    /// An agent.
    Agent(AgentId),
    /// An object.
    Object(ObjectId),
}

impl Entity {
    /// All entities that a scene may have, in index order: agents, then objects.
    pub const ALL: [Self; MAX_ENTITIES] = [
        Self::Agent(AgentId::ZERO),
        Self::Agent(AgentId::ONE),
        Self::Object(ObjectId::ZERO),
        Self::Object(ObjectId::ONE),
    ];

    /// Position in [`Entity::ALL`] and in other arrays over all entities: agents 0 and 1, then objects 2 and
    /// 3.
    #[must_use]
    pub const fn index(self) -> usize {
        match self {
            Self::Agent(agent) => agent.index(),
            Self::Object(object) => AGENT_COUNT + object.index(),
        }
    }
}

impl core::fmt::Display for Entity {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Agent(agent) => write!(formatter, "agent {agent}"),
            Self::Object(object) => write!(formatter, "object {object}"),
        }
    }
}

impl<T> core::ops::Index<Entity> for [T; MAX_ENTITIES] {
    type Output = T;

    fn index(&self, entity: Entity) -> &T {
        &self[entity.index()]
    }
}

impl<T> core::ops::IndexMut<Entity> for [T; MAX_ENTITIES] {
    fn index_mut(&mut self, entity: Entity) -> &mut T {
        &mut self[entity.index()]
    }
}

/// A set of entities, agents and objects.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default, Serialize, Deserialize)]
pub struct BodySet(u8);

impl BodySet {
    /// The empty set.
    pub const EMPTY: Self = Self(0);

    /// The set of all objects that a scene may have.
    pub const OBJECTS: Self = Self(((1 << MAX_OBJECTS) - 1) << AGENT_COUNT);

    /// Adds an entity.
    pub const fn insert(&mut self, entity: Entity) {
        self.0 |= 1 << entity.index();
    }

    /// Removes an entity.
    pub const fn remove(&mut self, entity: Entity) {
        self.0 &= !(1 << entity.index());
    }

    /// Whether an entity is in the set.
    #[must_use]
    pub const fn contains(self, entity: Entity) -> bool {
        self.0 & (1 << entity.index()) != 0
    }

    /// Entities that are in either set.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether the set is empty.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The entities in the set, by index.
    pub fn iter(self) -> impl Iterator<Item = Entity> {
        Entity::ALL.into_iter().filter(move |&entity| self.contains(entity))
    }

    /// The set as four bits, bit `k` for the entity with index `k`.
    #[must_use]
    pub const fn bits(self) -> u8 {
        self.0
    }
}

impl FromIterator<Entity> for BodySet {
    fn from_iter<I: IntoIterator<Item = Entity>>(entities: I) -> Self {
        let mut set = Self::EMPTY;
        entities.into_iter().for_each(|entity| set.insert(entity));
        set
    }
}

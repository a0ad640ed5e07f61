//! Who is in a scene: two agents and up to two objects.

use serde::{Deserialize, Serialize};

/// Number of agents in every scene (the paper: "always exactly two").
pub const AGENT_COUNT: usize = 2;
/// Greatest number of objects in a scene.
pub const MAX_OBJECTS: usize = 2;
/// Greatest number of entities in a scene.
pub const MAX_ENTITIES: usize = AGENT_COUNT + MAX_OBJECTS;

/// One agent or object. The number inside is 0 or 1.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Entity {
    /// Agent 0 or 1.
    Agent(u8),
    /// Object 0 or 1.
    Object(u8),
}

impl Entity {
    /// Position in arrays over all entities: agents 0 and 1, then objects 2 and 3.
    #[must_use]
    pub const fn index(self) -> usize {
        match self {
            Self::Agent(agent) => agent as usize,
            Self::Object(object) => AGENT_COUNT + object as usize,
        }
    }

    /// The entity at an index as [`Entity::index`] gives it (0 to 3).
    #[must_use]
    pub const fn from_index(index: usize) -> Self {
        if index < AGENT_COUNT { Self::Agent(index as u8) } else { Self::Object((index - AGENT_COUNT) as u8) }
    }

    /// The agent with this number (0 or 1).
    #[must_use]
    pub const fn agent(agent: usize) -> Self {
        Self::Agent(agent as u8)
    }

    /// The object with this number (0 or 1).
    #[must_use]
    pub const fn object(object: usize) -> Self {
        Self::Object(object as u8)
    }
}

/// A set of entities.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default, Serialize, Deserialize)]
pub struct EntitySet(u8);

impl EntitySet {
    /// The set with nothing in it.
    pub const EMPTY: Self = Self(0);

    /// Adds an entity.
    pub const fn insert(&mut self, entity: Entity) {
        self.0 |= 1 << entity.index();
    }

    /// Takes an entity out.
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

    /// Whether nothing is in the set.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The entities in the set, by index.
    pub fn iter(self) -> impl Iterator<Item = Entity> {
        (0..MAX_ENTITIES).map(Entity::from_index).filter(move |&entity| self.contains(entity))
    }

    /// The set as four bits, bit `k` for the entity with index `k`.
    #[must_use]
    pub const fn bits(self) -> u8 {
        self.0
    }
}

impl FromIterator<Entity> for EntitySet {
    fn from_iter<I: IntoIterator<Item = Entity>>(entities: I) -> Self {
        let mut set = Self::EMPTY;
        entities.into_iter().for_each(|entity| set.insert(entity));
        set
    }
}

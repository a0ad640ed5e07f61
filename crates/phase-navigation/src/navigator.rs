//! Fields on demand, with a cache.

use crate::{Disc, Field, Map, Mover, NavigationCosts, Target};
use phase_model::Layout;
use std::{
    collections::{BTreeMap, VecDeque},
    sync::Arc,
};

/// Number of fields kept; the oldest goes first.
const CAPACITY: usize = 64;

/// Computes fields of one layout and keeps the latest.
///
/// A field depends on the arguments alone, so the cache changes the time of an answer and never the answer.
#[derive(Clone, Debug)]
pub struct Navigator {
    map: Arc<Map>,
    costs: NavigationCosts,
    fields: BTreeMap<Key, Arc<Field>>,
    oldest_first: VecDeque<Key>,
}

/// The bits of a field's arguments.
type Key = Vec<u32>;

impl Navigator {
    /// A navigator with an empty cache.
    #[must_use]
    pub fn new(layout: Layout, costs: NavigationCosts) -> Self {
        Self {
            map: Arc::new(Map::new(layout)),
            costs,
            fields: BTreeMap::new(),
            oldest_first: VecDeque::new(),
        }
    }

    /// The map.
    #[must_use]
    pub fn map(&self) -> &Map {
        &self.map
    }

    /// The costs of all fields.
    #[must_use]
    pub const fn costs(&self) -> NavigationCosts {
        self.costs
    }

    /// The field of a target for a mover among obstacles.
    pub fn field(&mut self, target: Target, mover: Mover, obstacles: &[Disc]) -> Arc<Field> {
        let key = key(target, mover, obstacles);
        if let Some(field) = self.fields.get(&key) {
            return Arc::clone(field);
        }
        let field = Arc::new(Field::new(&self.map, target, mover, obstacles, self.costs));
        if self.oldest_first.len() == CAPACITY
            && let Some(oldest) = self.oldest_first.pop_front()
        {
            self.fields.remove(&oldest);
        }
        self.oldest_first.push_back(key.clone());
        self.fields.insert(key, Arc::clone(&field));
        field
    }
}

fn key(target: Target, mover: Mover, obstacles: &[Disc]) -> Key {
    let kind = match target {
        Target::Point(point) => [u32::MAX, point.x.to_bits(), point.y.to_bits()],
        Target::Room { room, depth } => [room.index() as u32, depth.to_bits(), 0],
    };
    let bodies =
        obstacles.iter().flat_map(|disc| [disc.centre.x, disc.centre.y, disc.radius].map(f32::to_bits));
    kind.into_iter().chain([mover.half_width.to_bits()]).chain(bodies).collect()
}

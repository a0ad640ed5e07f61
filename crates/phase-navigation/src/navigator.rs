//! Fields on demand, with a cache.

use crate::{
    Assembly, AssemblyField, AssemblyParameters, Disc, Field, Map, Mover, NavigationParameters, Target,
    accuracy::{ASSEMBLY_FIELDS_KEPT, FIELDS_KEPT},
    cache::{Cache, Key, get_shared},
};
use phase_model::Layout;
use std::sync::{Arc, Mutex};

/// The latest fields of assemblies. They take milliseconds, and the minds that an inference imagines all need
/// the same ones at once.
static ASSEMBLY_FIELDS: Mutex<Cache<AssemblyField>> = Mutex::new(Cache::new(ASSEMBLY_FIELDS_KEPT));

/// Computes fields of one layout and keeps the latest; those of assemblies all navigators of the program
/// keep together.
///
/// A field depends on the arguments alone, so the cache changes the time of an answer and never the answer.
#[derive(Clone, Debug)]
pub struct Navigator {
    map: Map,
    parameters: NavigationParameters,
    fields: Cache<Field>,
}

impl Navigator {
    /// A navigator with an empty cache.
    #[must_use]
    pub fn new(layout: Layout, parameters: NavigationParameters) -> Self {
        Self { map: Map::new(layout), parameters, fields: Cache::new(FIELDS_KEPT) }
    }

    /// The map.
    #[must_use]
    pub const fn map(&self) -> &Map {
        &self.map
    }

    /// The field of a target for a mover among obstacles.
    pub fn field(&mut self, target: Target, mover: Mover, obstacles: &[Disc]) -> Arc<Field> {
        let bodies = obstacles.iter().flat_map(|disc| [disc.centre.x, disc.centre.y, disc.radius]);
        let own = core::iter::once(mover.half_width).chain(bodies).map(f32::to_bits);
        let map = &self.map;
        let parameters = self.parameters;
        self.fields.get(key(target, own), || Field::new(map, target, mover, obstacles, parameters))
    }

    /// The field of a target for an assembly; see [`AssemblyField::new`].
    pub fn assembly_field(
        &self,
        target: Target,
        reach: f32,
        assembly: &Assembly,
        parameters: AssemblyParameters,
    ) -> Arc<AssemblyField> {
        let map = &self.map;
        let numbers = [map.layout().index() as u32, reach.to_bits()].into_iter().chain(parameters.bits());
        let key = key(target, numbers.chain(assembly.bits()));
        let field = || AssemblyField::new(map, target, reach, assembly, parameters);
        get_shared(&ASSEMBLY_FIELDS, key, field)
    }
}

/// The target's bits and others.
fn key(target: Target, others: impl Iterator<Item = u32>) -> Key {
    let target = match target {
        Target::Point(point) => [u32::MAX, point.x.to_bits(), point.y.to_bits()],
        Target::Room { room, depth } => [room.index() as u32, depth.to_bits(), 0],
    };
    target.into_iter().chain(others).collect()
}

//! Travel distances through the arena: how far it is to a target for a body of some width, and which way to
//! go.
//!
//! A [`Map`] has the rooms of a layout, the doors between them and the ways from room to room; a [`Route`] is
//! the cheapest sequence of straight legs through doors, good enough to cost plans.
//!
//! A [`Field`] answers both for one target, one mover and a set of obstacles, from any point. The inner walls
//! are segments on the two axes through the arena's centre, so shortest paths consist of straight legs
//! between a few points around the ends of walls (*corners*), in doors and around obstacles. The field holds
//! the cost to go of these points (Dijkstra on the visibility graph); a query takes the cheapest visible one.
//! Compared with a grid (fast marching), distances are exact up to the polygons that stand for circles,
//! continuous inside a room, and a field takes tens of microseconds; the trade-off is a query that inspects
//! several points instead of four cells.
//!
//! An object that is held moves with its holders as one rigid body, which has to turn to pass doors. An
//! [`AssemblyField`] holds its cost to go on a grid of positions (0.5 u) and orientations (22.5°): a few
//! milliseconds each, once for a grip and a target.
//!
//! A map is one of the layouts of PHASE. A [`Floor`] has any size and any walls, and a [`FloorField`] the
//! travel distances on it to a point or a room.
//!
//! [`Navigator`] computes fields on demand and caches them. All functions are pure: equal arguments give
//! equal bits.
//!
//! Layout 4 has a door of 2.5 u on the left. A body that fits goes straight through it, a wider one has to go
//! round or pay for it:
//!
//! ```
//! use phase_model::{Layout, Vec2};
//! use phase_navigation::{Field, Map, Mover, NavigationParameters, Target};
//!
//! fn main() -> Result<(), phase_model::LayoutError> {
//!     let map = Map::new(Layout::new(4, None)?);
//!     let above = Vec2::new(7.25, 16.0);
//!     let below = Vec2::new(7.25, 6.0);
//!     let parameters = NavigationParameters { impassable: 10.0, ..NavigationParameters::DEFAULT };
//!     let below = Target::Point(below);
//!     let field = |half_width| Field::new(&map, below, Mover { half_width }, &[], parameters);
//!
//!     println!("{} u and {} u", field(1.2).distance(above), field(1.8).distance(above));
//!     assert!((field(1.2).distance(above) - 10.0).abs() < 1e-3);
//!     assert!(field(1.2).direction(above).y < -0.99);
//!     assert!(field(1.8).distance(above) > 15.0);
//!     Ok(())
//! }
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod accuracy;
mod assembly;
mod assembly_field;
mod buckets;
mod cache;
mod field;
mod floor;
mod gaps;
mod graph;
mod lattice;
mod map;
mod navigator;
mod obstacle;
mod parameters;
mod route;
mod terrain;
mod visibility;
mod ways;

pub use assembly::Assembly;
pub use assembly_field::{AssemblyField, Descent};
pub use field::Field;
pub use floor::{Area, Floor, FloorError, FloorField};
pub use gaps::Gaps;
pub use map::Map;
pub use navigator::Navigator;
pub use obstacle::Disc;
pub use parameters::{AssemblyParameters, IMPASSABLE_COST, NavigationParameters};
pub use route::Route;
pub use ways::Crossing;

use phase_model::{Entity, PhysicsConfig, RoomId, Vec2};

/// A place to go to.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Target {
    /// A point (u).
    Point(Vec2),
    /// All points of a room at least `depth` (u, 0 to 10) from its borders with other rooms.
    Room {
        /// The room.
        room: RoomId,
        /// Distance from the lines of the room's two slots (u).
        depth: f32,
    },
}

/// A body that has to fit through doors.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Mover {
    /// Half the width of the body (u): 1.5 R for an agent, the radius of an object.
    pub half_width: f32,
}

impl Mover {
    /// An entity as a mover.
    #[must_use]
    pub fn of(physics: &PhysicsConfig, entity: Entity) -> Self {
        match entity {
            Entity::Agent(agent) => Self { half_width: 0.5 * physics.agents[agent].width() },
            Entity::Object(_) => Self { half_width: physics.radius(entity) },
        }
    }
}

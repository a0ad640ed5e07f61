//! Travel distances through the arena: how far it is to a target for a body of some width, and which way to go.
//!
//! A [`Map`] has the rooms of a layout, the doors between them and the ways from room to room; a [`Route`] is the
//! cheapest sequence of straight legs through doors, good enough to cost plans.
//!
//! A [`Field`] answers both for one target, one mover and a set of obstacles, from any point. The inner walls are
//! segments on the two axes through the arena's centre, so shortest paths consist of straight legs between a few
//! points around the ends of walls (*corners*), in doors and around obstacles. The field holds the cost to go of
//! these points (Dijkstra on the visibility graph); a query takes the cheapest visible one. Compared with a grid
//! (fast marching), distances are exact up to the polygons that stand for circles, continuous inside a room, and
//! a field takes tens of microseconds; the trade-off is a query that inspects several points instead of four
//! cells.
//!
//! An object that is held moves with its holders as one rigid body, which has to turn to pass doors. An
//! [`AssemblyField`] holds its cost to go on a grid of positions (0.5 u) and orientations (22.5°): a few
//! milliseconds each, once for a grip and a target.
//!
//! [`Navigator`] computes fields on demand and caches them. All functions are pure: equal arguments give equal
//! bits.
//!
//! Layout 4 has a door of 2.5 u on the left. A body that fits goes straight through it, a wider one has to go round or pay for it:
//!
//! ```
//! use phase_model::{Layout, Vec2};
//! use phase_navigation::{Field, Map, Mover, NavigationCosts, Target};
//!
//! let map = Map::new(Layout::new(4, None)?);
//! let (above, below) = (Vec2::new(7.25, 16.0), Vec2::new(7.25, 6.0));
//! let costs = NavigationCosts { impassable: 10.0, obstruction: 4.0 };
//! let field = |half_width| Field::new(&map, Target::Point(below), Mover { half_width }, &[], costs);
//!
//! assert!((field(1.2).distance(above) - 10.0).abs() < 1e-3);
//! assert!(field(1.2).direction(above).y < -0.99);
//! assert!(field(1.8).distance(above) > 15.0);
//! # Ok::<(), phase_model::LayoutError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod assembly;
mod assembly_field;
mod buckets;
mod cache;
mod field;
mod gaps;
mod lattice;
mod map;
mod navigator;
mod obstacle;
mod route;
mod terrain;
mod visibility;
mod ways;

pub use assembly::Assembly;
pub use assembly_field::{AssemblyField, Descent};
pub use field::Field;
pub use gaps::Gaps;
pub use map::{CLEARANCE, Map};
pub use navigator::Navigator;
pub use obstacle::Disc;
pub use route::Route;
pub use ways::Crossing;

use phase_model::{RoomId, Vec2};

/// Price of a door that is narrower than the body that is to pass it (u), unless parameters say otherwise: more
/// than any detour, so that such doors are a last resort, yet finite, so that an agent without a better way still
/// tries.
pub const IMPASSABLE_COST: f32 = 100.0;

/// Depth inside a room at which a body counts as having entered it (u).
pub const ROOM_DEPTH: f32 = 1.5;

/// Where to go.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Target {
    /// A point (u).
    Point(Vec2),
    /// All points of a room at least `depth` (u, 0 to 10) from its borders with other rooms; see [`ROOM_DEPTH`].
    Room {
        /// The room.
        room: RoomId,
        /// Distance from the lines of the room's two slots (u).
        depth: f32,
    },
}

/// What has to fit through doors.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Mover {
    /// Half the width of the body (u): 1.5 R for an agent, the radius of an object.
    pub half_width: f32,
}

/// Costs beside the length of a path.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NavigationCosts {
    /// Added for each door on a path that is narrower than the mover (u).
    pub impassable: f32,
    /// Added for each unit of length within an obstacle grown by the mover's half width (dimensionless).
    pub obstruction: f32,
}

/// Costs of an assembly's motion beside the length of the load's path.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AssemblyCosts {
    /// Cost of turning about the load (u/rad).
    pub turning: f32,
    /// Added for each unit of cost while the assembly crosses a wall or is outside the arena (dimensionless).
    pub collision: f32,
}

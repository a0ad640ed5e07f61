//! The cost to go of one target for one mover, from any point.

use crate::{
    Disc, Map, Mover, NavigationParameters, Target,
    accuracy::OFF_AXIS,
    graph::{Graph, Ground, Way, waypoint},
    terrain::Terrain,
    visibility::bends,
};
use phase_model::{RoomId, Vec2, arena};

/// Travel distances to one target.
#[derive(Clone, Debug)]
pub struct Field {
    graph: Graph<Arena>,
    /// See [`NavigationParameters::bend_distance`].
    bend_distance: f32,
}

/// The arena as one mover meets it, and the target.
#[derive(Clone, Debug)]
struct Arena {
    target: Target,
    terrain: Terrain,
}

impl Ground for Arena {
    fn goal(&self, from: Vec2) -> Vec2 {
        nearest(self.target, from)
    }

    fn leg(&self, a: Vec2, b: Vec2) -> Option<f32> {
        self.terrain.leg(a, b)
    }

    fn only_leg(&self, a: Vec2, b: Vec2) -> Option<f32> {
        self.terrain.only_leg(a, b)
    }
}

impl Field {
    /// The field of a target for a mover among obstacles.
    #[must_use]
    pub fn new(
        map: &Map,
        target: Target,
        mover: Mover,
        obstacles: &[Disc],
        parameters: NavigationParameters,
    ) -> Self {
        let terrain = Terrain::new(map, mover, obstacles, parameters);
        let target = match target {
            Target::Point(point) => Target::Point(off_axes(point)),
            room @ Target::Room { .. } => room,
        };
        let bends = bends(map, &terrain, mover);
        let graph = Graph::new(Arena { target, terrain }, 0.5 * parameters.impassable, bends);
        Self { graph, bend_distance: parameters.bend_distance }
    }

    /// The target.
    #[must_use]
    pub const fn target(&self) -> Target {
        self.graph.ground.target
    }

    /// Cost of the cheapest path from a point to the target (u): its length, and the prices of
    /// [`NavigationParameters`] on it. At least 0, finite for every finite point, and the straight distance
    /// where walls and obstacles leave the straight line free.
    #[must_use]
    pub fn distance(&self, from: Vec2) -> f32 {
        self.way(from).cost
    }

    /// Unit vector of the way to go; zero at the target.
    #[must_use]
    pub fn direction(&self, from: Vec2) -> Vec2 {
        (self.waypoint(from, self.bend_distance) - from).normalize_or_zero()
    }

    /// The point on the cheapest path at a length from its start (u), or its end.
    #[must_use]
    pub fn waypoint(&self, from: Vec2, ahead: f32) -> Vec2 {
        waypoint(from, self.path(from), ahead)
    }

    /// The bends of the cheapest path from a point, and its end (u).
    pub fn path(&self, from: Vec2) -> impl Iterator<Item = Vec2> {
        self.graph.path(from, self.way(from))
    }

    /// The number of doors on the cheapest path that are narrower than the mover.
    #[must_use]
    pub fn closed_doors(&self, from: Vec2) -> usize {
        self.graph.closed_doors(self.way(from))
    }

    fn way(&self, from: Vec2) -> Way {
        // Imprecise steps may leave the arena by a little.
        let inside = from.max(arena::MIN).min(arena::MAX);
        if inside != from {
            let way = self.way(inside);
            return Way { cost: way.cost + from.distance(inside), ..way };
        }
        self.graph.way(off_axes(from))
    }
}

/// A point on an axis of the arena, where a wall or a closed door may hide it from everywhere, is taken to
/// lie on the right and below, as [`room_of`](phase_model::layout::room_of) does.
///
/// Only a point exactly on the axis is moved: one that is near it sees all of its own side.
fn off_axes(point: Vec2) -> Vec2 {
    let offset = point - arena::CENTRE;
    let shift = |along: f32, by: f32| if along == 0.0 { by } else { 0.0 };
    point + Vec2::new(shift(offset.x, OFF_AXIS), shift(offset.y, -OFF_AXIS))
}

/// The point of the target nearest to a point (u).
pub(crate) fn nearest(target: Target, from: Vec2) -> Vec2 {
    match target {
        Target::Point(point) => point,
        Target::Room { room, depth } => {
            let mut low = arena::MIN;
            let mut high = arena::MAX;
            if room == RoomId::TOP_LEFT || room == RoomId::BOTTOM_LEFT {
                high.x = arena::CENTRE.x - depth;
            } else {
                low.x = arena::CENTRE.x + depth;
            }
            if room == RoomId::TOP_LEFT || room == RoomId::TOP_RIGHT {
                low.y = arena::CENTRE.y + depth;
            } else {
                high.y = arena::CENTRE.y - depth;
            }
            // A body inside the room has arrived even where rounding puts it outside the arena.
            from.max(low).min(high)
        }
    }
}

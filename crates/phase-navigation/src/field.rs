//! The cost to go of one target for one mover, from any point.

use crate::{
    Disc, Map, Mover, NavigationParameters, Target,
    accuracy::OFF_AXIS,
    terrain::Terrain,
    visibility::{Bend, bends},
};
use phase_model::{RoomId, Vec2, arena};

/// Travel distances to one target.
#[derive(Clone, Debug)]
pub struct Field {
    target: Target,
    terrain: Terrain,
    /// Cost of a leg that ends in a closed door (u); each crossing has two.
    toll: f32,
    /// See [`NavigationParameters::bend_distance`].
    bend_distance: f32,
    /// In ascending order of cost to go.
    nodes: Vec<Node>,
}

/// A bend with its cost to go.
#[derive(Clone, Copy, Debug)]
struct Node {
    bend: Bend,
    /// Cost to go, without the toll of the leg that arrives here (u).
    cost: f32,
    /// The next bend on the way; `None` if the last leg starts here.
    next: Option<usize>,
}

/// The first leg of a path.
#[derive(Clone, Copy)]
struct Way {
    cost: f32,
    next: Option<usize>,
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
        let open = bends(map, &terrain, mover);
        let nodes = Vec::with_capacity(open.len());
        let mut field = Self {
            target,
            terrain,
            toll: 0.5 * parameters.impassable,
            bend_distance: parameters.bend_distance,
            nodes,
        };
        field.settle(open);
        field
    }

    /// Dijkstra's algorithm from the target; ties go to the bend that comes first.
    fn settle(&mut self, bends: Vec<Bend>) {
        let to_target = |bend: Bend| {
            let goal = nearest(self.target, bend.position);
            let cost =
                self.terrain.leg(bend.position, goal).map_or(f32::INFINITY, |leg| leg + self.toll_of(bend));
            Node { bend, cost, next: None }
        };
        let mut open: Vec<Node> = bends.into_iter().map(to_target).collect();
        while let Some(k) = (0..open.len()).min_by(|&a, &b| open[a].cost.total_cmp(&open[b].cost)) {
            let node = open.remove(k);
            if node.cost.is_infinite() {
                break;
            }
            let index = self.nodes.len();
            self.nodes.push(node);
            for other in &mut open {
                let base = node.cost + self.toll_of(node.bend) + self.toll_of(other.bend);
                if base + node.bend.position.distance(other.bend.position) >= other.cost {
                    continue;
                }
                if let Some(leg) = self.terrain.leg(other.bend.position, node.bend.position)
                    && base + leg < other.cost
                {
                    (other.cost, other.next) = (base + leg, Some(index));
                }
            }
        }
    }

    /// The target.
    #[must_use]
    pub const fn target(&self) -> Target {
        self.target
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
        let mut start = from;
        let mut left = ahead;
        for end in self.path(from) {
            let length = start.distance(end);
            if length > left {
                return start + (end - start) * (left / length);
            }
            (start, left) = (end, left - length);
        }
        start
    }

    /// The bends of the cheapest path from a point, and its end (u).
    pub fn path(&self, from: Vec2) -> impl Iterator<Item = Vec2> {
        let mut last = from;
        let mut next = Some(self.way(from).next);
        core::iter::from_fn(move || {
            let Some(bend) = next? else {
                next = None;
                return Some(nearest(self.target, last));
            };
            last = self.nodes[bend].bend.position;
            next = Some(self.nodes[bend].next);
            Some(last)
        })
    }

    /// The number of doors on the cheapest path that are narrower than the mover.
    #[must_use]
    pub fn closed_doors(&self, from: Vec2) -> usize {
        let first = self.way(from).next;
        core::iter::successors(first, |&bend| self.nodes[bend].next)
            .filter(|&bend| self.nodes[bend].bend.is_closed)
            .count()
    }

    const fn toll_of(&self, bend: Bend) -> f32 {
        if bend.is_closed { self.toll } else { 0.0 }
    }

    fn way(&self, from: Vec2) -> Way {
        // Imprecise steps may leave the arena by a little.
        let inside = from.max(arena::MIN).min(arena::MAX);
        if inside != from {
            let way = self.way(inside);
            return Way { cost: way.cost + from.distance(inside), ..way };
        }
        let way = self.way_in_sight(from);
        if way.cost.is_finite() {
            return way;
        }
        // A point on the axes may see nothing; like `room_of`, take it to lie on the right and below.
        self.way_in_sight(off_axes(from))
    }

    fn way_in_sight(&self, from: Vec2) -> Way {
        let direct = self.terrain.only_leg(from, nearest(self.target, from));
        let mut best = Way { cost: direct.unwrap_or(f32::INFINITY), next: None };
        for (k, node) in self.nodes.iter().enumerate() {
            let base = node.cost + self.toll_of(node.bend);
            // The nodes are in order of their costs; tolls only add to them.
            if node.cost >= best.cost {
                break;
            }
            if base + from.distance(node.bend.position) >= best.cost {
                continue;
            }
            if let Some(leg) = self.terrain.leg(from, node.bend.position)
                && base + leg < best.cost
            {
                best = Way { cost: base + leg, next: Some(k) };
            }
        }
        best
    }
}

/// A point on an axis of the arena, where a wall or a closed door may hide it from everywhere, is taken to
/// lie on the right and below.
fn off_axes(point: Vec2) -> Vec2 {
    let offset = point - arena::CENTRE;
    let shift = |along: f32, by: f32| if along.abs() < OFF_AXIS { by - along } else { 0.0 };
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

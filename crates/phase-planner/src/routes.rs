//! Routes through rooms and doors, and their lengths.
//!
//! Rooms are convex, so the shortest path between two points is a sequence of doors with a crossing point in
//! each. The room graph gives the possible sequences; a few passes of coordinate descent place the crossings.

use petgraph::graph::{NodeIndex, UnGraph};
use phase_model::{
    Layout, RoomId, SlotId, Vec2, arena,
    layout::{SLOT_DIRECTIONS, SLOT_ROOMS, room_of},
};

/// Added to a route's cost for each door that is too narrow or blocked for the body (u): more than any
/// detour, so that such doors are a last resort, yet finite, so that an agent without a better route still
/// tries.
pub const IMPASSABLE_COST: f32 = 100.0;
/// Clearance between a body and the edge of a door (u).
const CLEARANCE: f32 = 0.1;
/// Longest sequence of doors without visiting a room twice.
const MAX_DOORS: usize = 3;

/// The passable part of each slot, as distances from the arena's centre (u); `None` where walls or bodies
/// leave nothing.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Gaps(pub [Option<(f32, f32)>; 4]);

impl Gaps {
    /// Width of the passage in a slot (u), 0 where there is none.
    #[must_use]
    pub fn width(&self, slot: SlotId) -> f32 {
        self.0[slot].map_or(0.0, |(from, to)| to - from)
    }
}

/// A route from one point to another.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Route {
    /// Length along the doors (u).
    pub length: f32,
    /// Number of doors on the route that the body does not fit through.
    pub impassable: u8,
    doors: [(SlotId, Vec2); MAX_DOORS],
    door_count: u8,
}

impl Route {
    /// The route between two points of a room.
    fn straight(from: Vec2, to: Vec2) -> Self {
        let doors = [(SlotId::UP, Vec2::ZERO); MAX_DOORS];
        Self { length: from.distance(to), impassable: 0, doors, door_count: 0 }
    }

    /// Length, with [`IMPASSABLE_COST`] for each door that the body does not fit through (u).
    #[must_use]
    pub fn cost(&self) -> f32 {
        self.length + IMPASSABLE_COST * f32::from(self.impassable)
    }

    /// The doors on the route, by slot, with the point at which each is crossed (u).
    #[must_use]
    pub fn doors(&self) -> &[(SlotId, Vec2)] {
        &self.doors[..usize::from(self.door_count)]
    }

    /// The point of this route, which leads between two ends, that is closest to some point (u).
    #[must_use]
    pub fn nearest(&self, from: Vec2, to: Vec2, point: Vec2) -> Vec2 {
        let mut nearest = from;
        let mut start = from;
        for end in self.doors().iter().map(|&(_, crossing)| crossing).chain([to]) {
            let leg = end - start;
            let share = (point - start).dot(leg) / leg.length_squared().max(f32::MIN_POSITIVE);
            let foot = start + leg * share.clamp(0.0, 1.0);
            if foot.distance(point) < nearest.distance(point) {
                nearest = foot;
            }
            start = end;
        }
        nearest
    }
}

/// The sequences of doors between any two rooms of a layout.
#[derive(Clone, Debug)]
pub struct Routes {
    layout: Layout,
    gaps: Gaps,
    sequences: [[Vec<Vec<SlotId>>; 4]; 4],
}

impl Routes {
    /// Finds all simple paths of the room graph.
    #[must_use]
    pub fn new(layout: Layout) -> Self {
        let gaps = Gaps(SlotId::ALL.map(|slot| {
            layout.opening(slot).map(|opening| {
                let along = |point: Vec2| (point - arena::CENTRE).dot(SLOT_DIRECTIONS[slot]);
                (along(opening.a), along(opening.b))
            })
        }));
        let mut graph = UnGraph::<(), SlotId>::with_capacity(4, 4);
        let rooms: [NodeIndex; 4] = core::array::from_fn(|_| graph.add_node(()));
        for (slot, (a, b)) in SlotId::ALL.into_iter().zip(SLOT_ROOMS) {
            if gaps.0[slot].is_some() {
                graph.add_edge(rooms[a], rooms[b], slot);
            }
        }
        let sequences = core::array::from_fn(|from| {
            core::array::from_fn(|to| {
                if from == to { Vec::new() } else { door_sequences(&graph, rooms[from], rooms[to]) }
            })
        });
        Self { layout, gaps, sequences }
    }

    /// The layout.
    #[must_use]
    pub const fn layout(&self) -> Layout {
        self.layout
    }

    /// The openings of the layout itself, without any bodies in them.
    #[must_use]
    pub const fn gaps(&self) -> &Gaps {
        &self.gaps
    }

    /// The cheapest route for a body of some width (u) when the doors have these gaps; `None` if walls
    /// separate the two points completely.
    #[must_use]
    pub fn best(&self, from: Vec2, to: Vec2, width: f32, gaps: &Gaps) -> Option<Route> {
        let (here, there) = (room_of(from), room_of(to));
        if here == there {
            return Some(Route::straight(from, to));
        }
        let mut best: Option<Route> = None;
        for sequence in &self.sequences[here][there] {
            if best.is_some_and(|best| self.length_lower_bound(sequence, from, to) >= best.cost()) {
                continue;
            }
            let route = self.along(sequence, from, to, width, gaps);
            if best.is_none_or(|best| route.cost() < best.cost()) {
                best = Some(route);
            }
        }
        best
    }

    /// Length of the cheapest route with its penalties (u); the straight distance plus penalties for all
    /// doors if there is no route at all, so that it is always finite.
    #[must_use]
    pub fn cost(&self, from: Vec2, to: Vec2, width: f32, gaps: &Gaps) -> f32 {
        self.best(from, to, width, gaps)
            .map_or_else(|| from.distance(to) + IMPASSABLE_COST * MAX_DOORS as f32, |route| route.cost())
    }

    /// The room on the other side of a slot.
    #[must_use]
    pub fn neighbour_across(slot: SlotId, room: RoomId) -> RoomId {
        let (a, b) = SLOT_ROOMS[slot];
        if a == room { b } else { a }
    }

    /// A lower bound on the length of routes through several doors (u), cheap to compute.
    fn length_lower_bound(&self, sequence: &[SlotId], from: Vec2, to: Vec2) -> f32 {
        let near = |slot: &SlotId, point: Vec2| {
            let (low, high) = self.gaps.0[*slot].unwrap_or((0.0, 0.0));
            let along = (point - arena::CENTRE).dot(SLOT_DIRECTIONS[*slot]);
            point.distance(point_in(*slot, along.max(low).min(high)))
        };
        match sequence {
            [first, .., last] => near(first, from) + near(last, to),
            _ => 0.0,
        }
    }

    fn along(&self, sequence: &[SlotId], from: Vec2, to: Vec2, width: f32, gaps: &Gaps) -> Route {
        let mut doors = [(SlotId::UP, Vec2::ZERO); MAX_DOORS];
        let mut ranges = [(0.0, 0.0); MAX_DOORS];
        let mut impassable = 0;
        for (k, &slot) in sequence.iter().enumerate().take(MAX_DOORS) {
            let whole = self.gaps.0[slot].unwrap_or((0.0, 0.0));
            let gap = gaps.0[slot].unwrap_or(whole);
            if gaps.width(slot) < width {
                impassable += 1;
            }
            let margin = (0.5 * width + CLEARANCE).min(0.5 * (gap.1 - gap.0));
            ranges[k] = (gap.0 + margin, gap.1 - margin);
            doors[k].0 = slot;
        }
        let count = sequence.len().min(MAX_DOORS);
        if count > 1 {
            for (door, range) in doors.iter_mut().zip(ranges).take(count) {
                door.1 = point_in(door.0, 0.5 * (range.0 + range.1));
            }
        }
        let passes = if count > 1 { 3 } else { 1 };
        for _ in 0..passes {
            for k in 0..count {
                let before = if k == 0 { from } else { doors[k - 1].1 };
                let after = if k + 1 == count { to } else { doors[k + 1].1 };
                let slot = doors[k].0;
                // Not `clamp`: rounding may leave the ends of an interval of zero width in the wrong order.
                let (low, high) = ranges[k];
                doors[k].1 = point_in(slot, crossing(slot, before, after).max(low).min(high));
            }
        }
        let mut length = 0.0;
        let mut last = from;
        for &(_, point) in &doors[..count] {
            length += last.distance(point);
            last = point;
        }
        length += last.distance(to);
        Route { length, impassable, doors, door_count: count as u8 }
    }
}

/// All sequences of doors from one room to another that visit no room twice.
fn door_sequences(graph: &UnGraph<(), SlotId>, from: NodeIndex, to: NodeIndex) -> Vec<Vec<SlotId>> {
    let mut sequences: Vec<Vec<SlotId>> = petgraph::algo::all_simple_paths::<
        Vec<_>,
        _,
        std::collections::hash_map::RandomState,
    >(graph, from, to, 0, None)
    .map(|path| {
        path.windows(2).filter_map(|pair| graph.find_edge(pair[0], pair[1]).map(|edge| graph[edge])).collect()
    })
    .collect();
    // The order must not depend on the traversal order of the graph library.
    sequences.sort_by_key(|sequence| (sequence.len(), sequence.clone()));
    sequences
}

/// The point of a slot at a distance from the centre (u).
#[must_use]
pub fn point_in(slot: SlotId, distance: f32) -> Vec2 {
    arena::CENTRE + SLOT_DIRECTIONS[slot] * distance
}

/// Where the line between two points crosses the line of a slot, as a distance from the centre (u); where it
/// runs parallel to it, the mean of both.
fn crossing(slot: SlotId, a: Vec2, b: Vec2) -> f32 {
    let direction = SLOT_DIRECTIONS[slot];
    let (a, b) = (a - arena::CENTRE, b - arena::CENTRE);
    let (across_a, across_b) = (direction.perp_dot(a), direction.perp_dot(b));
    let (along_a, along_b) = (direction.dot(a), direction.dot(b));
    let span = across_a - across_b;
    if span.abs() < 1e-6 {
        return 0.5 * (along_a + along_b);
    }
    along_a + (along_b - along_a) * (across_a / span).clamp(0.0, 1.0)
}

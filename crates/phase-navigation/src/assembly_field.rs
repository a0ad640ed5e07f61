//! The cost to go of an assembly that has to bring its load somewhere.

use crate::{
    Assembly, AssemblyParameters, Map, Target,
    accuracy::{LEAST_BUCKET, LEAST_TURN},
    buckets::Buckets,
    lattice::{self, MOVES, NODES, Node, ORIENTATIONS, SIDE, SPACING, TURN},
};
use phase_model::{Segment, Vec2};

/// Instead of a move: the target is next.
const ARRIVED: u8 = u8::MAX;

/// Travel distances of an assembly to one target, over all positions of the load and all orientations.
#[derive(Clone, Debug)]
pub struct AssemblyField {
    target: Target,
    assembly: Assembly,
    walls: Vec<Segment>,
    parameters: AssemblyParameters,
    /// Cost to go less the load's straight distance to the target (u), by node: flat where the way is
    /// straight.
    excess: Vec<f32>,
    /// Whether each node is without collisions.
    free: Vec<bool>,
    /// The best move of each node.
    moves: Vec<u8>,
}

/// The motion that an assembly should make next.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Descent {
    /// Unit vector of the load's way; zero where the assembly only turns, and at the target.
    pub direction: Vec2,
    /// Sense of the rotation: 1 to the left (counter-clockwise), −1 to the right, 0 if it need not turn.
    pub turn: f32,
}

impl AssemblyField {
    /// The field of a target. A load closer to a target point than `reach` (u) has arrived in every
    /// orientation without collisions.
    #[must_use]
    pub fn new(
        map: &Map,
        target: Target,
        reach: f32,
        assembly: &Assembly,
        parameters: AssemblyParameters,
    ) -> Self {
        let free = free_nodes(map, assembly, parameters.overlap);
        let mut cost = vec![f32::INFINITY; NODES];
        let mut moves = vec![ARRIVED; NODES];
        let steps = lattice::move_costs(parameters.turning);
        let width = steps.iter().copied().fold(f32::INFINITY, f32::min).max(LEAST_BUCKET);
        let mut queue = Buckets::new(width);
        let mut is_settled = vec![false; NODES];
        seed(&mut cost, &free, map, target, reach, parameters.collision);
        for (index, &value) in cost.iter().enumerate().filter(|(_, value)| value.is_finite()) {
            queue.push(index as u32, value);
        }
        while let Some(index) = queue.pop() {
            let index = index as usize;
            // A cost that falls afterwards, which needs edges shorter than a bucket, unsettles its node.
            if core::mem::replace(&mut is_settled[index], true) {
                continue;
            }
            let node = Node::from_index(index);
            for (step, &length) in steps.iter().enumerate() {
                let Some(next) = node.after(step).map(Node::index) else { continue };
                let collisions = 0.5 * (f32::from(!free[index]) + f32::from(!free[next]));
                let value = cost[index] + length * (1.0 + parameters.collision * collisions);
                if value < cost[next] {
                    cost[next] = value;
                    moves[next] = lattice::opposite(step) as u8;
                    is_settled[next] = false;
                    queue.push(next as u32, value);
                }
            }
        }
        let excess = (0..NODES)
            .map(|index| {
                let node = Node::from_index(index);
                let (value, step) = capped(node, &cost, &free, &steps, parameters.edge_rise);
                if let Some(step) = step {
                    moves[index] = step as u8;
                }
                value - straight(target, node.position())
            })
            .collect();
        Self { target, assembly: *assembly, walls: map.walls().to_vec(), parameters, excess, free, moves }
    }

    /// Cost of the cheapest motion to the target (u) from a position of the load (u) and its angle (rad):
    /// length of the load's path, [`AssemblyParameters::turning`] for its rotation about the load, and the
    /// price of collisions. Continuous, finite and at least 0.
    #[must_use]
    pub fn distance(&self, load: Vec2, angle: f32) -> f32 {
        let excess: f32 = lattice::around(load, angle)
            .iter()
            .map(|(node, weight)| weight * self.excess[node.index()])
            .sum();
        (straight(self.target, load) + excess).max(0.0)
    }

    /// The motion to make next, as the mean over the next units of the best path.
    #[must_use]
    pub fn descent(&self, load: Vec2, angle: f32) -> Descent {
        let fraction = (angle / TURN).rem_euclid(1.0);
        let offset = |k: usize| if k >> 2 == 1 { 1.0 - fraction } else { -fraction };
        let around = lattice::around(load, angle);
        let has_free = around.iter().any(|(node, _)| self.free[node.index()]);
        let mut best = (f32::INFINITY, around[0].0, 0.0);
        for (k, (node, _)) in around.into_iter().enumerate() {
            if has_free && !self.free[node.index()] {
                continue;
            }
            let place = node.position();
            let to_go = self.excess[node.index()] + straight(self.target, place);
            let cost = to_go + load.distance(place) + self.parameters.turning * TURN * offset(k).abs();
            if cost < best.0 {
                best = (cost, node, offset(k));
            }
        }
        let (_, mut node, mut turns) = best;
        let mut end = node.position();
        let mut length = load.distance(end) + self.parameters.turning * TURN * turns.abs();
        let steps = lattice::move_costs(self.parameters.turning);
        while length < self.parameters.descent_length {
            let step = self.moves[node.index()];
            let next = node.after(usize::from(step)).filter(|_| step != ARRIVED);
            let Some(next) = next else {
                end = crate::field::nearest(self.target, end);
                break;
            };
            length += steps[usize::from(step)];
            turns += lattice::turns(usize::from(step));
            node = next;
            end = next.position();
        }
        let way = end - load;
        let direction = if way.length() < 0.5 * SPACING && turns.abs() >= LEAST_TURN {
            Vec2::ZERO
        } else {
            way.normalize_or_zero()
        };
        Descent { direction, turn: if turns.abs() < LEAST_TURN { 0.0 } else { turns.signum() } }
    }

    /// Whether the assembly would cross a wall or leave the arena there, by more than a small tolerance.
    #[must_use]
    pub fn collides(&self, load: Vec2, angle: f32) -> bool {
        self.assembly.shape(angle, self.parameters.overlap).collides(load, &self.walls)
    }
}

/// The nodes at which the assembly touches no wall.
fn free_nodes(map: &Map, assembly: &Assembly, overlap: f32) -> Vec<bool> {
    let mut free = Vec::with_capacity(NODES);
    for orientation in 0..ORIENTATIONS {
        let shape = assembly.shape(orientation as f32 * TURN, overlap);
        for index in 0..SIDE * SIDE {
            let row = index / SIDE;
            let column = index % SIDE;
            free.push(!shape.collides(Node { column, row, orientation }.position(), map.walls()));
        }
    }
    free
}

/// Sets the costs of the nodes from which the load has only a straight way to go, or none. If there are none
/// without collisions, those within reach at the price of a unit of length in collision.
fn seed(cost: &mut [f32], free: &[bool], map: &Map, target: Target, reach: f32, collision: f32) {
    let is_there = |node: Node| match target {
        Target::Point(point) => {
            let way = Segment { a: node.position(), b: point };
            way.length() <= reach.max(SPACING) && !map.walls().iter().any(|wall| wall.crosses(way))
        }
        Target::Room { .. } => straight(target, node.position()) == 0.0,
    };
    let nodes = || (0..NODES).map(Node::from_index);
    for node in nodes().filter(|&node| free[node.index()] && is_there(node)) {
        cost[node.index()] = straight(target, node.position());
    }
    if let Target::Point(point) = target {
        extend_straight(cost, free, point);
    }
    if cost.iter().all(|cost| cost.is_infinite()) {
        for node in nodes().filter(|&node| is_there(node)) {
            cost[node.index()] = straight(target, node.position()) + collision;
        }
    }
}

/// Extends the straight ways outwards, orientation by orientation: a free node has one if the two nodes
/// between which its line to the target passes have.
fn extend_straight(cost: &mut [f32], free: &[bool], point: Vec2) {
    let origin = lattice::around(point, 0.0)[0].0;
    // The two nodes on either side of the target start the two halves of each axis.
    let halves = |start: usize| [(start, false), (start + 1, true)];
    for orientation in 0..ORIENTATIONS {
        for (first_column, is_right) in halves(origin.column) {
            for (first_row, is_up) in halves(origin.row) {
                let columns = if is_right { SIDE - first_column } else { first_column + 1 };
                let rows = if is_up { SIDE - first_row } else { first_row + 1 };
                let at = |dx: usize, dy: usize| Node {
                    column: if is_right { first_column + dx } else { first_column - dx },
                    row: if is_up { first_row + dy } else { first_row - dy },
                    orientation,
                };
                for (dx, dy) in (0..columns).flat_map(|dx| (0..rows).map(move |dy| (dx, dy))) {
                    let node = at(dx, dy);
                    let inner = at(dx.saturating_sub(1), dy.saturating_sub(1));
                    let beside = match dx.cmp(&dy) {
                        core::cmp::Ordering::Greater => at(dx - 1, dy),
                        core::cmp::Ordering::Less => at(dx, dy - 1),
                        core::cmp::Ordering::Equal => inner,
                    };
                    let is_straight = free[node.index()]
                        && cost[inner.index()].is_finite()
                        && cost[beside.index()].is_finite();
                    if is_straight {
                        cost[node.index()] = node.position().distance(point);
                    }
                }
            }
        }
    }
}

/// The cost of a node; in a collision not more than a little above that of the best free node beside it, with
/// the move that leads there.
fn capped(
    node: Node,
    cost: &[f32],
    free: &[bool],
    steps: &[f32; MOVES],
    edge_rise: f32,
) -> (f32, Option<usize>) {
    let mut best = (cost[node.index()], None);
    if free[node.index()] {
        return best;
    }
    for (step, &length) in steps.iter().enumerate() {
        let Some(next) = node.after(step).map(Node::index) else { continue };
        let value = cost[next] + edge_rise * length;
        if free[next] && value < best.0 {
            best = (value, Some(step));
        }
    }
    best
}

/// The load's straight distance to the target (u).
fn straight(target: Target, load: Vec2) -> f32 {
    load.distance(crate::field::nearest(target, load))
}

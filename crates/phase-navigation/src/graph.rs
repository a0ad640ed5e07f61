//! Dijkstra's algorithm on a visibility graph, and the paths that it gives.

use crate::visibility::Bend;
use phase_model::Vec2;

/// The ground that a mover crosses, and its target.
pub(crate) trait Ground {
    /// The point of the target nearest to a point (u).
    fn goal(&self, from: Vec2) -> Vec2;

    /// Cost of the straight leg between two points (u); `None` if there is none.
    fn leg(&self, a: Vec2, b: Vec2) -> Option<f32>;

    /// Cost of a path's only leg (u).
    fn only_leg(&self, a: Vec2, b: Vec2) -> Option<f32>;
}

/// The cost to go of every bend.
#[derive(Clone, Debug)]
pub(crate) struct Graph<G> {
    pub(crate) ground: G,
    /// Cost of a leg that ends in a closed door (u); each crossing has two.
    toll: f32,
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
pub(crate) struct Way {
    pub(crate) cost: f32,
    pub(crate) next: Option<usize>,
}

impl<G: Ground> Graph<G> {
    pub(crate) fn new(ground: G, toll: f32, bends: Vec<Bend>) -> Self {
        let mut graph = Self { ground, toll, nodes: Vec::with_capacity(bends.len()) };
        graph.settle(bends);
        graph
    }

    /// Dijkstra's algorithm from the target; ties go to the bend that comes first.
    fn settle(&mut self, bends: Vec<Bend>) {
        let to_target = |bend: Bend| {
            let goal = self.ground.goal(bend.position);
            let cost =
                self.ground.leg(bend.position, goal).map_or(f32::INFINITY, |leg| leg + self.toll_of(bend));
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
                if let Some(leg) = self.ground.leg(other.bend.position, node.bend.position)
                    && base + leg < other.cost
                {
                    (other.cost, other.next) = (base + leg, Some(index));
                }
            }
        }
    }

    /// The cheapest way from a point; its cost is infinite if there is none.
    pub(crate) fn way(&self, from: Vec2) -> Way {
        let direct = self.ground.only_leg(from, self.ground.goal(from));
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
            if let Some(leg) = self.ground.leg(from, node.bend.position)
                && base + leg < best.cost
            {
                best = Way { cost: base + leg, next: Some(k) };
            }
        }
        best
    }

    /// The bends of a way that begins at a point, and its end (u).
    pub(crate) fn path(&self, from: Vec2, way: Way) -> impl Iterator<Item = Vec2> {
        let mut last = from;
        let mut next = Some(way.next);
        core::iter::from_fn(move || {
            let Some(bend) = next? else {
                next = None;
                return Some(self.ground.goal(last));
            };
            last = self.nodes[bend].bend.position;
            next = Some(self.nodes[bend].next);
            Some(last)
        })
    }

    /// The number of closed doors on a way.
    pub(crate) fn closed_doors(&self, way: Way) -> usize {
        core::iter::successors(way.next, |&bend| self.nodes[bend].next)
            .filter(|&bend| self.nodes[bend].bend.is_closed)
            .count()
    }

    const fn toll_of(&self, bend: Bend) -> f32 {
        if bend.is_closed { self.toll } else { 0.0 }
    }
}

/// The point on a path at a length from its start (u), or its end.
pub(crate) fn waypoint(from: Vec2, path: impl Iterator<Item = Vec2>, ahead: f32) -> Vec2 {
    let mut start = from;
    let mut left = ahead;
    for end in path {
        let length = start.distance(end);
        if length > left {
            return start + (end - start) * (left / length);
        }
        (start, left) = (end, left - length);
    }
    start
}

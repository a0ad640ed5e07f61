//! Shortest paths by brute force: densely sampled crossing points and circles, all pairs tested for walls.

use phase_model::{Layout, Segment, SlotId, Vec2, arena, layout::room_of};

/// Distance between crossing points in a door (u).
const SPACING: f32 = 0.25;
/// Number of points on the circle around a corner.
const CIRCLE: usize = 64;

/// The end of a wall beside a passable opening.
struct Corner {
    centre: Vec2,
    radius: f32,
}

pub(crate) struct Oracle {
    barriers: Vec<Segment>,
    corners: Vec<Corner>,
    points: Vec<Vec2>,
    /// The middles of openings that are too narrow.
    closed: Vec<Vec2>,
    impassable: f32,
}

impl Oracle {
    pub(crate) fn new(layout: Layout, half_width: f32, impassable: f32) -> Self {
        let walls = layout.walls();
        let mut oracle = Self {
            barriers: walls.clone(),
            corners: Vec::new(),
            points: Vec::new(),
            closed: Vec::new(),
            impassable,
        };
        for opening in SlotId::ALL.into_iter().filter_map(|slot| layout.opening(slot)) {
            if opening.length() < 2.0 * half_width {
                oracle.closed.push(opening.middle());
                oracle.barriers.push(opening);
                continue;
            }
            let margin = (half_width + 0.1).min(0.5 * opening.length());
            let along = (opening.b - opening.a).normalize();
            // Ends beside which there is a wall, and those at the boundary beside which there is one further
            // in.
            let is_end = |point: Vec2| walls.iter().any(|wall| wall.distance(point) < 1e-3);
            let is_door = opening.length() < 9.9;
            let mut passage = opening;
            if is_end(opening.a) {
                passage.a += along * margin;
                oracle.corners.push(Corner { centre: opening.a, radius: margin });
                oracle.barriers.push(Segment { a: opening.a, b: passage.a - along * 1e-3 });
            }
            if is_door {
                passage.b -= along * margin;
                if is_end(opening.b) {
                    oracle.corners.push(Corner { centre: opening.b, radius: margin });
                }
                oracle.barriers.push(Segment { a: passage.b + along * 1e-3, b: opening.b });
            }
            let count = (passage.length() / SPACING).ceil().max(1.0) as usize;
            let sample = |k: usize| passage.a.lerp(passage.b, k as f32 / count as f32);
            oracle.points.extend((0..=count).map(sample));
        }
        for corner in &oracle.corners {
            // Between the axes, so that no point lies on a wall.
            let angle = |k: usize| (k as f32 + 0.5) / CIRCLE as f32 * core::f32::consts::TAU;
            let point = |k: usize| corner.centre + corner.radius * Vec2::from_angle(angle(k));
            oracle.points.extend((0..CIRCLE).map(point).filter(|&point| arena::contains(point)));
        }
        oracle
    }

    pub(crate) fn is_in_margin(&self, point: Vec2) -> bool {
        self.corners.iter().any(|corner| corner.centre.distance(point) < corner.radius + 0.05)
    }

    /// Length of a straight leg, unless something is in between.
    fn leg(&self, a: Vec2, b: Vec2) -> Option<f32> {
        let leg = Segment { a, b };
        let length = leg.length();
        if length == 0.0 {
            return Some(0.0);
        }
        // Legs that start or end in the middle of a closed door are charged for it elsewhere.
        let ends_in = |barrier: &Segment| barrier.distance(a) < 1e-4 || barrier.distance(b) < 1e-4;
        if self.barriers.iter().any(|barrier| barrier.crosses(leg) && !ends_in(barrier)) {
            return None;
        }
        let cuts = |corner: &Corner| {
            // Not more than the chords of the circle's samples do.
            leg.distance(corner.centre) < 0.99 * corner.radius
        };
        (!self.corners.iter().any(cuts)).then_some(length)
    }

    /// Bellman and Ford's algorithm over all points.
    pub(crate) fn distance(&self, from: Vec2, to: Vec2) -> f32 {
        if room_of(from) == room_of(to) {
            return from.distance(to);
        }
        let points: Vec<(Vec2, f32)> = [(from, 0.0), (to, 0.0)]
            .into_iter()
            .chain(self.points.iter().map(|&point| (point, 0.0)))
            .chain(self.closed.iter().map(|&point| (point, 0.5 * self.impassable)))
            .collect();
        let mut legs = Vec::new();
        for i in 0..points.len() {
            for j in 0..i {
                if let Some(length) = self.leg(points[i].0, points[j].0) {
                    legs.push((i, j, length + points[i].1 + points[j].1));
                }
            }
        }
        let mut distances = vec![f32::INFINITY; points.len()];
        distances[0] = 0.0;
        loop {
            let mut has_changed = false;
            for &(i, j, length) in &legs {
                for (i, j) in [(i, j), (j, i)] {
                    if distances[i] + length < distances[j] {
                        distances[j] = distances[i] + length;
                        has_changed = true;
                    }
                }
            }
            if !has_changed {
                return distances[1];
            }
        }
    }
}

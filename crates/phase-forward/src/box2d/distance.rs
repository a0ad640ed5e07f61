//! The distance of two convex shapes without their skins: Gilbert, Johnson and Keerthi's algorithm.

use super::math::{Transform, right_of};
use phase_model::Vec2;

/// The corners of a shape.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners {
    pub(super) corners: [Vec2; 4],
    pub(super) count: usize,
}

impl Corners {
    /// The first of the corners that are farthest along a direction.
    pub(super) fn farthest(&self, direction: Vec2) -> usize {
        let mut best = (0, self.corners[0].dot(direction));
        for k in 1..self.count {
            let along = self.corners[k].dot(direction);
            if along > best.1 {
                best = (k, along);
            }
        }
        best.0
    }
}

/// A point of the difference of two shapes.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    on_a: Vec2,
    on_b: Vec2,
    between: Vec2,
    share: f32,
    names: (usize, usize),
}

/// Corners, one of each shape, at the end of a search; the next begins there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cache {
    pub(super) names: [(usize, usize); 3],
    pub(super) count: usize,
    metric: f32,
}

impl Cache {
    pub(super) const EMPTY: Self = Self { names: [(0, 0); 3], count: 0, metric: 0.0 };
}

struct Simplex {
    vertices: [Vertex; 3],
    count: usize,
}

impl Simplex {
    fn metric(&self) -> f32 {
        let [a, b, c] = self.vertices.map(|vertex| vertex.between);
        match self.count {
            2 => (a - b).length(),
            3 => (b - a).perp_dot(c - a),
            _ => 0.0,
        }
    }

    /// Keeps the part of a line that is nearest to the origin.
    fn reduce_line(&mut self) {
        let [a, b, _] = self.vertices.map(|vertex| vertex.between);
        let along = b - a;
        let to_b = -a.dot(along);
        if to_b <= 0.0 {
            return self.keep(&[(0, 1.0)]);
        }
        let to_a = b.dot(along);
        if to_a <= 0.0 {
            return self.keep(&[(1, 1.0)]);
        }
        let scale = 1.0 / (to_a + to_b);
        self.keep(&[(0, to_a * scale), (1, to_b * scale)]);
    }

    /// Keeps the part of a triangle that is nearest to the origin.
    fn reduce_triangle(&mut self) {
        let [a, b, c] = self.vertices.map(|vertex| vertex.between);
        let ab = b - a;
        let ac = c - a;
        let bc = c - b;
        let ab_a = b.dot(ab);
        let ab_b = -a.dot(ab);
        let ac_a = c.dot(ac);
        let ac_c = -a.dot(ac);
        let bc_b = c.dot(bc);
        let bc_c = -b.dot(bc);
        let area = ab.perp_dot(ac);
        let [of_a, of_b, of_c] = [area * b.perp_dot(c), area * c.perp_dot(a), area * a.perp_dot(b)];
        let line = |x: f32, y: f32| {
            let scale = 1.0 / (x + y);
            (x * scale, y * scale)
        };
        if ab_b <= 0.0 && ac_c <= 0.0 {
            self.keep(&[(0, 1.0)]);
        } else if ab_a > 0.0 && ab_b > 0.0 && of_c <= 0.0 {
            let (x, y) = line(ab_a, ab_b);
            self.keep(&[(0, x), (1, y)]);
        } else if ac_a > 0.0 && ac_c > 0.0 && of_b <= 0.0 {
            let (x, y) = line(ac_a, ac_c);
            self.keep(&[(0, x), (2, y)]);
        } else if ab_a <= 0.0 && bc_c <= 0.0 {
            self.keep(&[(1, 1.0)]);
        } else if ac_a <= 0.0 && bc_b <= 0.0 {
            self.keep(&[(2, 1.0)]);
        } else if bc_b > 0.0 && bc_c > 0.0 && of_a <= 0.0 {
            let (x, y) = line(bc_b, bc_c);
            self.keep(&[(2, y), (1, x)]);
        } else {
            let scale = 1.0 / (of_a + of_b + of_c);
            self.keep(&[(0, of_a * scale), (1, of_b * scale), (2, of_c * scale)]);
        }
    }

    fn keep(&mut self, kept: &[(usize, f32)]) {
        let before = self.vertices;
        for (vertex, &(k, share)) in self.vertices.iter_mut().zip(kept) {
            *vertex = Vertex { share, ..before[k] };
        }
        self.count = kept.len();
    }

    fn direction(&self) -> Vec2 {
        let [a, b, _] = self.vertices.map(|vertex| vertex.between);
        if self.count == 1 {
            return -a;
        }
        let along = b - a;
        if along.perp_dot(-a) > 0.0 { -right_of(along) } else { right_of(along) }
    }

    fn distance(&self) -> f32 {
        let [a, b, _] = &self.vertices;
        match self.count {
            1 => (a.on_a - a.on_b).length(),
            2 => {
                let on_a = a.share * a.on_a + b.share * b.on_a;
                let on_b = a.share * a.on_b + b.share * b.on_b;
                (on_a - on_b).length()
            }
            _ => 0.0,
        }
    }
}

/// The distance of two shapes in poses; 0 where they overlap (u).
pub(super) fn distance(a: (&Corners, &Transform), b: (&Corners, &Transform), cache: &mut Cache) -> f32 {
    const MAX_ITERATIONS: usize = 20;
    let vertex = |names: (usize, usize), share: f32| {
        let on_a = a.1.apply(a.0.corners[names.0]);
        let on_b = b.1.apply(b.0.corners[names.1]);
        Vertex { on_a, on_b, between: on_b - on_a, share, names }
    };
    let mut simplex = Simplex { vertices: cache.names.map(|names| vertex(names, 0.0)), count: cache.count };
    if simplex.count > 1 {
        let before = cache.metric;
        let now = simplex.metric();
        if now < 0.5 * before || 2.0 * before < now || now < f32::EPSILON {
            simplex.count = 0;
        }
    }
    if simplex.count == 0 {
        simplex.vertices[0] = vertex((0, 0), 1.0);
        simplex.count = 1;
    }
    for _ in 0..MAX_ITERATIONS {
        let known = simplex.vertices.map(|vertex| vertex.names);
        let known = &known[..simplex.count];
        match simplex.count {
            2 => simplex.reduce_line(),
            3 => simplex.reduce_triangle(),
            _ => {}
        }
        if simplex.count == 3 {
            break;
        }
        let direction = simplex.direction();
        if direction.dot(direction) < f32::EPSILON * f32::EPSILON {
            break;
        }
        let names = (
            a.0.farthest(a.1.rotation.turn_back(-direction)),
            b.0.farthest(b.1.rotation.turn_back(direction)),
        );
        // As in the original, a corner that is known still stands after the simplex.
        simplex.vertices[simplex.count] = vertex(names, simplex.vertices[simplex.count].share);
        if known.contains(&names) {
            break;
        }
        simplex.count += 1;
    }
    *cache = Cache {
        names: simplex.vertices.map(|vertex| vertex.names),
        count: simplex.count,
        metric: simplex.metric(),
    };
    simplex.distance()
}

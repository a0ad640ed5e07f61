//! One contact as a constraint: bodies may not approach each other at its points.

use crate::{
    body::{Motion, STATIC, Shape, Twist},
    manifold::Manifold,
    tuning::{LONGEST_CORRECTION, SLOP},
};

/// Two points whose effective masses differ by more than this are solved as one.
const WORST_CONDITION: f32 = 1000.0;

/// A touching contact and all that its solution needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    /// Which pair of shapes it belongs to.
    pub(crate) key: u8,
    /// First body; [`STATIC`] for walls.
    pub(crate) a: usize,
    /// Second body, never static.
    pub(crate) b: usize,
    pub(crate) manifold: Manifold,
    /// Impulse so far at each point (N s).
    pub(crate) impulses: [f32; 2],
    skins: f32,
    /// Number of points the velocity solver uses.
    count: usize,
    /// What a unit impulse at each point is to the first and to the second body.
    rows: [(Twist, Twist); 2],
    /// What a unit impulse at point i does to the speed at point j: (0, 0), (0, 1) and (1, 1).
    response: [f32; 3],
    /// The inverse of the same matrix, if both points are solved together.
    inverse: [f32; 3],
}

impl Contact {
    pub(crate) const NONE: Self = Self {
        key: 0,
        a: STATIC,
        b: 0,
        manifold: Manifold::NONE,
        impulses: [0.0; 2],
        skins: 0.0,
        count: 0,
        rows: [(Twist::ZERO, Twist::ZERO); 2],
        response: [0.0; 3],
        inverse: [0.0; 3],
    };

    /// A contact of two bodies that starts without impulses.
    pub(crate) fn new(key: u8, (a, b): (usize, usize), manifold: Manifold) -> Self {
        Self { key, a, b, manifold, ..Self::NONE }
    }

    /// Works out where impulses act and what they do, at the present poses.
    pub(crate) fn prepare(&mut self, shapes: &[Shape; 5], motions: &[Motion; 5]) {
        let (a, b) = (&motions[self.a], &motions[self.b]);
        let (shape_a, shape_b) = (&shapes[self.a], &shapes[self.b]);
        self.skins = shape_a.skin + shape_b.skin;
        let (normal, middles) = self.manifold.middles(a, b, shape_a.skin, shape_b.skin);
        self.count = self.manifold.count;
        for (row, middle) in self.rows.iter_mut().zip(middles).take(self.count) {
            *row =
                (Twist::of_impulse(-normal, middle - a.centre), Twist::of_impulse(normal, middle - b.centre));
        }
        let rows = self.rows;
        let respond = |i: usize, j: usize| {
            let mut twists = (Twist::ZERO, Twist::ZERO);
            twists.0.push(rows[j].0, 1.0, shape_a);
            twists.1.push(rows[j].1, 1.0, shape_b);
            rows[i].0.dot(twists.0) + rows[i].1.dot(twists.1)
        };
        self.response[0] = respond(0, 0);
        if self.count == 2 {
            let [first, cross, second] = [self.response[0], respond(0, 1), respond(1, 1)];
            let determinant = first * second - cross * cross;
            if first * first < WORST_CONDITION * determinant {
                let scale = 1.0 / determinant;
                self.response = [first, cross, second];
                self.inverse = [second * scale, -cross * scale, first * scale];
            } else {
                self.count = 1;
            }
        }
    }

    /// Applies the impulses so far, those of the substep before as a first guess.
    pub(crate) fn warm_start(&self, shapes: &[Shape; 5], twists: &mut [Twist; 5]) {
        for point in 0..self.count {
            self.apply(shapes, twists, point, self.impulses[point]);
        }
    }

    /// One iteration of the velocity solver. Returns the greatest change of an impulse (N s).
    #[inline]
    pub(crate) fn solve(&mut self, shapes: &[Shape; 5], twists: &mut [Twist; 5]) -> f32 {
        let before = self.impulses;
        let after = if self.count == 1 {
            let speed = self.speed(twists, 0);
            [(before[0] - speed / self.response[0]).max(0.0), before[1]]
        } else {
            let [first, cross, second] = self.response;
            // Speeds there would be without the impulses so far.
            let bare = [
                self.speed(twists, 0) - first * before[0] - cross * before[1],
                self.speed(twists, 1) - cross * before[0] - second * before[1],
            ];
            match self.complementary(bare) {
                Some(after) => after,
                None => return 0.0,
            }
        };
        let mut greatest = 0.0_f32;
        for point in 0..self.count {
            let change = after[point] - before[point];
            if change != 0.0 {
                self.apply(shapes, twists, point, change);
                greatest = greatest.max(change.abs());
            }
        }
        self.impulses = after;
        greatest
    }

    /// One iteration of the position solver, which takes back a share of the overlap. Returns the gap found
    /// before, negative where shapes overlap (u).
    pub(crate) fn separate(&self, shapes: &[Shape; 5], motions: &mut [Motion; 5], share: f32) -> f32 {
        let (shape_a, shape_b) = (&shapes[self.a], &shapes[self.b]);
        let mut least = f32::MAX;
        for point in 0..self.manifold.count {
            let (a, b) = (&motions[self.a], &motions[self.b]);
            let (normal, at, gap) = self.manifold.gap(a, b, self.skins, point);
            least = least.min(gap);
            let correction = (share * (gap + SLOP)).clamp(-LONGEST_CORRECTION, 0.0);
            if correction == 0.0 {
                continue;
            }
            let (offset_a, offset_b) = (at - a.centre, at - b.centre);
            let (arm_a, arm_b) = (offset_a.perp_dot(normal), offset_b.perp_dot(normal));
            let response = shape_a.inverse_mass
                + shape_b.inverse_mass
                + shape_a.inverse_inertia * arm_a * arm_a
                + shape_b.inverse_inertia * arm_b * arm_b;
            let impulse = normal * (-correction / response);
            if self.a != STATIC {
                motions[self.a].shift(shape_a, offset_a, -impulse, 0.0);
            }
            motions[self.b].shift(shape_b, offset_b, impulse, 0.0);
        }
        least
    }

    /// Speed at which the bodies part at a point (u/s).
    #[inline]
    fn speed(&self, twists: &[Twist; 5], point: usize) -> f32 {
        let (row_a, row_b) = self.rows[point];
        row_a.dot(twists[self.a]) + row_b.dot(twists[self.b])
    }

    #[inline]
    fn apply(&self, shapes: &[Shape; 5], twists: &mut [Twist; 5], point: usize, impulse: f32) {
        let (row_a, row_b) = self.rows[point];
        twists[self.a].push(row_a, impulse, &shapes[self.a]);
        twists[self.b].push(row_b, impulse, &shapes[self.b]);
    }

    /// Impulses at both points such that nothing approaches, nothing pulls, and no impulse acts where the
    /// bodies part: a complementarity problem small enough to try all four cases. Takes the speeds without
    /// any impulse.
    #[inline]
    fn complementary(&self, bare: [f32; 2]) -> Option<[f32; 2]> {
        let [first, cross, second] = self.response;
        let [inverse_first, inverse_cross, inverse_second] = self.inverse;
        let both = [
            -(inverse_first * bare[0] + inverse_cross * bare[1]),
            -(inverse_cross * bare[0] + inverse_second * bare[1]),
        ];
        if both[0] >= 0.0 && both[1] >= 0.0 {
            return Some(both);
        }
        let alone = -bare[0] / first;
        if alone >= 0.0 && cross * alone + bare[1] >= 0.0 {
            return Some([alone, 0.0]);
        }
        let alone = -bare[1] / second;
        if alone >= 0.0 && cross * alone + bare[0] >= 0.0 {
            return Some([0.0, alone]);
        }
        (bare[0] >= 0.0 && bare[1] >= 0.0).then_some([0.0, 0.0])
    }
}

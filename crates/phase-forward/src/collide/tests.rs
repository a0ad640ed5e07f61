//! Contacts compared with distances computed independently: along all axes, in double precision, from the
//! outlines of `phase_model`.

use super::{agent_disc, agents, discs, wall_agent, wall_disc};
use crate::{
    body::{BodyMotion, Shape},
    constants::SKIN,
    manifold::Manifold,
    polygon::Polygon,
    wall::Wall,
};
use phase_model::{AgentBody, Body, Segment, Vec2, geometry::trapezoid};
use proptest::prelude::*;

/// Error of single precision at the coordinates of the arena (u).
const ROUNDING: f64 = 2e-4;
/// Maximum overlap of an agent with another, or with a wall, for which the minimum separating axis is
/// expected (u).
const SHALLOW: f64 = 0.3;

type Point = (f64, f64);

fn point(vector: Vec2) -> Point {
    (f64::from(vector.x), f64::from(vector.y))
}

fn minus(a: Point, b: Point) -> Point {
    (a.0 - b.0, a.1 - b.1)
}

fn dot(a: Point, b: Point) -> f64 {
    a.0 * b.0 + a.1 * b.1
}

/// An agent at a pose, for the narrow phase and for the reference.
struct Agent {
    shape: Shape,
    motion: BodyMotion,
    polygon: Polygon,
    outline: [Point; 4],
}

impl Agent {
    fn new(radius: f32, position: Vec2, angle: f32) -> Self {
        let shape = Shape::agent(&AgentBody { radius, max_force: 450.0 });
        let motion = BodyMotion::of_agent(&Body::at_rest(position, angle), &shape);
        let (sin, cos) = f64::from(angle).sin_cos();
        let outline = trapezoid(radius).map(|corner| {
            let (x, y) = point(corner);
            let origin = point(position);
            (origin.0 + x * cos - y * sin, origin.1 + x * sin + y * cos)
        });
        Self { polygon: Polygon::new(&shape, &motion), shape, motion, outline }
    }

    /// The sides, from corner to corner, with their outward unit normals.
    fn sides(&self) -> impl Iterator<Item = (Point, Point, Point)> {
        (0..4).map(|k| {
            let from = self.outline[k];
            let to = self.outline[(k + 1) % 4];
            let along = minus(to, from);
            let length = dot(along, along).sqrt();
            (from, to, (along.1 / length, -along.0 / length))
        })
    }

    /// Maximum over the sides of the distance of some points beyond a side (u); negative if no side separates
    /// them.
    fn separation(&self, points: &[Point]) -> f64 {
        let beyond = |(from, _, normal): (Point, Point, Point)| {
            points.iter().map(|&p| dot(minus(p, from), normal)).fold(f64::MAX, f64::min)
        };
        self.sides().map(beyond).fold(f64::MIN, f64::max)
    }

    /// Distance of a point from the outline (u), negative inside.
    fn signed_distance(&self, to: Point) -> f64 {
        let depth = self.separation(&[to]);
        if depth <= 0.0 {
            return depth;
        }
        self.sides().map(|(from, end, _)| distance_to_segment(to, from, end)).fold(f64::MAX, f64::min)
    }
}

fn distance_to_segment(p: Point, from: Point, to: Point) -> f64 {
    let along = minus(to, from);
    let share = (dot(minus(p, from), along) / dot(along, along)).clamp(0.0, 1.0);
    let away = minus(p, (from.0 + along.0 * share, from.1 + along.1 * share));
    dot(away, away).sqrt()
}

/// The minimum gap over the points of a manifold (u); `None` without contact.
fn least_gap(manifold: &Manifold, a: &BodyMotion, b: &BodyMotion, skins: f32) -> Option<f64> {
    (0..manifold.count).map(|k| f64::from(manifold.gap(a, b, skins, k).2)).min_by(f64::total_cmp)
}

/// Whether two shapes at a distance are in contact exactly if the reference agrees, and at the same distance.
fn check(current: Option<f64>, expected: f64, tolerance: f64) -> Result<(), TestCaseError> {
    match current {
        Some(gap) => prop_assert!((gap - expected).abs() <= tolerance, "gap {gap} u, not {expected} u"),
        None => prop_assert!(expected >= -tolerance, "no contact at a gap of {expected} u"),
    }
    Ok(())
}

fn disc(position: Vec2) -> BodyMotion {
    BodyMotion::of_object(&Body::at_rest(position, 0.0))
}

fn radius() -> impl Strategy<Value = f32> {
    0.6..1.7_f32
}

fn near(reach: f32) -> impl Strategy<Value = Vec2> {
    (-reach..reach, -reach..reach).prop_map(|(x, y)| Vec2::new(16.0 + x, 12.0 + y))
}

fn agent() -> impl Strategy<Value = (f32, Vec2, f32)> {
    (radius(), near(2.0), -7.0..7.0_f32)
}

fn contact(first: &Agent, second: &Agent) -> Option<f64> {
    let manifold = agents((&first.motion, &first.polygon), (&second.motion, &second.polygon));
    least_gap(&manifold, &first.motion, &second.motion, 2.0 * SKIN)
}

/// The minimum separation of two agents over all sides of both (u).
fn separation(first: &Agent, second: &Agent) -> f64 {
    first.separation(&second.outline).max(second.separation(&first.outline))
}

/// Maximum amount by which the preferred face may be worse than the best (u).
fn leeway(separation: f64) -> f64 {
    0.02 * separation.abs() + 0.001 + ROUNDING
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn discs_are_as_far_apart_as_their_centres_say(a in near(2.0), b in near(2.0), skins in 1.2..3.2_f32) {
        let away = minus(point(a), point(b));
        let expected = dot(away, away).sqrt() - f64::from(skins);
        let current = least_gap(&discs(&disc(a), &disc(b), skins), &disc(a), &disc(b), skins);
        check(current, expected, ROUNDING)?;
        prop_assert!(current.is_none() || expected <= ROUNDING);
    }

    #[test]
    fn agent_and_disc((size, place, angle) in agent(), centre in near(4.0), radius in radius()) {
        let agent = Agent::new(size, place, angle);
        let disc = disc(centre);
        let skins = agent.shape.skin + radius;
        let expected = agent.signed_distance(point(centre)) - f64::from(skins);
        let manifold = agent_disc(&agent.shape, &agent.motion, &disc, skins);
        let current = least_gap(&manifold, &agent.motion, &disc, skins);
        check(current, expected, ROUNDING)?;
        prop_assert!(current.is_none() || expected <= ROUNDING);
    }

    #[test]
    fn wall_and_disc(a in near(6.0), b in near(6.0), centre in near(4.0), radius in radius()) {
        prop_assume!(a.distance(b) > 0.1);
        let wall = Wall::new(a, b);
        let disc = disc(centre);
        let skins = SKIN + radius;
        let expected = f64::from(Segment { a, b }.distance(centre) - skins);
        let current = least_gap(&wall_disc(&wall, &disc, skins), &BodyMotion::AT_REST, &disc, skins);
        check(current, expected, ROUNDING)?;
        prop_assert!(current.is_none() || expected <= ROUNDING);
    }

    #[test]
    fn agents_overlap_by_the_least_separating_axis(a in agent(), b in agent()) {
        let first = Agent::new(a.0, a.1, a.2);
        let second = Agent::new(b.0, b.1, b.2);
        let separation = separation(&first, &second);
        let current = contact(&first, &second);
        prop_assert!(current.is_none() || separation <= f64::from(2.0 * SKIN) + ROUNDING);
        if (-SHALLOW..=0.0).contains(&separation) {
            check(current, separation - f64::from(2.0 * SKIN), leeway(separation))?;
        }
    }

    #[test]
    fn agents_swapped_or_turned_together_touch_alike(a in agent(), b in agent(), turn in -3.0..3.0_f32) {
        let first = Agent::new(a.0, a.1, a.2);
        let second = Agent::new(b.0, b.1, b.2);
        let separation = separation(&first, &second);
        if !(-SHALLOW..=0.0).contains(&separation) {
            return Ok(());
        }
        let gap = contact(&first, &second);
        let swapped = contact(&second, &first);
        let centre = Vec2::new(16.0, 12.0);
        let about = |place: Vec2| centre + Vec2::from_angle(turn).rotate(place - centre);
        let turned = [a, b].map(|(size, place, angle)| Agent::new(size, about(place), angle + turn));
        let turned = contact(&turned[0], &turned[1]);
        for other in [swapped, turned] {
            let difference = gap.zip(other).map(|(gap, other)| (gap - other).abs());
            prop_assert!(difference.is_some_and(|difference| difference <= leeway(separation)));
        }
    }

    #[test]
    fn agent_at_a_long_wall((size, place, angle) in agent(), through in near(2.0), along in 0.0..6.3_f32) {
        let agent = Agent::new(size, place, angle);
        let direction = Vec2::from_angle(along);
        let wall = Wall::new(through - 20.0 * direction, through + 20.0 * direction);
        let normal = point(wall.normal);
        let height = |p: Point| dot(minus(p, point(wall.a)), normal);
        let side = height(point(agent.motion.centre)).signum();
        let least = agent.outline.iter().map(|&corner| side * height(corner)).fold(f64::MAX, f64::min);
        let expected = least - f64::from(2.0 * SKIN);
        let manifold = wall_agent(&wall, &agent.motion, &agent.polygon);
        let current = least_gap(&manifold, &BodyMotion::AT_REST, &agent.motion, 2.0 * SKIN);
        // At greater depths, the shortest correction may lead through the wall.
        if expected >= -SHALLOW {
            check(current, expected, ROUNDING)?;
        }
        prop_assert!(current.is_none() || expected <= ROUNDING);
    }
}

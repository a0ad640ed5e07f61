//! Overlap tests compared with parry2d as an independent reference.

use core::f32::consts::PI;
use parry2d::{
    math::{Pose, Vector},
    query::distance,
    shape::{Ball, ConvexPolygon, Segment as ParrySegment},
};
use phase_model::{
    AgentBody, AgentId, Body, Entity, ObjectId, PhysicsConfig, Segment, Vec2,
    geometry::{Outline, trapezoid},
};
use proptest::prelude::*;

/// Closer than this to touching, the two sides may disagree.
const DOUBT: f32 = 1e-3;

fn physics(agent: f32, object: f32) -> PhysicsConfig {
    PhysicsConfig {
        walls: vec![],
        agents: [AgentBody { radius: agent, max_force: 300.0 }; 2],
        object_radii: [object; 2],
        object_count: 2,
    }
}

fn polygon(radius: f32) -> ConvexPolygon {
    let corners = trapezoid(radius).map(|corner| Vector::new(corner.x, corner.y)).to_vec();
    ConvexPolygon::from_convex_polyline(corners).expect("a trapezoid is convex")
}

fn pose(body: &Body) -> Pose {
    Pose::new(Vector::new(body.position.x, body.position.y), body.angle)
}

fn body() -> impl Strategy<Value = Body> {
    (-3.0..3.0_f32, -3.0..3.0_f32, -PI..PI).prop_map(|(x, y, angle)| Body::at_rest(Vec2::new(x, y), angle))
}

proptest! {
    #[test]
    fn trapezoid_and_disc(agent in body(), object in body(), r in 0.8..1.6_f32, s in 0.8..1.6_f32) {
        let physics = physics(r, s);
        let ours = Outline::of(&physics, Entity::Agent(AgentId::ZERO), &agent)
            .overlaps(&Outline::of(&physics, Entity::Object(ObjectId::ZERO), &object));
        // parry reports 0 for overlap, so overlap beyond the tolerance is tested with a smaller disc.
        let a = pose(&agent);
        let b = pose(&object);
        let apart = distance(&a, &polygon(r), &b, &Ball::new(s)).expect("supported").distance;
        let deep = distance(&a, &polygon(r), &b, &Ball::new(s - DOUBT)).expect("supported").distance;
        prop_assert!(!(ours && apart > DOUBT), "overlap seen, {apart} apart");
        prop_assert!(ours || deep > 0.0, "overlap missed");
    }

    #[test]
    fn trapezoids(one in body(), two in body(), r in 0.8..1.6_f32, s in 0.8..1.6_f32) {
        let mut physics = physics(r, 1.0);
        physics.agents[1].radius = s;
        let ours = Outline::of(&physics, Entity::Agent(AgentId::ZERO), &one)
            .overlaps(&Outline::of(&physics, Entity::Agent(AgentId::ONE), &two));
        let a = pose(&one);
        let b = pose(&two);
        let apart = distance(&a, &polygon(r), &b, &polygon(s)).expect("supported").distance;
        let deep = distance(&a, &polygon(r * 0.998), &b, &polygon(s * 0.998)).expect("supported").distance;
        prop_assert!(!(ours && apart > DOUBT), "overlap seen, {apart} apart");
        prop_assert!(ours || deep > 0.0, "overlap missed");
    }

    #[test]
    fn outline_and_wall(agent in body(), r in 0.8..1.6_f32, ends in prop::array::uniform4(-4.0..4.0_f32)) {
        let wall = Segment { a: Vec2::new(ends[0], ends[1]), b: Vec2::new(ends[2], ends[3]) };
        prop_assume!(wall.length() > 0.1);
        let theirs = ParrySegment::new(Vector::new(wall.a.x, wall.a.y), Vector::new(wall.b.x, wall.b.y));
        let physics = physics(r, r);
        let ours = Outline::of(&physics, Entity::Agent(AgentId::ZERO), &agent).overlaps_wall(wall);
        let apart =
            distance(&pose(&agent), &polygon(r), &Pose::identity(), &theirs).expect("supported").distance;
        let inner = polygon(r * 0.998);
        let deep = distance(&pose(&agent), &inner, &Pose::identity(), &theirs).expect("supported").distance;
        prop_assert!(!(ours && apart > DOUBT), "overlap seen, {apart} apart");
        prop_assert!(ours || deep > 0.0, "overlap missed");
        let disc = Outline::of(&physics, Entity::Object(ObjectId::ZERO), &agent).overlaps_wall(wall);
        let apart =
            distance(&pose(&agent), &Ball::new(r), &Pose::identity(), &theirs).expect("supported").distance;
        let inner = Ball::new(r - DOUBT);
        let deep = distance(&pose(&agent), &inner, &Pose::identity(), &theirs).expect("supported").distance;
        prop_assert!(!(disc && apart > DOUBT), "overlap seen, {apart} apart");
        prop_assert!(disc || deep > 0.0, "overlap missed");
    }
}

#[test]
fn forward_is_up_and_left_turns_are_positive() {
    let forward = phase_model::geometry::forward;
    assert!(forward(0.0).distance(Vec2::Y) < 1e-6);
    assert!(forward(PI / 2.0).distance(Vec2::NEG_X) < 1e-6);
}

#[test]
fn mass_and_inertia_of_a_trapezoid_by_integration() {
    // Midpoint sums over a fine grid, density 1.
    let radius = 1.2_f32;
    let mut mass = 0.0_f64;
    let mut moment = 0.0_f64;
    let cells = 600;
    let step = 2.0 * f64::from(radius) / f64::from(cells);
    for row in 0..cells {
        let y = -f64::from(radius) + (f64::from(row) + 0.5) * step;
        let half = 1.5 * f64::from(radius) - 0.5 * (y + f64::from(radius));
        let area = 2.0 * half * step;
        mass += area;
        // About the centre of mass: the strip's own ∫x² and its distance in y.
        let distance = y + f64::from(radius) / 6.0;
        moment += 2.0 * half.powi(3) / 3.0 * step + area * distance * distance;
    }
    let body = AgentBody { radius, max_force: 150.0 };
    assert!((f64::from(body.mass()) - mass).abs() < 1e-3 * mass);
    assert!((f64::from(body.inertia()) - moment).abs() < 1e-3 * moment, "{} {moment}", body.inertia());
}

//! Footprints compared with the shared outline tests of the model.

use crate::common::{any_body, any_physique};
use phase_model::{Body, Entity, ObjectId, PhysicsConfig, Size, Vec2, geometry::Outline};
use phase_perception::{Cell, footprint, footprint::covered};
use proptest::prelude::*;

#[test]
fn balls_in_the_middle_of_a_cell_lie_on_as_many_cells_as_counted_by_hand() {
    let physics = |size: Size| PhysicsConfig {
        walls: Vec::new(),
        agents: [phase_model::AgentBody { radius: 0.8, max_force: 300.0 }; 2],
        object_radii: [size.radius(); 2],
        object_count: 2,
    };
    let body = Body::at_rest(Vec2::new(10.5, 10.5), 0.0);
    let count = |size| footprint(&physics(size), Entity::Object(ObjectId::ZERO), &body).len();
    // The nearest corners of the diagonal neighbours are 0.707 u away, the next cells 1.5 u.
    assert_eq!(count(Size::Small), 9);
    assert_eq!(count(Size::Large), 9);
    assert_eq!(count(Size::Huge), 21);
    let cells = covered(&Outline::of(&physics(Size::Small), Entity::Object(ObjectId::ZERO), &body));
    assert_eq!(cells.iter().map(Cell::centre).collect::<Vec<_>>(), [body.position]);
}

#[test]
fn bodies_that_are_nowhere_lie_on_nothing() {
    let physics = PhysicsConfig {
        walls: Vec::new(),
        agents: [phase_model::AgentBody { radius: 1.6, max_force: 300.0 }; 2],
        object_radii: [1.6; 2],
        object_count: 2,
    };
    let places = [
        Vec2::NAN,
        Vec2::new(f32::NAN, 10.0),
        Vec2::INFINITY,
        Vec2::NEG_INFINITY,
        Vec2::splat(-50.0),
        Vec2::splat(1e30),
    ];
    for entity in physics.entities() {
        for place in places {
            let body = Body::at_rest(place, 0.3);
            assert!(footprint(&physics, entity, &body).is_empty(), "{entity:?} at {place}");
            assert!(covered(&Outline::of(&physics, entity, &body)).is_empty(), "{entity:?} at {place}");
        }
    }
}

/// A cell as a polygon, slightly smaller or larger than it is.
fn square(cell: Cell, grown: f32) -> [Vec2; 4] {
    let min = cell.min() - grown;
    let max = cell.min() + 1.0 + grown;
    [min, Vec2::new(max.x, min.y), max, Vec2::new(min.x, max.y)]
}

fn inside(outline: &Outline, point: Vec2) -> bool {
    // A tiny disc at the point.
    outline.overlaps(&Outline::Disc { centre: point, radius: 1e-4 })
}

proptest! {
    #[test]
    fn a_footprint_is_where_squares_overlap(physics in any_physique(), body in any_body()) {
        for entity in physics.entities() {
            let outline = Outline::of(&physics, entity, &body);
            let cells = footprint(&physics, entity, &body);
            let wholly = covered(&outline);
            for cell in Cell::all() {
                let surely = outline.overlaps(&Outline::Trapezoid(square(cell, -1e-3)));
                let perhaps = outline.overlaps(&Outline::Trapezoid(square(cell, 1e-3)));
                prop_assert!(!surely || cells.contains(cell), "{entity:?} {cell:?} is missing");
                prop_assert!(perhaps || !cells.contains(cell), "{entity:?} {cell:?} is too much");
                let covers = |grown: f32| square(cell, grown).iter().all(|&corner| inside(&outline, corner));
                prop_assert!(!covers(1e-3) || wholly.contains(cell), "{entity:?} covers {cell:?}");
                prop_assert!(covers(-1e-3) || !wholly.contains(cell), "{entity:?} bares {cell:?}");
            }
        }
    }
}

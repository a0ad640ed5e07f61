//! The observable part of an event.

use phase_event::{ObservedError, ObservedEvent};
use phase_model::{Body, Entity, Layout, MAX_ENTITIES, Size, Vec2};

fn event(rows: Vec<[Body; MAX_ENTITIES]>, objects: usize) -> Result<ObservedEvent, ObservedError> {
    let layout = Layout::new(0, None).expect("layout 0 exists");
    ObservedEvent::new(layout, [Size::Small, Size::Huge], vec![Size::Large; objects], rows)
}

fn row(x: f32) -> [Body; MAX_ENTITIES] {
    [Body::at_rest(Vec2::new(x, 0.0), 0.0); MAX_ENTITIES]
}

#[test]
fn nonsense_is_refused() {
    let mut absent = row(1.0);
    absent[3].angle = f32::NAN;
    let mut present = row(1.0);
    present[1].velocity.y = f32::INFINITY;
    let cases: [(Vec<[Body; MAX_ENTITIES]>, usize, Option<ObservedError>); 5] = [
        (vec![], 0, Some(ObservedError::Empty)),
        (vec![row(1.0)], 3, Some(ObservedError::TooManyObjects)),
        (vec![row(1.0), present], 1, Some(ObservedError::NotFinite(1))),
        (vec![absent], 2, Some(ObservedError::NotFinite(0))),
        // The slot of an absent body may contain any value.
        (vec![absent], 1, None),
    ];
    for (rows, objects, expected) in cases {
        assert_eq!(event(rows, objects).err(), expected);
    }
}

#[test]
fn watching_for_a_while_hides_what_comes_later() {
    let whole = event((0..10).map(|t| row(t as f32)).collect(), 1).expect("is sound");
    let part = whole.prefix(4);
    assert_eq!(part.steps(), 4);
    assert_eq!(part.rows(), &whole.rows()[..5]);
    assert_eq!(part.state(5), None);
    assert_eq!(whole.prefix(usize::MAX), whole);
    assert_eq!(whole.entities().collect::<Vec<_>>(), [0, 1, 2].map(|index| Entity::ALL[index]));
}

#[test]
fn the_physics_has_the_seen_sizes_and_the_supposed_forces() {
    let physics = event(vec![row(0.0)], 1).expect("is sound").physics([150.0, 450.0]);
    assert_eq!(physics.agents.map(|agent| agent.radius), [0.8, 1.6]);
    assert_eq!(physics.agents.map(|agent| agent.max_force), [150.0, 450.0]);
    assert_eq!((physics.object_count, physics.object_radii[0]), (1, 1.2));
}

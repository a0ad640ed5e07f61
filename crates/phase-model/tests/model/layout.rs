//! Layouts against the published table, and reflections against each other.

use phase_model::{
    AgentBody, AgentId, Body, Entity, Flip, LandmarkId, Layout, LayoutError, MAX_ENTITIES, ObjectId,
    PhysicsConfig, RoomId, Segment, SlotId, State, Vec2, arena, layout::room_of,
};
use proptest::prelude::*;

fn segment(a: (f32, f32), b: (f32, f32)) -> Segment {
    Segment { a: Vec2::new(a.0, a.1), b: Vec2::new(b.0, b.1) }
}

#[test]
fn walls_of_known_layouts() {
    let cases = [
        (0, None, vec![]),
        (1, None, vec![segment((16., 12.), (16., 22.)), segment((11., 12.), (6., 12.))]),
        (4, None, vec![segment((16., 12.), (16., 22.)), segment((16., 12.), (8.5, 12.))]),
        (11, None, vec![segment((16., 12.), (16., 22.)), segment((16., 9.5), (16., 2.))]),
        (
            20,
            Some(Flip::AntiDiagonal),
            vec![
                segment((16., 12.), (16., 22.)),
                segment((16., 12.), (8.5, 12.)),
                segment((16., 12.), (16., 7.)),
                segment((16., 12.), (23.5, 12.)),
            ],
        ),
    ];
    for (base, flip, expected) in cases {
        assert_eq!(Layout::new(base, flip).unwrap().walls(), expected, "{base} {flip:?}");
    }
}

#[test]
fn ninety_layouts_of_which_seventy_eight_differ() {
    let mut walls: Vec<String> = Layout::all_used().map(|layout| format!("{:?}", layout.walls())).collect();
    assert_eq!(walls.len(), 90);
    walls.sort();
    walls.dedup();
    assert_eq!(walls.len(), 78);
}

#[test]
fn a_layout_past_the_last_is_an_error() {
    assert_eq!(Layout::new(22, None), Err(LayoutError::Base(22)));
    assert_eq!(Flip::try_from(4), Err(LayoutError::Flip(4)));
}

#[test]
fn landmarks_move_with_their_points() {
    for flip in Flip::ALL {
        for (landmark, centre) in LandmarkId::ALL.into_iter().zip(arena::LANDMARKS) {
            let image = flip.point(centre);
            assert_eq!(image, arena::LANDMARKS[flip.landmark(landmark)], "{flip:?} {landmark}");
            assert_eq!(room_of(image), flip.room(landmark.room()));
        }
    }
}

#[test]
fn start_points_lie_in_their_rooms() {
    for (room, points) in RoomId::ALL.into_iter().zip(arena::START_POINTS) {
        assert!(points.iter().all(|&point| room_of(point) == room));
    }
}

proptest! {
    #[test]
    fn flipped_walls_are_the_images_of_the_walls(base in 0..22_u8, flip in 0..4_u8) {
        let flip = Flip::try_from(flip).unwrap();
        let normal = |segment: &Segment| {
            let a = segment.a;
            let b = segment.b;
            if (a.x, a.y) < (b.x, b.y) { format!("{a}{b}") } else { format!("{b}{a}") }
        };
        let mut images: Vec<String> = Layout::new(base, None).unwrap().walls().iter()
            .map(|wall| normal(&Segment { a: flip.point(wall.a), b: flip.point(wall.b) }))
            .collect();
        let mut walls: Vec<String> =
            Layout::new(base, Some(flip)).unwrap().walls().iter().map(normal).collect();
        images.sort();
        walls.sort();
        prop_assert_eq!(images, walls);
    }

    #[test]
    fn a_flip_twice_is_no_flip(
        flip in 0..4_u8,
        x in 6.0..26.0_f32,
        y in 2.0..22.0_f32,
        angle in -9.0..9.0_f32,
    ) {
        let flip = Flip::try_from(flip).unwrap();
        let point = Vec2::new(x, y);
        prop_assert!(flip.point(flip.point(point)).distance(point) < 1e-5);
        prop_assert!((flip.angle(flip.angle(angle)) - angle).abs() < 1e-5);
    }

    #[test]
    fn headings_flip_as_vectors(flip in 0..4_u8, angle in -9.0..9.0_f32) {
        let flip = Flip::try_from(flip).unwrap();
        let image = phase_model::geometry::forward(flip.angle(angle));
        let vector = flip.vector(phase_model::geometry::forward(angle));
        prop_assert!(image.distance(vector) < 1e-4);
    }

    #[test]
    fn walls_and_openings_fill_every_slot(base in 0..22_u8, slot in 0..4_usize) {
        let layout = Layout::new(base, None).unwrap();
        let direction = phase_model::layout::SLOT_DIRECTIONS[slot];
        let open = layout.opening(SlotId::ALL[slot]).map_or(0.0, Segment::length);
        let walled: f32 = layout.walls().iter()
            .filter(|wall| (wall.b - wall.a).normalize().abs() == direction.abs())
            .filter(|wall| (wall.middle() - arena::CENTRE).dot(direction) > 0.0)
            .map(|wall| wall.length())
            .sum();
        prop_assert!((open + walled - 10.0).abs() < 1e-4);
    }
}

/// A door 2.5 u wide, through which an agent of radius 1.01 u puts its head; its base is 3.03 u wide.
#[test]
fn an_agent_in_a_door_too_narrow_for_its_base_is_on_the_side_of_its_base() {
    let layout = Layout::new(4, Some(Flip::Diagonal)).expect("there is such a layout");
    let wide = AgentBody { radius: 1.01, max_force: 450.0 };
    let narrow = AgentBody { radius: 0.8, max_force: 450.0 };
    let physics = PhysicsConfig {
        walls: layout.walls(),
        agents: [wide, narrow],
        object_radii: [0.8; 2],
        object_count: 1,
    };
    let mut state = State::new([Body::default(); MAX_ENTITIES]);
    let place = |state: &State, entity: Entity| layout.place_of(&physics, state, entity);
    let first = Entity::Agent(AgentId::ZERO);
    let second = Entity::Agent(AgentId::ONE);
    // Heading for −x, its origin past the wall's line at x = 16.
    let west = core::f32::consts::FRAC_PI_2;
    for entity in [first, second, Entity::Object(ObjectId::ZERO)] {
        *state.body_mut(entity) = Body::at_rest(Vec2::new(15.9, 3.2), west);
    }
    let before = place(&state, first);
    assert!(before.x > 16.0 && before.distance(Vec2::new(16.0, 3.2)) < 0.05, "{before}");
    assert_eq!(room_of(before), RoomId::BOTTOM_RIGHT);
    assert_eq!(place(&state, second), Vec2::new(15.9, 3.2), "it fits through");
    assert_eq!(place(&state, Entity::Object(ObjectId::ZERO)), Vec2::new(15.9, 3.2));
    // From the other side, its place is on the other side.
    *state.body_mut(first) = Body::at_rest(Vec2::new(16.1, 3.2), -west);
    assert_eq!(room_of(place(&state, first)), RoomId::BOTTOM_LEFT);
    // Along the wall, with origin and base on one side, it is where it is.
    *state.body_mut(first) = Body::at_rest(Vec2::new(16.6, 3.2), 0.0);
    assert_eq!(place(&state, first), Vec2::new(16.6, 3.2));
    // An open slot closes for nobody.
    *state.body_mut(first) = Body::at_rest(Vec2::new(9.0, 11.9), 0.0);
    assert_eq!(place(&state, first), Vec2::new(9.0, 11.9));
}

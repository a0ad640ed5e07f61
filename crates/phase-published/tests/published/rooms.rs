//! Doors, ways and distances, against the table of layouts.

use phase_model::{Layout, RoomId, Size, Vec2, layout::USED_BASES};
use phase_published::Rooms;

const TL: RoomId = RoomId::TOP_LEFT;
const TR: RoomId = RoomId::TOP_RIGHT;
const BR: RoomId = RoomId::BOTTOM_RIGHT;
const BL: RoomId = RoomId::BOTTOM_LEFT;

fn rooms(base: u8) -> Rooms {
    Rooms::new(Layout::new(base, None).unwrap())
}

#[test]
fn doors_are_crossed_in_their_middle() {
    let four = rooms(4);
    assert!(four.door(TL, TR).is_none());
    assert_eq!(four.door(TL, BL).unwrap().middle(), Vec2::new(7.25, 12.0));
    assert_eq!(four.door(BL, BR).unwrap().middle(), Vec2::new(16.0, 7.0));
    assert_eq!(four.door(BR, TR).unwrap().middle(), Vec2::new(21.0, 12.0));
    assert_eq!(rooms(9).door(TL, TR).unwrap().middle(), Vec2::new(16.0, 19.5));
    assert_eq!(rooms(10).door(TL, TR).unwrap().middle(), Vec2::new(16.0, 20.75));
}

#[test]
fn rooms_form_a_chain() {
    for base in USED_BASES.into_iter().filter(|&base| base != 0) {
        let chain = if [9, 10, 15, 20].contains(&base) { [TL, TR, BR, BL] } else { [TL, BL, BR, TR] };
        let rooms = rooms(base);
        assert_eq!(rooms.way(chain[0], chain[3]), Some(&chain[..]), "layout {base}");
        assert_eq!(rooms.next(chain[3], chain[0]), chain[2]);
        assert_eq!(rooms.next(chain[1], chain[1]), chain[1]);
    }
}

#[test]
fn distances_go_through_doors() {
    let a = Vec2::new(8.0, 20.0);
    let b = Vec2::new(24.0, 20.0);
    assert_eq!(rooms(0).distance(a, b), 16.0);
    let legs = [a, Vec2::new(7.25, 12.0), Vec2::new(16.0, 7.0), Vec2::new(21.0, 12.0), b];
    let through: f32 = legs.windows(2).map(|leg| leg[0].distance(leg[1])).sum();
    assert!((rooms(4).distance(a, b) - f64::from(through)).abs() < 1e-4);
}

#[test]
fn a_room_is_as_far_as_its_corner_if_it_is_next() {
    let four = rooms(4);
    let here = Vec2::new(10.0, 10.0);
    assert!((four.room_distance(here, BL) - f64::from(here.distance(Vec2::new(7.25, 3.25)))).abs() < 1e-5);
    let door = Vec2::new(7.25, 12.0);
    let corner = Vec2::new(7.25, 20.75);
    assert!(
        (four.room_distance(here, TL) - f64::from(here.distance(door) + door.distance(corner))).abs() < 1e-5
    );
    assert!((four.room_distance(here, TR) - 800.0_f64.sqrt()).abs() < 1e-9);
}

/// One who carries needs three times its size: doors of 2.5 u pass the smallest only, doors of 5 u all.
#[test]
fn doors_block_by_size() {
    for size in Size::ALL {
        let needed = 1.5 * size.radius();
        assert_eq!(rooms(4).blocked(TL, BL, needed), size != Size::Small, "{size:?}");
        assert!(!rooms(2).blocked(TL, BL, needed), "{size:?}");
        assert!(!rooms(0).blocked(TL, BR, 100.0));
    }
    // As circles, all but the largest pass a door of 2.5 u.
    for size in Size::ALL {
        assert_eq!(rooms(4).blocked(TL, BL, size.radius()), size == Size::Huge, "{size:?}");
    }
}

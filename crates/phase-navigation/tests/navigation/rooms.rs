//! Rooms and the ways between them, against the table of layouts.

use phase_model::{Layout, RoomId};
use phase_navigation::Map;

fn map(base: u8) -> Map {
    Map::new(Layout::new(base, None).expect("a layout"))
}

/// Layout 4: rooms 0 and 1 are walled off from each other, 0 and 3 are joined by a door of 2.5 u.
#[test]
fn ways_use_openings_that_are_wide_enough() {
    let rooms = |width: f32| {
        map(4)
            .way(RoomId::TOP_RIGHT, RoomId::TOP_LEFT, width)
            .map(|way| way.iter().map(|crossing| crossing.to).collect::<Vec<_>>())
    };
    assert_eq!(rooms(2.4), Some(vec![RoomId::BOTTOM_RIGHT, RoomId::BOTTOM_LEFT, RoomId::TOP_LEFT]));
    assert_eq!(rooms(2.6), None);
}

/// Without walls there are two ways between any two rooms, over one opening and three or over two each.
#[test]
fn ways_are_those_around_the_ring() {
    let open = map(0);
    for from in RoomId::ALL {
        assert!(open.ways(from, from).is_empty());
        for to in RoomId::ALL.into_iter().filter(|&to| to != from) {
            let lengths: Vec<usize> = open.ways(from, to).iter().map(Vec::len).collect();
            let is_opposite = from.index().abs_diff(to.index()) == 2;
            assert_eq!(lengths, if is_opposite { [2, 2] } else { [1, 3] });
            for way in open.ways(from, to) {
                let ends = way.first().zip(way.last()).map(|(first, last)| (first.from, last.to));
                assert_eq!(ends, Some((from, to)));
                assert!(way.windows(2).all(|pair| pair[0].to == pair[1].from));
            }
        }
    }
}

/// In layout 16 the rooms form the chain 1, 2, 3, 0; without walls they form a ring.
#[test]
fn regions_are_what_is_left_without_a_room() {
    let of = |base, room| {
        let mut regions = map(base).regions_around(room);
        regions.iter_mut().for_each(|region| region.sort_unstable());
        regions
    };
    let top_left = RoomId::TOP_LEFT;
    let top_right = RoomId::TOP_RIGHT;
    let bottom_left = RoomId::BOTTOM_LEFT;
    let bottom_right = RoomId::BOTTOM_RIGHT;
    assert_eq!(of(16, bottom_right), [vec![top_right], vec![top_left, bottom_left]]);
    assert_eq!(of(16, bottom_left), [vec![top_left], vec![top_right, bottom_right]]);
    assert_eq!(of(16, top_left).len(), 1);
    assert_eq!(of(0, top_left).len(), 1);
}

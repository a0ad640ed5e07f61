//! Rooms, the openings between them, and ways through these, by geometry alone.

use phase_model::{
    Layout, RoomId, Segment, SlotId, Vec2,
    layout::{SLOT_LENGTH, SLOT_ROOMS, room_of},
};

/// The way through the opening of a slot, in one direction.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Crossing {
    /// The slot.
    pub slot: SlotId,
    /// The room before it.
    pub from: RoomId,
    /// The room after it.
    pub to: RoomId,
    /// The open part of the slot.
    pub opening: Segment,
}

impl Crossing {
    /// Whether a wall narrows the slot.
    #[must_use]
    pub(crate) fn is_door(&self) -> bool {
        self.opening.length() < SLOT_LENGTH
    }

    /// The point in the opening, at half a width from its ends, that is nearest to a point.
    fn nearest(&self, point: Vec2, width: f32) -> Vec2 {
        let Segment { a, b } = self.opening;
        let inset = (b - a) * (0.5 * width / self.opening.length()).min(0.5);
        Segment { a: a + inset, b: b - inset }.nearest(point)
    }
}

/// A way between two points.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Walk {
    /// The openings it goes through, in order.
    pub crossings: Vec<Crossing>,
    /// Its length, from each point to the nearest of the next opening (u). An upper bound of the shortest way.
    pub length: f32,
}

/// All crossings of a layout, by slot, in both directions.
fn crossings(layout: Layout) -> impl Iterator<Item = Crossing> {
    let open = move |slot: SlotId| layout.opening(slot).map(|opening| (slot, opening));
    SlotId::ALL.into_iter().filter_map(open).flat_map(|(slot, opening)| {
        let (a, b) = SLOT_ROOMS[slot];
        [(a, b), (b, a)].map(|(from, to)| Crossing { slot, from, to, opening })
    })
}

/// The crossings from room to room, as few as possible, of openings at least this wide (u). `None` if there
/// is no such way.
#[must_use]
pub(crate) fn route(layout: Layout, from: RoomId, to: RoomId, width: f32) -> Option<Vec<Crossing>> {
    let passable: Vec<Crossing> =
        crossings(layout).filter(|crossing| crossing.opening.length() >= width).collect();
    let mut reached = vec![from];
    let mut ways: Vec<Vec<Crossing>> = vec![Vec::new()];
    let mut next = 0;
    // Breadth first: `ways[k]` leads to `reached[k]`.
    while let (Some(&room), Some(way)) = (reached.get(next), ways.get(next).cloned()) {
        if room == to {
            return Some(way);
        }
        for crossing in passable.iter().filter(|crossing| crossing.from == room) {
            if !reached.contains(&crossing.to) {
                reached.push(crossing.to);
                ways.push(way.iter().chain([crossing]).copied().collect());
            }
        }
        next += 1;
    }
    None
}

/// The way of a body of this width (u) between two points, if it fits through the openings.
#[must_use]
pub(crate) fn walk(layout: Layout, from: Vec2, to: Vec2, width: f32) -> Option<Walk> {
    let crossings = route(layout, room_of(from), room_of(to), width)?;
    let (mut length, mut here) = (0.0, from);
    for crossing in &crossings {
        let there = crossing.nearest(here, width);
        length += here.distance(there);
        here = there;
    }
    Some(Walk { crossings, length: length + here.distance(to) })
}

/// The other rooms, grouped by whether they are connected without this one; the smaller groups first.
#[must_use]
pub(crate) fn regions_around(layout: Layout, room: RoomId) -> Vec<Vec<RoomId>> {
    let mut regions: Vec<Vec<RoomId>> = Vec::new();
    for other in RoomId::ALL.into_iter().filter(|&other| other != room) {
        let neighbours: Vec<RoomId> =
            crossings(layout).filter(|crossing| crossing.from == other).map(|crossing| crossing.to).collect();
        let (joined, apart): (Vec<_>, Vec<_>) = regions
            .into_iter()
            .partition(|region: &Vec<RoomId>| region.iter().any(|room| neighbours.contains(room)));
        regions = apart;
        regions.push(joined.into_iter().flatten().chain([other]).collect());
    }
    regions.sort_by_key(Vec::len);
    regions
}

#[cfg(test)]
mod tests {
    use super::{regions_around, route, walk};
    use phase_model::{Layout, RoomId, Vec2};

    fn layout(base: u8) -> Layout {
        Layout::new(base, None).expect("a layout")
    }

    /// Layout 4: rooms 0 and 1 are walled off from each other, 0 and 3 are joined by a door of 2.5 u.
    #[test]
    fn routes_use_openings_that_are_wide_enough() {
        let rooms = |width: f32| {
            route(layout(4), RoomId::TOP_RIGHT, RoomId::TOP_LEFT, width)
                .map(|way| way.iter().map(|crossing| crossing.to).collect::<Vec<_>>())
        };
        assert_eq!(rooms(2.4), Some(vec![RoomId::BOTTOM_RIGHT, RoomId::BOTTOM_LEFT, RoomId::TOP_LEFT]));
        assert_eq!(rooms(2.6), None);
    }

    /// The door of layout 4 between rooms 0 and 3 is from x = 6 to 8.5 at y = 12; a body of width 2 is at
    /// least 1 u from its ends.
    #[test]
    fn walks_go_through_the_nearest_points_of_openings() {
        let way = walk(layout(4), Vec2::new(7.5, 9.0), Vec2::new(7.5, 15.0), 2.0).expect("a way");
        assert_eq!((way.crossings.len(), way.length), (1, 6.0));
        let aside = walk(layout(4), Vec2::new(11.5, 9.0), Vec2::new(11.5, 15.0), 2.0).expect("a way");
        assert!((aside.length - 10.0).abs() < 1e-5, "two hypotenuses of 3, 4, 5: {}", aside.length);
        let here = walk(layout(4), Vec2::new(7.0, 9.0), Vec2::new(10.0, 5.0), 9.0).expect("a way");
        assert_eq!((here.crossings.len(), here.length), (0, 5.0));
    }

    /// In layout 16 the rooms form the chain 1, 2, 3, 0; without walls they form a ring.
    #[test]
    fn regions_are_what_is_left_without_a_room() {
        let of = |base, room| {
            let mut regions = regions_around(layout(base), room);
            regions.iter_mut().for_each(|region| region.sort_unstable());
            regions
        };
        let (top_left, top_right) = (RoomId::TOP_LEFT, RoomId::TOP_RIGHT);
        let (bottom_left, bottom_right) = (RoomId::BOTTOM_LEFT, RoomId::BOTTOM_RIGHT);
        assert_eq!(of(16, bottom_right), [vec![top_right], vec![top_left, bottom_left]]);
        assert_eq!(of(16, bottom_left), [vec![top_left], vec![top_right, bottom_right]]);
        assert_eq!(of(16, top_left).len(), 1);
        assert_eq!(of(0, top_left).len(), 1);
    }
}

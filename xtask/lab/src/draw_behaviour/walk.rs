//! Ways of bodies through openings that they fit through, and the length of these ways.

use phase_model::{Layout, Segment, Vec2, layout::room_of};
use phase_navigation::{Crossing, Map};

/// A way between two points.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Walk {
    /// The openings it goes through, in order.
    pub crossings: Vec<Crossing>,
    /// Its length, from each point to the nearest of the next opening (u). An upper bound of the shortest
    /// way.
    pub length: f32,
}

/// The way of a body of this width (u) between two points, if it fits through the openings.
#[must_use]
pub(super) fn walk(layout: Layout, from: Vec2, to: Vec2, width: f32) -> Option<Walk> {
    let map = Map::new(layout);
    let crossings = map.way(room_of(from), room_of(to), width)?;
    let mut length = 0.0;
    let mut here = from;
    for crossing in crossings {
        let there = nearest(crossing.opening, here, width);
        length += here.distance(there);
        here = there;
    }
    Some(Walk { crossings: crossings.to_vec(), length: length + here.distance(to) })
}

/// The point in an opening, at half a width from its ends, that is nearest to a point.
fn nearest(opening: Segment, point: Vec2, width: f32) -> Vec2 {
    let Segment { a, b } = opening;
    let inset = (b - a) * (0.5 * width / opening.length()).min(0.5);
    Segment { a: a + inset, b: b - inset }.nearest(point)
}

#[cfg(test)]
mod tests {
    use super::walk;
    use phase_model::{Layout, Vec2};

    /// The door of layout 4 between rooms 0 and 3 is from x = 6 to 8.5 at y = 12; a body of width 2 is at
    /// least 1 u from its ends.
    #[test]
    fn walks_go_through_the_nearest_points_of_openings() {
        let layout = Layout::new(4, None).expect("a layout");
        let way = walk(layout, Vec2::new(7.5, 9.0), Vec2::new(7.5, 15.0), 2.0).expect("a way");
        assert_eq!((way.crossings.len(), way.length), (1, 6.0));
        let aside = walk(layout, Vec2::new(11.5, 9.0), Vec2::new(11.5, 15.0), 2.0).expect("a way");
        assert!((aside.length - 10.0).abs() < 1e-5, "two hypotenuses of 3, 4, 5: {}", aside.length);
        let here = walk(layout, Vec2::new(7.0, 9.0), Vec2::new(10.0, 5.0), 9.0).expect("a way");
        assert_eq!((here.crossings.len(), here.length), (0, 5.0));
    }
}

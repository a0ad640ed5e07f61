//! Clipping a side of one shape at the ends of a face of another, with names for the resulting points.

use phase_model::Vec2;

/// The name of a contact point: for each of two shapes a corner or a side, and its number.
pub(crate) const fn name(first_is_corner: bool, first: usize, second_is_corner: bool, second: usize) -> u16 {
    const fn half(is_corner: bool, number: usize) -> u16 {
        (number as u16) << 1 | is_corner as u16
    }
    half(first_is_corner, first) << 8 | half(second_is_corner, second)
}

/// Clips a line of two named points at the two ends of a face, given as (corner, leeway, number). `tangent`
/// leads from the first end to the second. `None` if nothing remains.
#[inline]
pub(crate) fn clip(
    line: [(Vec2, u16); 2],
    tangent: Vec2,
    ends: [(Vec2, f32, usize); 2],
) -> Option<[(Vec2, u16); 2]> {
    let once = clip_at(line, -tangent, ends[0])?;
    clip_at(once, tangent, ends[1])
}

/// Keeps the part behind the plane through a corner.
#[inline]
fn clip_at(
    line: [(Vec2, u16); 2],
    outward: Vec2,
    (corner, leeway, number): (Vec2, f32, usize),
) -> Option<[(Vec2, u16); 2]> {
    let limit = outward.dot(corner) + leeway;
    let beyond = [outward.dot(line[0].0) - limit, outward.dot(line[1].0) - limit];
    match (beyond[0] <= 0.0, beyond[1] <= 0.0) {
        (true, true) => Some(line),
        (false, false) => None,
        (first_stays, _) => {
            let share = beyond[0] / (beyond[0] - beyond[1]);
            let cut = line[0].0 + (line[1].0 - line[0].0) * share;
            // The cut point lies where a corner of the face meets a side of the line.
            let named = (cut, name(true, number, false, usize::from((line[0].1 & 0xff) >> 1)));
            // The point that is kept comes first, whichever it was.
            Some(if first_stays { [line[0], named] } else { [line[1], named] })
        }
    }
}

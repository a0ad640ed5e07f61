//! The passable parts of the four slots, which bodies narrow.

use phase_model::{Layout, SlotId, Vec2, arena, layout::SLOT_DIRECTIONS};

/// The passable part of each slot, as distances from the arena's centre (u, 0 to 10, the nearer end first);
/// `None` where walls or bodies leave nothing.
///
/// [`Map::gaps`](crate::Map::gaps) has those of a layout without bodies. Bodies narrow a copy of them:
///
/// ```
/// use phase_model::{Layout, SlotId, Vec2};
/// use phase_navigation::Map;
///
/// let map = Map::new(Layout::new(4, None)?); // a door of 2.5 u on the left, from x = 6 to 8.5
/// let mut gaps = *map.gaps();
/// gaps.obstruct(Vec2::new(8.5, 12.0), 0.8, 1.6);
/// assert!((gaps.width(SlotId::LEFT) - 1.7).abs() < 1e-5);
/// # Ok::<(), phase_model::LayoutError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Gaps(pub [Option<(f32, f32)>; 4]);

impl Gaps {
    /// The openings of a layout.
    pub(crate) fn of(layout: Layout) -> Self {
        Self(SlotId::ALL.map(|slot| {
            let along = |point: Vec2| (point - arena::CENTRE).dot(SLOT_DIRECTIONS[slot]);
            layout.opening(slot).map(|opening| (along(opening.a), along(opening.b)))
        }))
    }

    /// Width of the passage in a slot (u); 0 where there is none.
    #[must_use]
    pub fn width(&self, slot: SlotId) -> f32 {
        self.0[slot].map_or(0.0, |(from, to)| to - from)
    }

    /// Middle of the passage in a slot (u); `None` where there is none.
    #[must_use]
    pub fn middle(&self, slot: SlotId) -> Option<Vec2> {
        self.0[slot].map(|(low, high)| point_in(slot, 0.5 * (low + high)))
    }

    /// Removes a round obstacle from every door that it lies in or before; the wider remainder stays. An
    /// obstacle counts where the line of the slot is closer to its centre than `reach` (u).
    pub fn obstruct(&mut self, centre: Vec2, radius: f32, reach: f32) {
        let offset = centre - arena::CENTRE;
        for (slot, direction) in SlotId::ALL.into_iter().zip(SLOT_DIRECTIONS) {
            if direction.perp_dot(offset).abs() >= reach {
                continue;
            }
            let along = direction.dot(offset);
            if let Some((from, to)) = self.0[slot] {
                let low = (along - radius).clamp(from, to);
                let high = (along + radius).clamp(from, to);
                if low < high {
                    self.0[slot] = wider(low - from, to - high, (from, low), (high, to));
                }
            }
        }
    }
}

/// The wider of two remainders, which have these widths; `None` if nothing is left of either.
fn wider(below: f32, above: f32, first: (f32, f32), second: (f32, f32)) -> Option<(f32, f32)> {
    match (below > 0.0, above > 0.0) {
        (false, false) => None,
        _ if below >= above => Some(first),
        _ => Some(second),
    }
}

/// The point of a slot at a distance from the centre (u).
pub(crate) fn point_in(slot: SlotId, distance: f32) -> Vec2 {
    arena::CENTRE + SLOT_DIRECTIONS[slot] * distance
}

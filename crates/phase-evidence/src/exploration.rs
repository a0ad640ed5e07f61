//! The region that an agent explored first.

use crate::Track;
use phase_model::layout::room_of;
use phase_model::{AgentId, RoomId};
use phase_perception::{Cell, CellSet, observe};

/// Of several regions, each a list of rooms, the one of which an agent first came to see half of the part
/// that it did not see at the start, and when. `None` if it never saw that much of any, or saw everything
/// from the start.
#[must_use]
pub fn searched_first(track: &Track, agent: AgentId, regions: &[&[RoomId]]) -> Option<(usize, usize)> {
    let first = track.states.first()?;
    let seen_at_start = observe(&track.physics, first, agent).visible;
    let unseen: Vec<CellSet> = regions
        .iter()
        .map(|rooms| {
            let inside = |cell: &Cell| rooms.contains(&room_of(cell.centre()));
            Cell::all().filter(inside).filter(|&cell| !seen_at_start.contains(cell)).collect()
        })
        .collect();
    let mut seen: Vec<CellSet> = vec![CellSet::EMPTY; regions.len()];
    for (t, state) in track.states.iter().enumerate() {
        let visible = observe(&track.physics, state, agent).visible;
        for (region, (seen, unseen)) in seen.iter_mut().zip(&unseen).enumerate() {
            unseen.iter().filter(|&cell| visible.contains(cell)).for_each(|cell| seen.insert(cell));
            if !unseen.is_empty() && 2 * seen.len() >= unseen.len() {
                return Some((region, t));
            }
        }
    }
    None
}

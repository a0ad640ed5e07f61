//! Ways from room to room.

use phase_model::{
    Layout, RoomId, Segment, SlotId,
    layout::{SLOT_LENGTH, SLOT_ROOMS},
};

/// The step through the opening of a slot, in one direction.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Crossing {
    /// The slot.
    pub slot: SlotId,
    /// The room before it.
    pub from: RoomId,
    /// The room behind it.
    pub to: RoomId,
    /// The opening: the part of the slot that walls leave free (u).
    pub opening: Segment,
}

impl Crossing {
    /// Whether a wall narrows the slot, so that the opening is a door.
    #[must_use]
    pub fn is_door(&self) -> bool {
        self.opening.length() < SLOT_LENGTH
    }

    /// The steps out of a room of a layout, by slot.
    pub fn out_of(layout: Layout, room: RoomId) -> impl Iterator<Item = Self> {
        SlotId::ALL.into_iter().filter_map(move |slot| {
            let (a, b) = SLOT_ROOMS[slot];
            let is_beside = a == room || b == room;
            let opening = layout.opening(slot).filter(|_| is_beside)?;
            Some(Self { slot, from: room, to: slot.beyond(room), opening })
        })
    }
}

/// All ways between any two rooms that visit no room twice, by the rooms at both ends.
pub(crate) type Ways = [[Vec<Vec<Crossing>>; 4]; 4];

/// The ways through the openings of a layout. Those through fewer openings come first, then those whose slots
/// have the lower numbers: ties between ways are broken in this order.
pub(crate) fn ways(layout: Layout) -> Ways {
    let mut all: Ways = Default::default();
    for start in RoomId::ALL {
        let mut open: Vec<Vec<Crossing>> = vec![Vec::new()];
        while let Some(way) = open.pop() {
            let here = way.last().map_or(start, |last| last.to);
            let is_new = |next: &Crossing| next.to != start && way.iter().all(|step| step.to != next.to);
            open.extend(
                Crossing::out_of(layout, here).filter(is_new).map(|next| [&way[..], &[next]].concat()),
            );
            if here != start {
                all[start][here].push(way);
            }
        }
    }
    let slots = |way: &Vec<Crossing>| -> Vec<SlotId> { way.iter().map(|step| step.slot).collect() };
    for ways in all.iter_mut().flatten() {
        ways.sort_by_key(|way| (way.len(), slots(way)));
    }
    all
}

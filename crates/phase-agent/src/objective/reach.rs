//! An agent's own way to a target.

use super::way::LOOK_AHEAD;
use phase_model::{SlotId, Vec2, arena, layout::SLOT_DIRECTIONS};
use phase_navigation::{Field, Map, Mover};
use std::sync::Arc;

/// Tolerance of a point on the line of a slot (u).
const ON_LINE: f32 = 1e-3;

/// The way of an agent to a target.
#[derive(Clone, Debug)]
pub(crate) struct Reach {
    field: Arc<Field>,
    /// Where the way first crosses a door that the agent does not fit through (u).
    closed_door: Option<Vec2>,
    /// Distance from such a door at which the agent waits (u): it leaves room for others to come through.
    waiting: f32,
}

impl Reach {
    /// The way from a place (u).
    pub(crate) fn new(field: Arc<Field>, map: &Map, mover: Mover, from: Vec2) -> Self {
        let is_closed = |point: &Vec2| {
            let offset = *point - arena::CENTRE;
            SlotId::ALL.into_iter().zip(SLOT_DIRECTIONS).any(|(slot, along)| {
                along.perp_dot(offset).abs() < ON_LINE && along.dot(offset) > 0.0 && !map.fits(slot, mover)
            })
        };
        let closed_door = if field.closed_doors(from) > 0 { field.path(from).find(is_closed) } else { None };
        Self { field, closed_door, waiting: 4.0 * mover.half_width }
    }

    pub(crate) const fn closed_door(&self) -> Option<Vec2> {
        self.closed_door
    }

    /// Distance to go (u); before a closed door nothing is gained by standing in it.
    pub(crate) fn distance(&self, here: Vec2) -> f32 {
        let waiting = self.closed_door.map_or(0.0, |door| (self.waiting - here.distance(door)).max(0.0));
        self.field.distance(here) + waiting
    }

    /// The point to head for (u).
    pub(crate) fn waypoint(&self, here: Vec2) -> Vec2 {
        match self.closed_door {
            Some(door) if here.distance(door) < self.waiting => here,
            _ => self.field.waypoint(here, LOOK_AHEAD),
        }
    }
}

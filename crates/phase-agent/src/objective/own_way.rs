//! An agent's own way to a target.

use phase_model::{SlotId, Vec2, arena, layout::SLOT_DIRECTIONS};
use phase_navigation::{Field, Map, Mover};
use std::sync::Arc;

/// Distance (u) of a point from a line up to which it lies on it. It allows for rounding and shapes no
/// behaviour.
const ROUNDING: f32 = 1e-3;

/// The way of an agent to a target.
#[derive(Clone, Debug)]
pub(crate) struct OwnWay {
    field: Arc<Field>,
    /// The point at which the way first crosses a door that the agent does not fit through (u).
    closed_door: Option<Vec2>,
    /// Distance from such a door at which the agent waits (u): it leaves room for others to come through.
    waiting: f32,
}

impl OwnWay {
    /// The way from a place (u) of a mover that waits so many of its widths from a closed door.
    pub(crate) fn new(field: Arc<Field>, map: &Map, mover: Mover, from: Vec2, waiting_widths: f32) -> Self {
        let is_closed = |point: &Vec2| {
            let offset = *point - arena::CENTRE;
            SlotId::ALL.into_iter().zip(SLOT_DIRECTIONS).any(|(slot, along)| {
                along.perp_dot(offset).abs() < ROUNDING && along.dot(offset) > 0.0 && !map.fits(slot, mover)
            })
        };
        let closed_door = if field.closed_doors(from) > 0 { field.path(from).find(is_closed) } else { None };
        Self { field, closed_door, waiting: waiting_widths * 2.0 * mover.half_width }
    }

    pub(crate) const fn closed_door(&self) -> Option<Vec2> {
        self.closed_door
    }

    /// Distance to go (u); before a closed door nothing is gained by standing in it.
    pub(crate) fn distance(&self, here: Vec2) -> f32 {
        let waiting = self.closed_door.map_or(0.0, |door| (self.waiting - here.distance(door)).max(0.0));
        self.field.distance(here) + waiting
    }

    /// The point to head for, so far ahead on the way (u).
    pub(crate) fn waypoint(&self, here: Vec2, look_ahead: f32) -> Vec2 {
        match self.closed_door {
            Some(door) if here.distance(door) < self.waiting => here,
            _ => self.field.waypoint(here, look_ahead),
        }
    }
}

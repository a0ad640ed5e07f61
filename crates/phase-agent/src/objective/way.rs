//! The way from one body to another while both may move.

use phase_model::{Vec2, layout::room_of};
use phase_navigation::{Disc, Field, Mover, Navigator, Target};
use std::sync::Arc;

/// Distance (u) up to which two points are one. It allows for rounding and shapes no behaviour.
const ROUNDING: f32 = 1e-3;

/// Distances between a mover and a target near the places that they had when it was made.
///
/// Two fields, to the target's place and to the mover's, give the distance to first order in both motions: a
/// field for every imagined position of a target would cost more than the search. Within one room the change
/// of the straight distance is exact.
#[derive(Clone, Debug)]
pub(crate) struct Way {
    to_target: Arc<Field>,
    to_mover: Arc<Field>,
    target: Vec2,
    length: f32,
}

impl Way {
    /// The way between two places (u).
    pub(crate) fn new(
        navigator: &mut Navigator,
        mover: Mover,
        from: Vec2,
        target: Vec2,
        obstacles: &[Disc],
    ) -> Self {
        let to_target = navigator.field(Target::Point(target), mover, obstacles);
        let to_mover = navigator.field(Target::Point(from), mover, &[]);
        let length = to_mover.distance(target);
        Self { to_target, to_mover, target, length }
    }

    /// Travel distance from a place of the mover to a place of the target (u).
    pub(crate) fn distance(&self, from: Vec2, target: Vec2) -> f32 {
        let change = if target == self.target {
            0.0
        } else if room_of(from) == room_of(target) && room_of(target) == room_of(self.target) {
            from.distance(target) - from.distance(self.target)
        } else {
            self.to_mover.distance(target) - self.length
        };
        (self.to_target.distance(from) + change).max(0.0)
    }

    /// The point to head for, so far ahead on the way (u).
    pub(crate) fn waypoint(&self, from: Vec2, target: Vec2, look_ahead: f32) -> Vec2 {
        let next = self.to_target.waypoint(from, look_ahead);
        let is_end = next.distance(self.target) < ROUNDING;
        if is_end || room_of(from) == room_of(target) && room_of(from) != room_of(self.target) {
            target
        } else {
            next
        }
    }
}

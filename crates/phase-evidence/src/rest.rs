//! Rest at the end of an event.

use crate::Track;
use phase_model::Entity;
use phase_predicates::threshold::SEEN_MOTION;
use serde::{Deserialize, Serialize};

/// Motion of an entity after a given step.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Rest {
    /// Steps considered.
    pub steps: usize,
    /// Distance travelled in them (u).
    pub travelled: f32,
    /// Maximum distance from where it was at the beginning of them (u).
    pub displacement: f32,
    /// Sum of all turning, either way (rad); 0 for objects, since a disc that turns looks like one that does
    /// not.
    pub turned: f32,
    /// Steps in which it moved more than 0.02 u or turned more than 0.02 rad.
    pub moving_steps: usize,
}

impl Rest {
    /// Motion of an entity after step `from`.
    #[must_use]
    pub fn after(track: &Track, entity: Entity, from: usize) -> Self {
        let states = track.states.get(from..).unwrap_or_default();
        let Some(first) = states.first() else { return Self::default() };
        let mut rest = Self::default();
        for pair in states.windows(2) {
            let before = pair[0].body(entity);
            let after = pair[1].body(entity);
            let moved = before.position.distance(after.position);
            let turned = match entity {
                Entity::Agent(_) => (after.angle - before.angle).abs(),
                Entity::Object(_) => 0.0,
            };
            rest.steps += 1;
            rest.travelled += moved;
            rest.turned += turned;
            rest.displacement = rest.displacement.max(after.position.distance(first.position(entity)));
            rest.moving_steps += usize::from(moved > SEEN_MOTION || turned > SEEN_MOTION);
        }
        rest
    }

    /// Whether nothing significant happened: it stayed within 0.3 u, turned by less than a quarter turn in
    /// total, and was still in nine steps of ten.
    #[must_use]
    pub fn is_at_rest(&self) -> bool {
        self.displacement < 0.3
            && self.turned < core::f32::consts::FRAC_PI_2
            && 10 * self.moving_steps <= self.steps
    }
}

/// Whether a viewer would judge that nothing has moved in step t ≥ 1.
#[must_use]
pub fn is_still(track: &Track, step: usize) -> bool {
    track.physics.entities().all(|entity| {
        let moved = track.distance_in_step(entity, step);
        let angle = |t: usize| track.states.get(t).map_or(0.0, |state| state.body(entity).angle);
        let turned = match entity {
            Entity::Agent(_) => (angle(step) - angle(step - 1)).abs(),
            Entity::Object(_) => 0.0,
        };
        moved <= SEEN_MOTION && turned <= SEEN_MOTION
    })
}

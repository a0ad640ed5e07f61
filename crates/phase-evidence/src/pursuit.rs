//! Pursuit and escape.

use crate::Track;
use phase_model::{AgentId, Entity, layout::room_of};
use serde::{Deserialize, Serialize};

/// Below this speed an agent counts as stationary (u a step of 0.083 s of physics).
const MIN_SPEED: f32 = 0.1;
/// Heading for something means that most of the motion goes towards it: the cosine of 60°.
const TOWARDS_COSINE: f32 = 0.5;

/// Motion of one agent relative to the other, over a whole event.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Pursuit {
    /// Steps in which it moved at all.
    pub moving: usize,
    /// Of these, steps in which it moved towards where the other had just been.
    pub towards: usize,
    /// Of these, steps in which it moved away from where the other had just been.
    pub away: usize,
    /// Decrease of the distance between the two from start to end (u); negative if it grew.
    pub closed: f32,
    /// Minimum distance between their origins (u).
    pub nearest: f32,
    /// Number of times that it changed rooms.
    pub rooms_changed: usize,
}

impl Pursuit {
    /// Measures how an agent moved relative to the other.
    #[must_use]
    pub fn of(track: &Track, agent: AgentId) -> Self {
        let who = Entity::Agent(agent);
        let other = Entity::Agent(agent.other());
        let distance = |t: usize| {
            track.states.get(t).map_or(0.0, |state| state.position(who).distance(state.position(other)))
        };
        let mut pursuit = Self {
            closed: distance(0) - distance(track.steps()),
            nearest: (0..track.states.len()).map(distance).fold(f32::INFINITY, f32::min),
            ..Self::default()
        };
        for pair in track.states.windows(2) {
            let motion = pair[1].position(who) - pair[0].position(who);
            let line = pair[0].position(other) - pair[0].position(who);
            if room_of(pair[0].position(who)) != room_of(pair[1].position(who)) {
                pursuit.rooms_changed += 1;
            }
            if motion.length() < MIN_SPEED {
                continue;
            }
            pursuit.moving += 1;
            let cosine = motion.normalize_or_zero().dot(line.normalize_or_zero());
            pursuit.towards += usize::from(cosine > TOWARDS_COSINE);
            pursuit.away += usize::from(cosine < -TOWARDS_COSINE);
        }
        pursuit
    }
}

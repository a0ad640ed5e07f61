//! Pursuit and escape.

use crate::Track;
use phase_model::{AgentId, Entity, Vec2, layout::room_of};
use phase_navigation::{IMPASSABLE_COST, Map};
use serde::{Deserialize, Serialize};

/// Below this speed an agent counts as stationary (u a step of 0.083 s of physics).
const MIN_SPEED: f32 = 0.1;
/// Heading for something means that most of the motion goes towards it: the cosine of 60°.
const TOWARDS_COSINE: f32 = 0.5;

/// Length of the way ahead by which the direction of a way is judged (u): a body and its width.
const LOOK_AHEAD: f32 = 2.0;

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
    /// Measures how an agent moved relative to the other, as the crow flies.
    #[must_use]
    pub fn of(track: &Track, agent: AgentId) -> Self {
        Self::heading(track, agent, |_, other| other)
    }

    /// Measures how an agent moved relative to the other, by its cheapest way there: who goes round a wall to
    /// the other goes towards it. At a door that is too narrow for it the way goes through the door.
    #[must_use]
    pub fn by_way(track: &Track, agent: AgentId, map: &Map) -> Self {
        let width = track.physics.agents[agent].width();
        Self::heading(track, agent, |from, to| {
            let route = map.route(from, to, width, map.gaps(), IMPASSABLE_COST);
            route.map_or(to, |route| route.at(from, to, LOOK_AHEAD))
        })
    }

    /// `aim` is the point to head for from a place in order to get to another.
    fn heading(track: &Track, agent: AgentId, aim: impl Fn(Vec2, Vec2) -> Vec2) -> Self {
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
            let here = pair[0].position(who);
            let line = aim(here, pair[0].position(other)) - here;
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

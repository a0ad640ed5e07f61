//! Stall detection and back-off.

use crate::{objective::Objective, steering::Steering};
use phase_model::{Entity, Literal, State, Subgoal, Vec2, arena, physics::GROUND_FRICTION};
use rand::{Rng, RngExt};

/// Displacement below which an agent counts as not having moved (u).
const POSITION_TOLERANCE: f32 = 0.5;
/// Rotation below which an agent counts as not having turned (rad).
const ANGLE_TOLERANCE: f32 = 0.5;
/// Steps without motion after which an agent counts as stalled.
const STALL_STEPS: u32 = 6;
/// Probability of backing off in each later step; random, so that two agents that block each other do not both back
/// off.
const BACKOFF_PROBABILITY: f64 = 0.3;
/// Duration of the back-off (steps).
const BACKOFF_STEPS: u32 = 5;
/// Distance of the back-off (u).
const BACKOFF_DISTANCE: f32 = 1.5;
/// Distance to the waypoint below which no progress is expected (u).
const ARRIVAL_DISTANCE: f32 = 1.0;

/// Detects that an agent has stalled, and chooses a back-off point.
///
/// A search of limited depth cannot see that its prediction has failed repeatedly: agents that push against
/// each other, or one stuck in a door, predict success of the next push in every step.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct StallDetector {
    since: Option<(Vec2, f32)>,
    steps: u32,
    backoff: Option<(Vec2, u32)>,
}

impl StallDetector {
    /// Updates the detector before a decision. Returns the back-off point (u) while the agent backs off; draws
    /// from `random` only once it has stalled.
    pub fn update(
        &mut self,
        objective: &Objective<'_>,
        state: &State,
        random: &mut impl Rng,
    ) -> Option<Vec2> {
        if let Some((place, steps)) = self.backoff {
            self.backoff = (steps > 1).then_some((place, steps - 1));
            return Some(place);
        }
        let Some(desired_direction) = desired_direction(objective, state) else {
            *self = Self::default();
            return None;
        };
        let body = state.body(Entity::Agent(objective.agent));
        let stays = self.since.is_some_and(|(place, angle)| {
            place.distance(body.position) < POSITION_TOLERANCE && (angle - body.angle).abs() < ANGLE_TOLERANCE
        });
        if !stays {
            *self = Self { since: Some((body.position, body.angle)), ..Self::default() };
            return None;
        }
        self.steps += 1;
        if self.steps <= STALL_STEPS || !random.random_bool(BACKOFF_PROBABILITY) {
            return None;
        }
        let place = backoff_point(objective, body.position, desired_direction);
        *self = Self { backoff: Some((place, BACKOFF_STEPS - 1)), ..Self::default() };
        Some(place)
    }
}

/// The direction of intended progress; `None` if no progress is expected: at the target, waiting for a door, or
/// holding an object that it cannot move or that the other agent holds too.
fn desired_direction(objective: &Objective<'_>, state: &State) -> Option<Vec2> {
    let Subgoal::Achieve(Literal { holds: true, .. }) = objective.subgoal else { return None };
    let (me, other) = (objective.agent, objective.agent.other());
    if let Some(object) = state.held_object(me) {
        let force = objective.physics.agents[me].max_force;
        if state.holds(other, object) || force <= 2.0 * GROUND_FRICTION {
            return None;
        }
    }
    let way = objective.steering(state).waypoint - state.position(objective.moved_entity(state));
    (way.length() > ARRIVAL_DISTANCE).then(|| way.normalize_or_zero())
}

/// The back-off point: straight back, or to a side if a wall is behind.
fn backoff_point(objective: &Objective<'_>, from: Vec2, desired_direction: Vec2) -> Vec2 {
    let inset = Vec2::splat(objective.physics.agents[objective.agent].radius);
    let free = |place: &Vec2| {
        arena::contains(*place - inset)
            && arena::contains(*place + inset)
            && !objective.path_hits_wall(from, *place, 0.0)
    };
    let places = [-desired_direction, desired_direction.perp(), -desired_direction.perp()]
        .map(|way| from + way * BACKOFF_DISTANCE);
    places.into_iter().find(free).unwrap_or(places[0])
}

impl Objective<'_> {
    /// Steering to the back-off point, taking a held object along.
    pub(crate) fn backoff_steering(&self, state: &State, place: Vec2) -> Steering {
        let way = place - state.position(Entity::Agent(self.agent));
        Steering { waypoint: state.position(self.moved_entity(state)) + way, remaining: way.length() }
    }
}

//! Stall detection and back-off.

use crate::{course::Course, objective::Objective};
use phase_model::{Entity, Literal, State, Subgoal, Vec2, arena, physique::GROUND_FRICTION};
use rand::{Rng, RngExt};

/// Displacement below which an agent counts as not having moved (u).
const SAME_PLACE: f32 = 0.5;
/// Rotation below which an agent counts as not having turned (rad).
const SAME_HEADING: f32 = 0.5;
/// Steps without motion after which an agent counts as stalled.
const WAIT: u32 = 6;
/// Probability of backing off in each later step; random, so that two agents that block each other do not both back
/// off.
const LOSS: f64 = 0.3;
/// Duration of the back-off (steps).
const RETREAT: u32 = 5;
/// Distance of the back-off (u).
const ROOM: f32 = 1.5;
/// Distance to the waypoint below which no progress is expected (u).
const NEARLY_THERE: f32 = 1.0;

/// Detects that an agent has stalled, and chooses a back-off point.
///
/// A search of limited depth cannot see that its prediction has failed repeatedly: agents that push against
/// each other, or one stuck in a door, predict success of the next push in every step.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Patience {
    since: Option<(Vec2, f32)>,
    steps: u32,
    retreat: Option<(Vec2, u32)>,
}

impl Patience {
    /// Updates the detector before a decision. Returns the back-off point (u) while the agent backs off; draws
    /// from `random` only once it has stalled.
    pub fn lose(&mut self, objective: &Objective<'_>, state: &State, random: &mut impl Rng) -> Option<Vec2> {
        if let Some((place, steps)) = self.retreat {
            self.retreat = (steps > 1).then_some((place, steps - 1));
            return Some(place);
        }
        let Some(onward) = onward(objective, state) else {
            *self = Self::default();
            return None;
        };
        let body = state.body(Entity::Agent(objective.agent));
        let stays = self.since.is_some_and(|(place, angle)| {
            place.distance(body.position) < SAME_PLACE && (angle - body.angle).abs() < SAME_HEADING
        });
        if !stays {
            *self = Self { since: Some((body.position, body.angle)), ..Self::default() };
            return None;
        }
        self.steps += 1;
        if self.steps <= WAIT || !random.random_bool(LOSS) {
            return None;
        }
        let place = back(objective, body.position, onward);
        *self = Self { retreat: Some((place, RETREAT - 1)), ..Self::default() };
        Some(place)
    }
}

/// The direction of intended progress; `None` if no progress is expected: at the target, waiting for a door, or
/// holding an object that it cannot move or that the other agent holds too.
fn onward(objective: &Objective<'_>, state: &State) -> Option<Vec2> {
    let Subgoal::Achieve(Literal { holds: true, .. }) = objective.subgoal else { return None };
    let (me, other) = (objective.agent, objective.agent.other());
    if let Some(object) = state.held_object(me) {
        let force = objective.physique.agents[me].max_force;
        if state.holds(other, object) || force <= 2.0 * GROUND_FRICTION {
            return None;
        }
    }
    let way = objective.course(state).heading_for - state.position(objective.mover(state));
    (way.length() > NEARLY_THERE).then(|| way.normalize_or_zero())
}

/// The back-off point: straight back, or to a side if a wall is behind.
fn back(objective: &Objective<'_>, from: Vec2, onward: Vec2) -> Vec2 {
    let inset = Vec2::splat(objective.physique.agents[objective.agent].radius);
    let free = |place: &Vec2| {
        arena::contains(*place - inset)
            && arena::contains(*place + inset)
            && !objective.grazes(from, *place, 0.0)
    };
    let places = [-onward, onward.perp(), -onward.perp()].map(|way| from + way * ROOM);
    places.into_iter().find(free).unwrap_or(places[0])
}

impl Objective<'_> {
    /// Steering to the back-off point, taking a held object along.
    pub(crate) fn back_to(&self, state: &State, place: Vec2) -> Course {
        let way = place - state.position(Entity::Agent(self.agent));
        Course { heading_for: state.position(self.mover(state)) + way, remaining: way.length() }
    }
}

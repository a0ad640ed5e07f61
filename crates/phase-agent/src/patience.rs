//! Noticing that one does not get on, and making room for another try.

use crate::{course::Course, objective::Objective};
use phase_model::{Entity, Literal, State, Subgoal, Vec2, arena, physique::GROUND_FRICTION};
use rand::{Rng, RngExt};

/// Who has come no farther than this is where it was (u).
const SAME_PLACE: f32 = 0.5;
/// Who has turned no farther than this faces where it faced (rad).
const SAME_HEADING: f32 = 0.5;
/// Steps in one place before an agent may lose its patience.
const WAIT: u32 = 6;
/// Chance of losing it in each step after that. Two who hold each other up must not do so at once.
const LOSS: f64 = 0.3;
/// Steps of making room.
const RETREAT: u32 = 5;
/// How far one goes back (u).
const ROOM: f32 = 1.5;
/// Nearer than this to what one heads for there is nothing to get on to (u).
const NEARLY_THERE: f32 = 1.0;

/// How long an agent has been held up, and where it goes back to if it was too long.
///
/// No search of a few steps sees that what it imagines has failed to come about for many: two who push against
/// each other, or one that is stuck in a door, imagine every time that the next push will do.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Patience {
    since: Option<(Vec2, f32)>,
    steps: u32,
    retreat: Option<(Vec2, u32)>,
}

impl Patience {
    /// Takes in that an agent is about to act for an objective in a state. The place to go back to (u) if it has
    /// lost its patience; `random` is drawn from only if it might.
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

/// The direction in which an agent means to get on; `None` if it need not, waits for a door, or is not able to:
/// with a load that it cannot move, or that the other holds as well, all it can do is pull.
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

/// Where to make room: straight back, or to the side where a wall is behind.
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
    /// The course back to a place, and whatever is in hand with one.
    pub(crate) fn back_to(&self, state: &State, place: Vec2) -> Course {
        let way = place - state.position(Entity::Agent(self.agent));
        Course { heading_for: state.position(self.mover(state)) + way, remaining: way.length() }
    }
}

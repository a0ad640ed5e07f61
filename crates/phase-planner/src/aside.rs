//! Yielding: clearing the other agent's path.

use crate::{
    plan::{is, not},
    routes::Routes,
    situation::{self, Situation},
};
use phase_model::{
    AgentId, Entity, Goal, LandmarkId, Physique, Predicate, SlotId, State, Subgoal, Vec2, arena,
    layout::room_of,
};

/// Lateral clearance to the other agent's path (u).
const CLEARANCE: f32 = 0.4;

/// An agent that obstructs the other agent's path to a landmark.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Intrusion {
    /// The nearest point of the other's way (u).
    pub nearest: Vec2,
    /// The place beside that way to step to (u).
    pub place: Vec2,
}

/// Whether an agent obstructs the path of the other, or of the object the other holds, to a landmark;
/// `None` if the two bodies can pass each other, or the agent is behind the other.
#[must_use]
pub fn intrusion(
    physique: &Physique,
    routes: &Routes,
    state: &State,
    agent: AgentId,
    landmark: LandmarkId,
) -> Option<Intrusion> {
    let other = agent.other();
    let here = state.position(Entity::Agent(agent));
    let mover = state.held_object(other).map_or(Entity::Agent(other), Entity::Object);
    let (from, to) = (state.position(mover), arena::LANDMARKS[landmark]);
    let width = physique.agents[other].width().max(2.0 * physique.radius(mover));
    let room = 0.5 * (physique.agents[agent].width() + width) + CLEARANCE;
    let nearest = routes.best(from, to, width, routes.gaps())?.nearest(from, to, here);
    if nearest == from || nearest.distance(here) >= room {
        return None;
    }
    let away = (here - nearest).normalize_or((to - from).perp().normalize_or(Vec2::X));
    let inset = Vec2::splat(physique.agents[agent].radius);
    let is_free = |place: Vec2| {
        arena::contains(place - inset) && arena::contains(place + inset) && room_of(place) == room_of(here)
    };
    // With a margin, so that the agent does not stop exactly at the limit.
    let beside = [away, -away].map(|side| nearest + side * (room + CLEARANCE));
    let place = beside.into_iter().find(|&place| is_free(place)).unwrap_or(beside[0]);
    Some(Intrusion { nearest, place })
}

/// Subgoal of an agent without a part in the other's plan that obstructs the other: leave a door that the
/// other would fit through, then the path to the landmark of the other's goal.
#[must_use]
pub(crate) fn subgoal(situation: &Situation<'_>, agent: AgentId, goal: Goal) -> Option<Subgoal> {
    let me = Entity::Agent(agent);
    if stands_in_a_door(situation, agent) {
        let here = room_of(situation.state.position(me));
        return Some(is(Predicate::On(me, here.landmark())));
    }
    let held = situation.state.held_object(agent.other());
    let landmark = match goal {
        Goal::AgentOnLandmark { landmark, .. } => landmark,
        Goal::ObjectOnLandmark { object, landmark, .. } if held == Some(object) => landmark,
        _ => return None,
    };
    intrusion(situation.physique, situation.routes, situation.state, agent, landmark)
        .map(|_| not(Predicate::On(me, landmark)))
}

/// Whether the agent's body blocks a door that the other would fit through otherwise.
fn stands_in_a_door(situation: &Situation<'_>, agent: AgentId) -> bool {
    let other = agent.other();
    let radius = |agent: AgentId| situation.physique.agents[agent].radius;
    let open = situation.routes.gaps();
    let mut gaps = *open;
    let here = situation.state.position(Entity::Agent(agent));
    situation::obstruct(&mut gaps, here, radius(agent), radius(agent) + radius(other));
    let width = situation.width(other, None);
    SlotId::ALL.into_iter().any(|slot| open.width(slot) >= width && gaps.width(slot) < width)
}

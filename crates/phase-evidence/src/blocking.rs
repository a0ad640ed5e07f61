//! Agents that obstruct each other.

use crate::Track;
use phase_model::{AgentId, Entity, Goal, SlotId, State, Vec2, arena};
use phase_navigation::{IMPASSABLE_COST, Map};

/// Steps in which an agent's body narrowed a door on another's cheapest path to a point so much that the
/// other no longer fitted through. `target` gives the point for each state (u); `None` where there is none.
///
/// Only the door of the layout and the agent's body are considered: objects in the door are not.
#[must_use]
pub fn steps_blocking_a_door(
    track: &Track,
    map: &Map,
    blocker: AgentId,
    target: impl Fn(&State) -> Option<Vec2>,
) -> Vec<usize> {
    let blocked = blocker.other();
    let width = track.physics.agents[blocked].width();
    let in_the_way = |state: &State| {
        let from = state.position(Entity::Agent(blocked));
        let route = target(state).and_then(|to| map.route(from, to, width, map.gaps(), IMPASSABLE_COST));
        let Some(route) = route else { return false };
        let radius = track.physics.agents[blocker].radius;
        let mut gaps = *map.gaps();
        gaps.obstruct(
            state.position(Entity::Agent(blocker)),
            radius,
            radius + track.physics.agents[blocked].radius,
        );
        route.doors().iter().any(|&(slot, _)| map.gaps().width(slot) >= width && gaps.width(slot) < width)
    };
    (0..track.states.len()).filter(|&t| in_the_way(&track.states[t])).collect()
}

/// Steps in which an agent stood between the other and a point: closer to the point than the other, and no
/// farther from the straight line between them than both radii.
#[must_use]
pub fn steps_between(track: &Track, blocker: AgentId, target: impl Fn(&State) -> Option<Vec2>) -> Vec<usize> {
    let blocked = blocker.other();
    let reach = track.physics.agents[0].radius + track.physics.agents[1].radius;
    let between = |state: &State| {
        let Some(to) = target(state) else { return false };
        let from = state.position(Entity::Agent(blocked));
        let at = state.position(Entity::Agent(blocker));
        let line = phase_model::Segment { a: from, b: to };
        line.distance(at) <= reach && at.distance(to) < from.distance(to)
    };
    (0..track.states.len()).filter(|&t| between(&track.states[t])).collect()
}

/// The door an agent stands in, if any, by its slot: its origin is closer to the door's line than its radius,
/// and within the opening.
#[must_use]
pub fn door_of(track: &Track, map: &Map, state: &State, agent: AgentId) -> Option<SlotId> {
    let position = state.position(Entity::Agent(agent));
    let radius = track.physics.agents[agent].radius;
    SlotId::ALL
        .into_iter()
        .find(|&slot| map.layout().opening(slot).is_some_and(|opening| opening.distance(position) < radius))
}

/// The next target of an agent with a goal: the object while it is not held, else the goal's landmark or
/// agent.
#[must_use]
pub fn next_place(goal: Goal, state: &State) -> Option<Vec2> {
    match goal {
        Goal::ObjectOnLandmark { object, .. }
            if !AgentId::ALL.into_iter().any(|agent| state.holds(agent, object)) =>
        {
            Some(state.position(Entity::Object(object)))
        }
        Goal::Touch { other, .. } => Some(state.position(Entity::Agent(other))),
        _ => goal.landmark().map(|landmark| arena::LANDMARKS[landmark]),
    }
}

//! Yielding: clearing the other agent's path.

use crate::{
    plan::{is, not},
    problem::{self, Location, PlanningProblem},
    routes::Routes,
};
use phase_model::{
    AgentId, Entity, Goal, LandmarkId, PhysicsConfig, Predicate, SlotId, State, Subgoal, Vec2, arena,
    layout::room_of,
};

/// Lateral clearance to the other agent's path (u).
const CLEARANCE: f32 = 0.4;

/// An agent that obstructs the other agent's path to a landmark.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PathObstruction {
    /// The closest point of the other's path (u).
    pub nearest: Vec2,
    /// The place beside that path to step to (u).
    pub place: Vec2,
}

/// Whether an agent obstructs the path of the other, or of the object the other holds, to a landmark;
/// `None` if the two bodies can pass each other, or the agent is behind the other.
#[must_use]
pub fn path_obstruction(
    physics: &PhysicsConfig,
    routes: &Routes,
    state: &State,
    agent: AgentId,
    landmark: LandmarkId,
) -> Option<PathObstruction> {
    let other = agent.other();
    let here = state.position(Entity::Agent(agent));
    let mover = state.held_object(other).map_or(Entity::Agent(other), Entity::Object);
    let (from, to) = (state.position(mover), arena::LANDMARKS[landmark]);
    let width = physics.agents[other].width().max(2.0 * physics.radius(mover));
    let room = 0.5 * (physics.agents[agent].width() + width) + CLEARANCE;
    let nearest = routes.best(from, to, width, routes.gaps())?.nearest(from, to, here);
    if nearest == from || nearest.distance(here) >= room {
        return None;
    }
    let away = (here - nearest).normalize_or((to - from).perp().normalize_or(Vec2::X));
    let inset = Vec2::splat(physics.agents[agent].radius);
    let is_free = |place: Vec2| {
        arena::contains(place - inset) && arena::contains(place + inset) && room_of(place) == room_of(here)
    };
    // With a margin, so that the agent does not stop exactly at the limit.
    let beside = [away, -away].map(|side| nearest + side * (room + CLEARANCE));
    let place = beside.into_iter().find(|&place| is_free(place)).unwrap_or(beside[0]);
    Some(PathObstruction { nearest, place })
}

/// Subgoal of an agent without a part in the other's plan that obstructs the other: leave a door that the
/// other would fit through, then the path to the landmark of the other's goal.
#[must_use]
pub(crate) fn subgoal(problem: &PlanningProblem<'_>, agent: AgentId, goal: Goal) -> Option<Subgoal> {
    let me = Entity::Agent(agent);
    if blocks_doorway(problem, agent) {
        let here = room_of(problem.position(Location::Current(me)));
        return Some(is(Predicate::On(me, here.landmark())));
    }
    let held = problem.state.held_object(agent.other());
    let landmark = match goal {
        Goal::AgentOnLandmark { landmark, .. } => landmark,
        Goal::ObjectOnLandmark { object, landmark, .. } if held == Some(object) => landmark,
        _ => return None,
    };
    path_obstruction(problem.physics, problem.routes, problem.state, agent, landmark)
        .map(|_| not(Predicate::On(me, landmark)))
}

/// Whether the agent's body blocks a door that the other would fit through otherwise.
fn blocks_doorway(problem: &PlanningProblem<'_>, agent: AgentId) -> bool {
    let other = agent.other();
    let radius = |agent: AgentId| problem.physics.agents[agent].radius;
    let open = problem.routes.gaps();
    let mut gaps = *open;
    let here = problem.state.position(Entity::Agent(agent));
    problem::obstruct(&mut gaps, here, radius(agent), radius(agent) + radius(other));
    let width = problem.width(other, None);
    SlotId::ALL.into_iter().any(|slot| open.width(slot) >= width && gaps.width(slot) < width)
}

//! Yielding: clearing the other agent's path.

use crate::{
    plan::{is, not},
    problem::{Location, PlanningProblem},
};
use phase_model::{AgentId, Entity, Goal, LandmarkId, Predicate, SlotId, Subgoal, arena, layout::room_of};

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
    stands_on_path(problem, agent, landmark).then(|| not(Predicate::On(me, landmark)))
}

/// Whether the agent's body blocks a door that the other would fit through otherwise.
fn blocks_doorway(problem: &PlanningProblem<'_>, agent: AgentId) -> bool {
    let other = agent.other();
    let radius = |agent: AgentId| problem.physics.agents[agent].radius;
    let open = problem.map.gaps();
    let mut gaps = *open;
    let here = problem.state.position(Entity::Agent(agent));
    gaps.obstruct(here, radius(agent), radius(agent) + radius(other));
    let width = problem.width(other, None);
    SlotId::ALL.into_iter().any(|slot| open.width(slot) >= width && gaps.width(slot) < width)
}

/// Whether the agent stands on the path of the other, or of the object that the other holds, to a landmark,
/// so that the two bodies cannot pass each other. An agent behind the other does not.
fn stands_on_path(problem: &PlanningProblem<'_>, agent: AgentId, landmark: LandmarkId) -> bool {
    let other = agent.other();
    let here = problem.state.position(Entity::Agent(agent));
    let mover = problem.state.held_object(other).map_or(Entity::Agent(other), Entity::Object);
    let from = problem.state.position(mover);
    let to = arena::LANDMARKS[landmark];
    let width = problem.physics.agents[other].width().max(2.0 * problem.physics.radius(mover));
    let room = 0.5 * (problem.physics.agents[agent].width() + width) + problem.parameters.yielding_clearance;
    problem.route(from, to, width, problem.map.gaps()).is_some_and(|route| {
        let nearest = route.nearest(from, to, here);
        nearest != from && nearest.distance(here) < room
    })
}

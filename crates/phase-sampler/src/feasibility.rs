//! Whether a scene can show the intended event, as judged by the planner.

use phase_model::{AGENT_COUNT, AgentId, Goal, Scene};
use phase_navigation::Map;
use phase_planner::{
    PlannerParameters, PlanningProblem, search,
    symbolic::Node,
    task::{Effort, PlanningTask},
};
use phase_predicates::achieved;

/// Plans that cost more than this contain something nearly impossible (u); see
/// [`phase_navigation::IMPASSABLE_COST`].
pub const INFEASIBLE_COST: f32 = 95.0;

/// Cost of reaching a goal for these agents together (u of travel with penalties), from the scene's start.
#[must_use]
pub fn cost(scene: &Scene, goal: Goal, actors: [bool; AGENT_COUNT]) -> f32 {
    let physics = scene.physics();
    let map = Map::new(scene.layout);
    let state = scene.initial_state();
    let problem = PlanningProblem::new(&physics, &map, &state, PlannerParameters::default());
    let task = PlanningTask {
        problem: &problem,
        goal,
        actors,
        efforts: [Effort::OWN; AGENT_COUNT],
        cooperative: true,
        narrowed: None,
    };
    search::solve(&task, Node::start(&problem)).map_or(f32::INFINITY, |plan| plan.cost)
}

/// Whether an agent reaches a goal alone.
#[must_use]
pub fn alone(scene: &Scene, agent: AgentId, goal: Goal) -> bool {
    cost(scene, goal, AgentId::ALL.map(|who| who == agent)) < INFEASIBLE_COST
}

/// Whether both together reach a goal.
#[must_use]
pub fn together(scene: &Scene, goal: Goal) -> bool {
    cost(scene, goal, [true; AGENT_COUNT]) < INFEASIBLE_COST
}

/// Whether a goal already holds at the start.
#[must_use]
pub fn is_achieved(scene: &Scene, goal: Goal) -> bool {
    achieved(&scene.physics(), &scene.initial_state(), goal)
}

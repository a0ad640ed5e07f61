//! Whether a scene can show what it is meant to, asked of the planner.

use phase_model::{AGENT_COUNT, AgentId, Goal, Scene};
use phase_planner::{Routes, Situation, search, symbolic::Node, task::Task};
use phase_predicates::achieved;

/// Plans that cost more than this contain something nearly impossible (u); see
/// [`phase_planner::routes::IMPASSABLE_COST`].
pub const IMPOSSIBLE: f32 = 95.0;

/// What reaching a goal costs these agents together (u of travel with penalties), from the scene's start.
#[must_use]
pub fn cost(scene: &Scene, goal: Goal, actors: [bool; AGENT_COUNT]) -> f32 {
    let (physique, routes, state) = (scene.physique(), Routes::new(scene.layout), scene.initial_state());
    let situation = Situation::new(&physique, &routes, &state);
    let task = Task {
        situation: &situation,
        goal,
        actors,
        effort: [1.0; AGENT_COUNT],
        allied: true,
        narrowed: None,
    };
    search::solve(&task, Node::start(&situation)).map_or(f32::INFINITY, |plan| plan.cost)
}

/// Whether an agent reaches a goal on its own.
#[must_use]
pub fn alone(scene: &Scene, agent: AgentId, goal: Goal) -> bool {
    cost(scene, goal, AgentId::ALL.map(|who| who == agent)) < IMPOSSIBLE
}

/// Whether both together reach a goal.
#[must_use]
pub fn together(scene: &Scene, goal: Goal) -> bool {
    cost(scene, goal, [true; AGENT_COUNT]) < IMPOSSIBLE
}

/// Whether a goal holds at the start already.
#[must_use]
pub fn solved(scene: &Scene, goal: Goal) -> bool {
    achieved(&scene.physique(), &scene.initial_state(), goal)
}

//! A* over symbolic states.

use crate::{
    accuracy::{COST_RESOLUTION, HIGHEST_COST},
    symbolic::{Node, Operator},
    task::PlanningTask,
};

/// A symbolic plan: operators with the symbolic states they are applied in, in order, and the total cost.
#[derive(Clone, Debug)]
pub struct SymbolicPlan {
    /// Each operator with the symbolic state it is applied in.
    pub steps: Vec<(Node, Operator)>,
    /// The symbolic state at the end.
    pub end: Node,
    /// Sum of the operators' costs (u of travel, with penalties for what is nearly impossible).
    pub cost: f32,
}

/// The cheapest sequence of operators from a symbolic state to one where the task is done; `None` if there is
/// none, as when no agent acts.
#[must_use]
pub fn solve(task: &PlanningTask<'_>, start: Node) -> Option<SymbolicPlan> {
    let (nodes, cost) = pathfinding::prelude::astar(
        &start,
        |node| task.successors(node).into_iter().map(|(_, after, cost)| (after, quantise(cost))),
        |node| (task.heuristic(node) * COST_RESOLUTION) as u32,
        |node| task.is_done(node),
    )?;
    let steps = nodes
        .windows(2)
        .filter_map(|pair| {
            task.successors(&pair[0])
                .into_iter()
                .filter(|(_, after, _)| *after == pair[1])
                .min_by(|a, b| a.2.total_cmp(&b.2))
                .map(|(operator, ..)| (pair[0], operator))
        })
        .collect();
    let end = nodes.last().copied().unwrap_or(start);
    Some(SymbolicPlan { steps, end, cost: cost as f32 / COST_RESOLUTION })
}

/// A cost in A*'s units, rounded up so that a lower bound remains one. NaN counts as very far.
fn quantise(cost: f32) -> u32 {
    libm::ceilf(cost.clamp(0.0, HIGHEST_COST) * COST_RESOLUTION) as u32
}

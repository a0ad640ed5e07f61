//! A* compared with Dijkstra's algorithm on random problems.
//!
//! `PHASE_SEARCH_PROBLEMS` sets the number of problems.

use super::problems::problems;
use petgraph::{
    algo::dijkstra,
    graph::{DiGraph, NodeIndex},
    visit::{EdgeRef, Reversed},
};
use phase_navigation::Map;
use phase_planner::{
    PlannerParameters, PlanningProblem,
    search::{SymbolicProblem, solve},
    symbolic::Node,
    task::PlanningTask,
};
use proptest::{
    strategy::{Strategy, ValueTree},
    test_runner::TestRunner,
};
use std::collections::HashMap;

/// Default number of problems.
const PROBLEMS: usize = 4000;
/// Costs are compared in units of this many to one world unit, rounded up.
const COST_RESOLUTION: f32 = 256.0;

/// Every reachable symbolic state, with edges weighted by the cost of each operator, and a final node
/// connected to all states in which the task is done.
struct Reachable {
    graph: DiGraph<Option<Node>, u32>,
    start: NodeIndex,
    end: NodeIndex,
}

impl Reachable {
    fn new(task: &PlanningTask<'_>, start: Node) -> Self {
        let mut graph = DiGraph::new();
        let end = graph.add_node(None);
        let first = graph.add_node(Some(start));
        let mut indices = HashMap::from([(start, first)]);
        let mut open = vec![(start, first)];
        while let Some((node, from)) = open.pop() {
            if task.is_goal(&node) {
                graph.add_edge(from, end, 0);
            }
            for (_, after, cost) in task.successors(&node) {
                let to = *indices.entry(after).or_insert_with(|| {
                    let to = graph.add_node(Some(after));
                    open.push((after, to));
                    to
                });
                graph.add_edge(from, to, (cost.clamp(0.0, 1e6) * COST_RESOLUTION).ceil() as u32);
            }
        }
        Self { graph, start: first, end }
    }

    /// The minimum cost from each state to the end.
    fn remaining(&self) -> HashMap<NodeIndex, u32> {
        dijkstra(Reversed(&self.graph), self.end, None, |edge| *edge.weight()).into_iter().collect()
    }
}

#[test]
fn no_plan_is_cheaper_and_the_heuristic_is_a_lower_bound() {
    let given = std::env::var("PHASE_SEARCH_PROBLEMS").ok();
    let count = given.map_or(PROBLEMS, |text| text.parse().expect("a number of problems"));
    let mut runner = TestRunner::deterministic();
    let strategy = problems();
    let mut solved = 0;
    let mut informed = 0;
    for _ in 0..count {
        let random_problem = strategy.new_tree(&mut runner).expect("a problem").current();
        let map = Map::new(random_problem.layout);
        let physics = random_problem.physics();
        let state = random_problem.state();
        let problem = PlanningProblem::new(&physics, &map, &state, PlannerParameters::default());
        let task = random_problem.task(&problem);
        let start = Node::start(&problem);
        let reachable = Reachable::new(&task, start);
        let remaining = reachable.remaining();
        let least = remaining.get(&reachable.start).map(|&cost| cost as f32 / COST_RESOLUTION);
        let found = solve(&task, start);
        assert_eq!(found.as_ref().map(|plan| plan.cost), least, "{random_problem:?}");
        let Some(found) = found else { continue };
        solved += 1;
        assert!(task.is_goal(&found.end), "{random_problem:?}");
        for (index, &cost) in &remaining {
            let Some(node) = reachable.graph[*index] else { continue };
            let bound = (task.heuristic(&node) * COST_RESOLUTION) as u32;
            assert!(bound <= cost, "{bound} {cost} {node:?} of {random_problem:?}");
            informed += u32::from(bound > 0);
        }
    }
    assert!(solved > count / 2 && informed > 0);
}

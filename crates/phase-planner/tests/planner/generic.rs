//! Plans for problems that have nothing to do with PHASE, compared with Dijkstra's algorithm.

use petgraph::{
    algo::dijkstra,
    graph::{DiGraph, NodeIndex},
    visit::{EdgeRef, Reversed},
};
use phase_planner::search::{SymbolicProblem, solve, solve_within};
use proptest::prelude::*;

/// A problem whose states are the nodes of a graph; a state's lower bound is a share of what really is left.
#[derive(Debug)]
struct Graph {
    graph: DiGraph<f32, u16>,
    goal: u32,
}

impl SymbolicProblem for Graph {
    type State = u32;
    type Operator = u32;

    fn successors(&self, state: &u32) -> impl IntoIterator<Item = (u32, u32, f32)> {
        self.graph.edges(NodeIndex::from(*state)).map(|edge| {
            let to = edge.target().index() as u32;
            (to, to, f32::from(*edge.weight()))
        })
    }

    fn is_goal(&self, state: &u32) -> bool {
        *state == self.goal
    }

    fn heuristic(&self, state: &u32) -> f32 {
        self.graph[NodeIndex::from(*state)]
    }
}

/// Graphs of up to 20 states, with bounds that are lower bounds and seldom consistent.
fn graphs() -> impl Strategy<Value = Graph> {
    let edges = proptest::collection::vec((0_u32..20, 0_u32..20, 0_u16..100), 0..80);
    let shares = proptest::collection::vec(0.0_f32..=1.0, 20);
    (edges, shares, 0_u32..20).prop_map(|(edges, shares, goal)| {
        let mut graph = DiGraph::from_edges(edges);
        while graph.node_count() < 20 {
            graph.add_node(0.0);
        }
        let left = dijkstra(Reversed(&graph), goal.into(), None, |edge| u32::from(*edge.weight()));
        let nodes: Vec<_> = graph.node_indices().collect();
        for node in nodes {
            let bound = left.iter().find(|&(of, _)| *of == node).map_or(1e5, |(_, &left)| left as f32);
            graph[node] = bound * shares[node.index()];
        }
        Graph { graph, goal }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_plan_is_valid_and_none_is_cheaper(problem in graphs(), start in 0_u32..20) {
        let costs = dijkstra(&problem.graph, start.into(), None, |edge| u32::from(*edge.weight()));
        let least = costs.into_iter().find(|(node, _)| node.index() as u32 == problem.goal);
        let plan = solve(&problem, start);
        prop_assert_eq!(plan.as_ref().map(|plan| plan.cost), least.map(|(_, cost)| cost as f32));
        let Some(plan) = plan else { return Ok(()) };
        let mut state = start;
        let mut sum = 0.0;
        for (before, operator) in &plan.steps {
            prop_assert_eq!(*before, state);
            let cheapest = problem.successors(&state).into_iter().filter(|(to, ..)| to == operator);
            sum += cheapest.map(|(.., cost)| cost).fold(f32::INFINITY, f32::min);
            state = *operator;
        }
        prop_assert_eq!((state, sum), (plan.end, plan.cost));
        prop_assert!(problem.is_goal(&plan.end));
    }
}

/// Cells in a row; a step costs a million, and from cell 100 on no goal is reached.
struct Row;

impl SymbolicProblem for Row {
    type State = u32;
    type Operator = ();

    fn successors(&self, cell: &u32) -> impl IntoIterator<Item = ((), u32, f32)> {
        [((), cell + 1, 1e6), ((), 100, 0.0)].into_iter().filter(|_| *cell < 100)
    }

    fn is_goal(&self, cell: &u32) -> bool {
        *cell == 30
    }

    fn heuristic(&self, cell: &u32) -> f32 {
        if *cell < 100 { 0.0 } else { f32::INFINITY }
    }
}

#[test]
fn large_costs_and_infinite_bounds_add_up() {
    let plan = solve(&Row, 0).expect("a plan");
    assert_eq!((plan.cost, plan.steps.len()), (3e7, 30));
    assert_eq!(solve(&Row, 100), None);
    assert_eq!(solve(&Row, 31), None);
}

/// Two operators between the same states, of which one has no cost that is a number.
struct Twins;

impl SymbolicProblem for Twins {
    type State = u8;
    type Operator = &'static str;

    fn successors(&self, state: &u8) -> impl IntoIterator<Item = (&'static str, u8, f32)> {
        let only = *state == 0;
        [("dear", 1, 3.0), ("unknown", 1, f32::NAN)].into_iter().filter(move |_| only)
    }

    fn is_goal(&self, state: &u8) -> bool {
        *state == 1
    }
}

#[test]
fn the_operators_of_a_plan_are_those_that_it_costs() {
    let plan = solve(&Twins, 0).expect("a plan");
    assert_eq!((plan.cost, plan.steps), (0.0, vec![(0, "unknown")]), "NaN counts as 0");
}

#[test]
fn a_search_that_is_cut_says_so() {
    let whole = solve_within(&Row, 0, usize::MAX);
    assert!(!whole.is_cut && whole.expanded == 30, "cells 0 to 29");
    assert_eq!(whole.plan, solve(&Row, 0));
    assert_eq!(solve_within(&Row, 0, 30), whole, "that many suffice");
    let cut = solve_within(&Row, 0, 29);
    assert!(cut.is_cut && cut.plan.is_none() && cut.expanded == 29);
    let none = solve_within(&Row, 31, usize::MAX);
    assert!(!none.is_cut && none.plan.is_none());
}

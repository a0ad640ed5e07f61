//! The blocks world, a classic domain of planning, stated for the planner of this crate.
//!
//! `cargo run --package phase-planner --example blocks`

use phase_planner::search::{SymbolicProblem, solve};
use std::fmt;

/// The support of each block: another block, or the table (`None`).
type Towers = Vec<Option<usize>>;

/// Towers to be built by a gripper that lifts one block at a time.
struct Blocks {
    /// The supports that some blocks must have at the end.
    goal: Vec<(usize, Option<usize>)>,
}

/// Puts a block that has nothing on it onto another one or onto the table.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Put {
    block: usize,
    onto: Option<usize>,
}

impl fmt::Display for Put {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.onto {
            Some(other) => write!(f, "put block {} onto block {other}", self.block),
            None => write!(f, "put block {} onto the table", self.block),
        }
    }
}

impl SymbolicProblem for Blocks {
    type State = Towers;
    type Operator = Put;

    fn successors(&self, towers: &Towers) -> impl IntoIterator<Item = (Put, Towers, f32)> {
        let is_clear = |block: usize| !towers.contains(&Some(block));
        let mut successors = Vec::new();
        for block in (0..towers.len()).filter(|&block| is_clear(block)) {
            let others = (0..towers.len()).filter(|&other| other != block && is_clear(other)).map(Some);
            for onto in others.chain([None]).filter(|&onto| onto != towers[block]) {
                let mut after = towers.clone();
                after[block] = onto;
                successors.push((Put { block, onto }, after, 1.0));
            }
        }
        successors
    }

    fn is_goal(&self, towers: &Towers) -> bool {
        self.goal.iter().all(|&(block, onto)| towers[block] == onto)
    }

    /// Blocks that stand on something that is not their goal have to be put at least once each.
    fn heuristic(&self, towers: &Towers) -> f32 {
        self.goal.iter().filter(|&&(block, onto)| towers[block] != onto).count() as f32
    }
}

fn main() {
    // Sussman's anomaly: block 2 stands on block 0, and 0 is wanted on 1, on 2.
    let problem = Blocks { goal: vec![(0, Some(1)), (1, Some(2))] };
    let plan = solve(&problem, vec![None, None, Some(0)]).expect("every tower can be built");
    for (_, put) in &plan.steps {
        println!("{put}");
    }
    assert_eq!(plan.cost, 3.0);
    assert!(problem.is_goal(&plan.end));
}

#[test]
fn it_runs() {
    main();
}

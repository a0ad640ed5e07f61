//! A* over the states of any symbolic problem.
//!
//! The planner of PHASE poses its problems as [`PlanningTask`](crate::task::PlanningTask)s; any other type
//! that implements [`SymbolicProblem`] is solved in the same way. The examples `blocks` and `logistics` state
//! two classic domains.

use crate::accuracy::{COST_RESOLUTION, HIGHEST_BOUND, HIGHEST_COST};
use std::hash::Hash;

/// A symbolic planning problem: states, operators with costs, a goal, and a lower bound on what is left.
///
/// Several agents are one problem: a state has the parts of all of them, and an operator says whose it is.
/// [`SymbolicPlan::part`] then picks one agent's own operators.
///
/// ```
/// use phase_planner::search::{SymbolicProblem, solve};
///
/// /// Two robots on a line of cells have to meet; the second is twice as expensive to move.
/// struct Meeting;
///
/// impl SymbolicProblem for Meeting {
///     type State = [i32; 2];
///     type Operator = (usize, i32);
///
///     fn successors(&self, cells: &[i32; 2]) -> impl IntoIterator<Item = ((usize, i32), [i32; 2], f32)> {
///         let cells = *cells;
///         [(0, 1), (0, -1), (1, 1), (1, -1)].map(move |(robot, move_by)| {
///             let mut after = cells;
///             after[robot] += move_by;
///             ((robot, move_by), after, [1.0, 2.0][robot])
///         })
///     }
///
///     fn is_goal(&self, cells: &[i32; 2]) -> bool {
///         cells[0] == cells[1]
///     }
///
///     fn heuristic(&self, cells: &[i32; 2]) -> f32 {
///         (cells[0] - cells[1]).abs() as f32
///     }
/// }
///
/// let plan = solve(&Meeting, [0, 3]).ok_or("no plan")?;
/// assert_eq!(plan.cost, 3.0);
/// assert_eq!(plan.part(|&(robot, _)| robot == 0).count(), 3); // the cheap one walks
/// # Ok::<(), &str>(())
/// ```
pub trait SymbolicProblem {
    /// A state. States that are equal are one state, however they were reached.
    type State: Clone + Eq + Hash;
    /// An action that leads from one state to another.
    type Operator;

    /// Every operator that can be applied in a state, with the state after it and its cost.
    ///
    /// Costs lie between 0 and 10⁶ in a unit of the problem's own; lower ones, and NaN, count as 0, higher
    /// ones as 10⁶. They are rounded up to 1/256. The number of states that can be reached has to be finite
    /// where there may be no plan, or [`solve`] does not end.
    fn successors(&self, state: &Self::State)
    -> impl IntoIterator<Item = (Self::Operator, Self::State, f32)>;

    /// Whether the goal holds in a state.
    fn is_goal(&self, state: &Self::State) -> bool;

    /// A lower bound on the cost from a state to the nearest goal state.
    ///
    /// The plan that is found is the cheapest if the bound is never too high; 0, the default, always is a
    /// lower bound and makes A* Dijkstra's algorithm. Infinity says that no goal can be reached. No state is
    /// expanded twice if the bound is *consistent* too: no operator lowers it by more than its own cost.
    fn heuristic(&self, _state: &Self::State) -> f32 {
        0.0
    }
}

/// A plan: operators with the states they are applied in, in order, and the total cost.
#[derive(Clone, PartialEq, Debug)]
pub struct SymbolicPlan<State, Operator> {
    /// Each operator with the state it is applied in.
    pub steps: Vec<(State, Operator)>,
    /// The state at the end.
    pub end: State,
    /// Sum of the operators' costs, each rounded up to 1/256.
    pub cost: f32,
}

impl<State, Operator> SymbolicPlan<State, Operator> {
    /// The steps of the operators that `is_own` accepts, such as those of one agent of a joint plan, in
    /// order.
    pub fn part(&self, is_own: impl Fn(&Operator) -> bool) -> impl Iterator<Item = &(State, Operator)> {
        self.steps.iter().filter(move |(_, operator)| is_own(operator))
    }
}

/// The result of a search with a bound.
#[derive(Clone, PartialEq, Debug)]
pub struct SearchOutcome<State, Operator> {
    /// A plan, the cheapest one unless the search was cut; `None` if there is none, or none was found.
    pub plan: Option<SymbolicPlan<State, Operator>>,
    /// Number of states that were expanded.
    pub expanded: usize,
    /// Whether the search would have expanded more states than it may.
    pub is_cut: bool,
}

/// The cheapest plan from a state to one in which the goal holds; `None` if there is none.
#[must_use]
pub fn solve<P: SymbolicProblem>(
    problem: &P,
    start: P::State,
) -> Option<SymbolicPlan<P::State, P::Operator>> {
    solve_within(problem, start, usize::MAX).plan
}

/// The cheapest plan as of [`solve`], if no more than so many states have to be expanded for it. A search
/// that is cut ends with what it knows, which may be a plan that is not the cheapest.
///
/// A plan that may cost up to `w` times as much as the cheapest is found sooner if
/// [`heuristic`](SymbolicProblem::heuristic) returns `w` times a lower bound.
///
/// ```
/// use phase_planner::search::{SymbolicProblem, solve_within};
///
/// /// Counting up, without an end and with no number to stop at.
/// struct Endless;
///
/// impl SymbolicProblem for Endless {
///     type State = u64;
///     type Operator = ();
///
///     fn successors(&self, number: &u64) -> impl IntoIterator<Item = ((), u64, f32)> {
///         [((), number + 1, 1.0)]
///     }
///
///     fn is_goal(&self, _number: &u64) -> bool {
///         false
///     }
/// }
///
/// let outcome = solve_within(&Endless, 0, 1000);
/// assert!(outcome.plan.is_none() && outcome.is_cut);
/// assert_eq!(outcome.expanded, 1000);
/// ```
#[must_use]
pub fn solve_within<P: SymbolicProblem>(
    problem: &P,
    start: P::State,
    most: usize,
) -> SearchOutcome<P::State, P::Operator> {
    let mut expanded = 0;
    let mut is_cut = false;
    let after = |state: &P::State| {
        if expanded == most {
            is_cut = true;
            return Vec::new();
        }
        expanded += 1;
        let successors = problem.successors(state).into_iter();
        successors.map(|(_, after, cost)| (after, quantise(cost))).collect::<Vec<_>>()
    };
    let found = pathfinding::prelude::astar(
        &start,
        after,
        |state| ((problem.heuristic(state) * COST_RESOLUTION) as u64).min(HIGHEST_BOUND),
        |state| problem.is_goal(state),
    );
    SearchOutcome { plan: found.map(|found| plan(problem, start, found)), expanded, is_cut }
}

/// The operators that lead along some states, at a cost in A*'s units.
fn plan<P: SymbolicProblem>(
    problem: &P,
    start: P::State,
    (mut states, cost): (Vec<P::State>, u64),
) -> SymbolicPlan<P::State, P::Operator> {
    let operators: Vec<P::Operator> = states
        .windows(2)
        .filter_map(|pair| {
            problem
                .successors(&pair[0])
                .into_iter()
                .filter(|(_, after, _)| *after == pair[1])
                .min_by(|a, b| quantise(a.2).cmp(&quantise(b.2)).then(a.2.total_cmp(&b.2)))
                .map(|(operator, ..)| operator)
        })
        .collect();
    let end = states.pop().unwrap_or(start);
    SymbolicPlan {
        steps: states.into_iter().zip(operators).collect(),
        end,
        cost: cost as f32 / COST_RESOLUTION,
    }
}

/// A cost in A*'s units, rounded up so that a lower bound remains one. NaN counts as 0.
fn quantise(cost: f32) -> u64 {
    libm::ceilf(cost.clamp(0.0, HIGHEST_COST) * COST_RESOLUTION) as u64
}

//! The result of a search.

/// The chosen action with the statistics that support it.
#[derive(Debug, Clone, PartialEq)]
pub struct Decision {
    /// The action to take: the most visited at the root; ties are broken by larger value, then smaller index.
    pub action: usize,
    /// The statistics of every action, by action index.
    pub actions: Vec<ActionStatistics>,
    /// The cost of the search.
    pub effort: SearchStatistics,
}

impl Decision {
    /// Selects the action from the statistics. `actions` has one entry per action and is not empty.
    pub(crate) fn new(actions: Vec<ActionStatistics>, effort: SearchStatistics) -> Self {
        let mut action = 0;
        for (candidate, evidence) in actions.iter().enumerate().skip(1) {
            let best = actions[action];
            let more_visited = evidence.visits > best.visits;
            let as_visited_and_better = evidence.visits == best.visits && evidence.value > best.value;
            if more_visited || as_visited_and_better {
                action = candidate;
            }
        }
        Self { action, actions, effort }
    }

    /// The mean return of the chosen action: the value of the belief under this search.
    pub fn value(&self) -> f64 {
        self.actions[self.action].value
    }
}

/// Statistics of the simulations that began with one action.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ActionStatistics {
    /// Number of simulations that began with it.
    pub visits: usize,
    /// The mean of their discounted returns, in the reward's unit; 0 where there were none.
    pub value: f64,
}

/// The cost of one search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SearchStatistics {
    /// Histories in the final tree, including the root.
    pub histories: usize,
    /// The longest path from the root that a simulation took by selection, in actions; rollouts not counted.
    pub depth: usize,
    /// Steps of the model, rollouts included.
    pub steps: usize,
}

//! The search tree as three flat vectors that are cleared, never freed, between searches.

use rand::{Rng, RngExt};

use crate::puct::{self, ExplorationTable, ValueRange};
use crate::{ActionView, HistoryView, PomcpError, PomcpSettings};

/// The index of a history in its tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct HistoryId(u32);

/// The index of an action after a history.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ActionId(u32);

impl HistoryId {
    /// The empty history.
    pub(crate) const ROOT: Self = Self(0);

    /// Histories are numbered from 0 in the order in which they are added.
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// Histories of own actions and observations, with the returns after them.
///
/// The caller ensures that histories × actions fits 32 bits.
#[derive(Debug, Clone)]
pub(crate) struct Tree<O> {
    histories: Vec<History>,
    actions: Vec<Action>,
    branches: Vec<Branch<O>>,
}

/// A node reached by actions and observations. Its actions are contiguous; they are added when the history is
/// reached for the second time, since most leaves never are.
#[derive(Debug, Clone, Copy)]
struct History {
    visits: u32,
    first_action: u32,
    action_count: u32,
    /// Legal actions without visits.
    untried: u32,
}

#[derive(Debug, Clone, Copy)]
struct Action {
    visits: u32,
    /// The newest of the branches added after this action, or [`NONE`].
    branch: u32,
    value: f64,
    /// Prior probability, or [`ILLEGAL`].
    prior: f64,
}

/// An observation made after an action, and the history it leads to. An action's branches form a linked list,
/// so that adding one does not move any other and needs no separate vector.
#[derive(Debug, Clone)]
struct Branch<O> {
    observation: O,
    child: u32,
    next: u32,
}

const NONE: u32 = u32::MAX;
/// The prior of an action that must not be taken.
const ILLEGAL: f64 = -1.0;

impl<O: PartialEq> Tree<O> {
    /// A tree with an unvisited root.
    pub(crate) fn new() -> Self {
        Self { histories: vec![History::LEAF], actions: Vec::new(), branches: Vec::new() }
    }

    /// Resets the tree to an unvisited root.
    pub(crate) fn reset(&mut self) {
        self.histories.clear();
        self.actions.clear();
        self.branches.clear();
        self.histories.push(History::LEAF);
    }

    pub(crate) fn history_count(&self) -> usize {
        self.histories.len()
    }

    /// Number of simulations that chose an action after a history.
    pub(crate) fn visits(&self, history: HistoryId) -> usize {
        self.histories[history.index()].visits as usize
    }

    pub(crate) fn has_actions(&self, history: HistoryId) -> bool {
        self.histories[history.0 as usize].action_count > 0
    }

    /// Expands a leaf with its actions. The priors of those that are legal are proportional to `weights`.
    pub(crate) fn add_actions(
        &mut self,
        history: HistoryId,
        weights: &[f64],
        is_legal: impl Fn(usize) -> bool,
    ) -> Result<(), PomcpError> {
        let first = self.actions.len();
        let mut last = 0.0;
        let mut sum = 0.0_f64;
        let mut untried = 0;
        for (action, &weight) in weights.iter().enumerate() {
            if !is_legal(action) {
                self.actions.push(Action::with_prior(ILLEGAL));
                continue;
            }
            untried += 1;
            last = weight;
            sum += weight;
            if weight.is_nan() || weight < 0.0 || sum.is_infinite() {
                return Err(PomcpError::InvalidPrior { weight, sum });
            }
            self.actions.push(Action::with_prior(weight));
        }
        if untried == 0 {
            return Err(PomcpError::NoLegalAction);
        }
        if sum <= 0.0 {
            return Err(PomcpError::InvalidPrior { weight: last, sum });
        }
        let added = &mut self.actions[first..];
        for action in added.iter_mut().filter(|action| action.is_legal()) {
            action.prior /= sum;
        }
        let action_count = added.len() as u32;
        self.histories[history.0 as usize] =
            History { first_action: first as u32, action_count, untried, ..History::LEAF };
        Ok(())
    }

    /// The next action to try after an expanded history: while there are actions never tried, one of them,
    /// uniformly sampled, if the settings ask for it; otherwise the one with the maximum PUCT score, of
    /// smallest index among equals.
    pub(crate) fn select(
        &self,
        history: HistoryId,
        settings: &PomcpSettings,
        table: &mut ExplorationTable,
        range: &ValueRange,
        random: &mut impl Rng,
    ) -> usize {
        let node = &self.histories[history.0 as usize];
        let actions = self.actions_of(node);
        if node.untried > 0 && settings.untried_first {
            let drawn = random.random_range(0..node.untried) as usize;
            let mut untried = actions.iter().enumerate().filter(|(_, action)| action.is_untried());
            return untried.nth(drawn).map_or(0, |(index, _)| index);
        }
        // At the first visit, too, the priors decide.
        let exploration = table.at(settings, node.visits.max(1));
        let mean = node.mean(actions);
        let mut best = (0, f64::NEG_INFINITY);
        for (index, action) in actions.iter().enumerate().filter(|(_, action)| action.is_legal()) {
            let value = if action.visits == 0 { mean } else { action.value };
            let value = if settings.normalise_values { range.normalise(value) } else { value };
            let score = puct::score(value, action.prior, exploration, action.visits);
            if score > best.1 {
                best = (index, score);
            }
        }
        best.0
    }

    /// The node of one of a history's actions.
    pub(crate) fn action(&self, history: HistoryId, action: usize) -> ActionId {
        ActionId(self.histories[history.0 as usize].first_action + action as u32)
    }

    /// The history that an observation after an action leads to, and whether it had to be added.
    pub(crate) fn child(&mut self, action: ActionId, observation: O) -> (HistoryId, bool) {
        let newest = self.actions[action.0 as usize].branch;
        let mut next = newest;
        while next != NONE {
            let branch = &self.branches[next as usize];
            if branch.observation == observation {
                return (HistoryId(branch.child), false);
            }
            next = branch.next;
        }
        let child = self.histories.len() as u32;
        self.histories.push(History::LEAF);
        self.actions[action.0 as usize].branch = self.branches.len() as u32;
        self.branches.push(Branch { observation, child, next: newest });
        (HistoryId(child), true)
    }

    /// Number of simulations that chose an action.
    pub(crate) fn action_visits(&self, action: ActionId) -> u32 {
        self.actions[action.0 as usize].visits
    }

    /// The histories after an action, the newest first.
    pub(crate) fn histories_after(&self, action: ActionId) -> impl Iterator<Item = HistoryId> {
        self.branches_of(&self.actions[action.0 as usize]).map(|branch| HistoryId(branch.child))
    }

    /// The observation that leads from an action to a history.
    pub(crate) fn observation_of(&self, action: ActionId, history: HistoryId) -> Option<&O> {
        let mut branches = self.branches_of(&self.actions[action.0 as usize]);
        branches.find(|branch| branch.child == history.0).map(|branch| &branch.observation)
    }

    /// The history added last after an action.
    pub(crate) fn newest_child(&self, action: ActionId) -> Option<HistoryId> {
        let branch = self.branches.get(self.actions[action.0 as usize].branch as usize)?;
        Some(HistoryId(branch.child))
    }

    /// The history that an observation after an action leads to, if it is in the tree.
    pub(crate) fn find(&self, history: HistoryId, action: usize, observation: &O) -> Option<HistoryId> {
        let node = &self.histories[history.index()];
        let mut branches = self.branches_of(self.actions_of(node).get(action)?);
        branches.find(|branch| branch.observation == *observation).map(|it| HistoryId(it.child))
    }

    /// Makes a history the root, and drops everything that does not follow it. Statistics stay as they are.
    pub(crate) fn keep(&mut self, root: HistoryId) {
        let mut old = std::mem::replace(self, Self::new());
        let mut branches: Vec<_> = old.branches.drain(..).map(Some).collect();
        // Old and new numbers of histories that are still to be copied.
        let mut open = vec![(root.0, 0)];
        while let Some((from, to)) = open.pop() {
            let node = old.histories[from as usize];
            let first = node.first_action as usize;
            let first_action = self.actions.len() as u32;
            self.histories[to as usize] = History { first_action, ..node };
            for action in &old.actions[first..first + node.action_count as usize] {
                let mut newest = NONE;
                let mut next = action.branch;
                let mut kept = Vec::new();
                while let Some(branch) = branches.get_mut(next as usize).and_then(Option::take) {
                    next = branch.next;
                    kept.push(branch);
                }
                // The newest is first in the list, and is added last.
                for Branch { observation, child, .. } in kept.into_iter().rev() {
                    let new = self.histories.len() as u32;
                    self.histories.push(History::LEAF);
                    open.push((child, new));
                    self.branches.push(Branch { observation, child: new, next: newest });
                    newest = self.branches.len() as u32 - 1;
                }
                self.actions.push(Action { branch: newest, ..*action });
            }
        }
    }

    /// The mean values of all actions in the tree that were tried.
    pub(crate) fn values(&self) -> impl Iterator<Item = f64> {
        self.actions.iter().filter(|action| action.visits > 0).map(|action| action.value)
    }

    /// The tree below a history as data, `levels` of actions deep, without what has fewer visits.
    pub(crate) fn view(&self, history: HistoryId, levels: u8, least_visits: usize) -> HistoryView<O>
    where
        O: Clone,
    {
        let node = &self.histories[history.index()];
        let is_shown = |visits: u32| visits as usize >= least_visits;
        let mut actions = Vec::new();
        let all = self.actions_of(node).iter().enumerate();
        for (action, of) in all.filter(|(_, of)| levels > 0 && of.is_legal() && is_shown(of.visits)) {
            let mut branches: Vec<_> = self
                .branches_of(of)
                .filter(|branch| is_shown(self.histories[branch.child as usize].visits))
                .map(|branch| {
                    let after = self.view(HistoryId(branch.child), levels - 1, least_visits);
                    (branch.observation.clone(), after)
                })
                .collect();
            // The oldest first among equals.
            branches.reverse();
            branches.sort_by_key(|(_, after)| std::cmp::Reverse(after.visits));
            let (visits, value, prior) = (of.visits as usize, of.value, of.prior);
            actions.push(ActionView { action, visits, value, prior, branches });
        }
        actions.sort_by(|a, b| b.visits.cmp(&a.visits).then(b.value.total_cmp(&a.value)));
        HistoryView { visits: node.visits as usize, actions }
    }

    /// The branches of an action, the newest first.
    fn branches_of(&self, action: &Action) -> impl Iterator<Item = &Branch<O>> {
        let mut next = action.branch;
        core::iter::from_fn(move || {
            let branch = self.branches.get(next as usize)?;
            next = branch.next;
            Some(branch)
        })
    }

    /// Counts a visit of an action with return `value`, and returns the action's new mean.
    pub(crate) fn record(&mut self, history: HistoryId, action: ActionId, value: f64) -> f64 {
        let node = &mut self.histories[history.0 as usize];
        let action = &mut self.actions[action.0 as usize];
        if action.is_untried() {
            node.untried -= 1;
        }
        node.visits += 1;
        action.visits += 1;
        action.value += (value - action.value) / f64::from(action.visits);
        action.value
    }

    /// Visits and mean value of each of a history's actions.
    pub(crate) fn evidence(&self, history: HistoryId) -> impl Iterator<Item = (u32, f64)> {
        let actions = self.actions_of(&self.histories[history.0 as usize]);
        actions.iter().map(|action| (action.visits, action.value))
    }

    /// Whether the most visited action at the root remains so whatever the next `left` simulations do.
    pub(crate) fn is_decided(&self, left: usize) -> bool {
        let mut most = 0;
        let mut second = 0;
        for (visits, _) in self.evidence(HistoryId::ROOT) {
            if visits > most {
                (most, second) = (visits, most);
            } else {
                second = second.max(visits);
            }
        }
        (most - second) as usize > left
    }

    /// The shares of the visits of each action at the root; zero where none was visited.
    pub(crate) fn policy(&self) -> Vec<f64> {
        let visits: Vec<f64> = self.evidence(HistoryId::ROOT).map(|(visits, _)| f64::from(visits)).collect();
        let sum = visits.iter().sum::<f64>().max(1.0);
        visits.into_iter().map(|visits| visits / sum).collect()
    }

    fn actions_of(&self, node: &History) -> &[Action] {
        let first = node.first_action as usize;
        &self.actions[first..first + node.action_count as usize]
    }
}

impl Action {
    fn with_prior(prior: f64) -> Self {
        Self { visits: 0, branch: NONE, value: 0.0, prior }
    }

    fn is_legal(&self) -> bool {
        self.prior >= 0.0
    }

    fn is_untried(&self) -> bool {
        self.visits == 0 && self.is_legal()
    }
}

impl History {
    const LEAF: Self = Self { visits: 0, first_action: 0, action_count: 0, untried: 0 };

    /// The mean of all returns after this history; 0 before the first.
    fn mean(&self, actions: &[Action]) -> f64 {
        let sum: f64 = actions.iter().map(|action| f64::from(action.visits) * action.value).sum();
        sum / f64::from(self.visits.max(1))
    }
}

//! One simulation after another: selection, expansion, rollout and backup.

use rand::Rng;
use std::ops::ControlFlow;

use crate::puct::{ExplorationTable, ValueRange};
use crate::tree::{ActionId, HistoryId, Tree};
use crate::widening::{Branching, Made};
use crate::{GenerativeModel, PomcpError, PomcpSettings, Transition};

/// State that the simulations of one search share.
pub(crate) struct Simulations<'a, M: GenerativeModel, B> {
    pub(crate) model: &'a M,
    pub(crate) settings: &'a PomcpSettings,
    pub(crate) action_count: usize,
    pub(crate) discount: f64,
    pub(crate) tree: &'a mut Tree<M::Observation>,
    /// The rule by which observations become branches of the tree.
    pub(crate) branching: B,
    /// The next state and reward of every history of the tree, for a deterministic model.
    pub(crate) known: Option<Vec<(M::State, f64)>>,
    pub(crate) table: &'a mut ExplorationTable,
    pub(crate) range: ValueRange,
    /// The prior weights of the history that is being expanded.
    pub(crate) weights: Vec<f64>,
    /// Steps inside the tree of the simulation under way.
    pub(crate) path: &'a mut Vec<PathStep>,
    /// The longest path so far.
    pub(crate) depth: usize,
    /// Steps of the model so far.
    pub(crate) steps: usize,
}

/// One step that a simulation took inside the tree.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PathStep {
    history: HistoryId,
    action: ActionId,
    reward: f64,
}

/// Returns up to this size can be averaged, and their differences taken, without overflow.
const RETURN_LIMIT: f64 = f64::MAX / 4.0;

impl<M: GenerativeModel, B: Branching<M>> Simulations<'_, M, B> {
    /// Runs one simulation from a root state to its end, and backs up its return.
    pub(crate) fn run(&mut self, state: &mut M::State, random: &mut impl Rng) -> Result<(), PomcpError> {
        self.path.clear();
        let mut history = HistoryId::ROOT;
        loop {
            match self.step(history, state, random)? {
                ControlFlow::Continue(child) => history = child,
                ControlFlow::Break(rest) => return self.back_up(rest),
            }
        }
    }

    /// Selects an action at `history` and takes its step. Continues with the history that it leads to, or
    /// breaks with the return beyond the path.
    fn step(
        &mut self,
        history: HistoryId,
        state: &mut M::State,
        random: &mut impl Rng,
    ) -> Result<ControlFlow<f64, HistoryId>, PomcpError> {
        self.expand(history, state)?;
        let chosen = self.tree.select(history, self.settings, self.table, &self.range, random);
        let action = self.tree.action(history, chosen);
        if let Some(known) = &self.known {
            if let Some(child) = self.tree.newest_child(action) {
                let (there, reward) = &known[child.index()];
                self.path.push(PathStep { history, action, reward: *reward });
                if self.path.len() >= self.settings.horizon {
                    return self.estimate(there).map(ControlFlow::Break);
                }
                return Ok(ControlFlow::Continue(child));
            }
            state.clone_from(&known[history.index()].0);
        }
        let Transition { observation, reward, terminal } = self.model.step(state, chosen, random);
        self.count_step(chosen, reward)?;
        self.path.push(PathStep { history, action, reward });
        if terminal {
            return Ok(ControlFlow::Break(0.0));
        }
        if self.path.len() >= self.settings.horizon {
            return self.estimate(state).map(ControlFlow::Break);
        }
        let made = Made { action: chosen, node: action, observation, reward };
        let next = self.branching.next(self.model, self.tree, made, state, random)?;
        if let Some(step) = self.path.last_mut() {
            step.reward = next.reward;
        }
        if !next.is_new {
            return Ok(ControlFlow::Continue(next.history));
        }
        if let Some(known) = &mut self.known {
            known.push((state.clone(), reward));
        }
        self.rollout(state, random).map(ControlFlow::Break)
    }

    /// Adds a history's actions to the tree, if they are not there yet.
    fn expand(&mut self, history: HistoryId, state: &M::State) -> Result<(), PomcpError> {
        if self.tree.has_actions(history) {
            return Ok(());
        }
        let here = self.known.as_ref().map_or(state, |known| &known[history.index()].0);
        self.weights.clear();
        self.model.prior_weights(here, &mut self.weights);
        let weights = self.weights.len();
        let action_count = self.action_count;
        if weights != action_count {
            return Err(PomcpError::PriorCount { weights, action_count });
        }
        self.tree.add_actions(history, &self.weights, |action| self.model.is_legal(here, action))
    }

    /// Follows the default policy from a new history on, and returns the discounted return.
    fn rollout(&mut self, state: &mut M::State, random: &mut impl Rng) -> Result<f64, PomcpError> {
        let steps = self.settings.rollout_steps.min(self.settings.horizon - self.path.len());
        let mut total = 0.0;
        let mut weight = 1.0;
        for _ in 0..steps {
            let action = self.rollout_action(state, random)?;
            let Transition { reward, terminal, .. } = self.model.rollout_step(state, action, random);
            self.count_step(action, reward)?;
            total += weight * reward;
            weight *= self.discount;
            if terminal {
                return Ok(total);
            }
        }
        Ok(total + weight * self.estimate(state)?)
    }

    /// The action of the default policy, checked.
    fn rollout_action(&self, state: &M::State, random: &mut impl Rng) -> Result<usize, PomcpError> {
        let action = self.model.rollout_action(state, random);
        let action_count = self.action_count;
        if action >= action_count {
            return Err(PomcpError::RolloutActionOutOfRange { action, action_count });
        }
        if !self.model.is_legal(state, action) {
            return Err(PomcpError::IllegalRolloutAction { action });
        }
        Ok(action)
    }

    /// Counts a step of the model and checks its reward.
    fn count_step(&mut self, action: usize, reward: f64) -> Result<(), PomcpError> {
        self.steps += 1;
        if reward.is_finite() { Ok(()) } else { Err(PomcpError::NonFiniteReward { action, reward }) }
    }

    fn estimate(&self, state: &M::State) -> Result<f64, PomcpError> {
        let estimate = self.model.value_estimate(state);
        if estimate.is_finite() { Ok(estimate) } else { Err(PomcpError::NonFiniteEstimate { estimate }) }
    }

    /// Averages the return from each step of the path on into that step's action, the last step first. `rest`
    /// is the return beyond the path.
    fn back_up(&mut self, rest: f64) -> Result<(), PomcpError> {
        let mut value = rest;
        for step in self.path.iter().rev() {
            value = step.reward + self.discount * value;
            if value.is_nan() || value.abs() > RETURN_LIMIT {
                return Err(PomcpError::ReturnOverflow { value });
            }
            let mean = self.tree.record(step.history, step.action, value);
            self.range.include(mean);
        }
        self.depth = self.depth.max(self.path.len());
        Ok(())
    }
}

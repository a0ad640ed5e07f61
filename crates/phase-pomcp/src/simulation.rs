//! One simulation: selection, expansion, rollout and backup.

use rand::Rng;

use crate::puct::ValueRange;
use crate::tree::{ActionId, HistoryId, Tree};
use crate::{GenerativeModel, PomcpError, PomcpSettings};

/// The data shared by the simulations of one search.
pub(crate) struct Simulation<'a, M: GenerativeModel> {
    pub(crate) model: &'a M,
    pub(crate) settings: &'a PomcpSettings,
    pub(crate) action_count: usize,
    pub(crate) discount: f64,
    pub(crate) tree: &'a mut Tree<M::Observation>,
    pub(crate) path: &'a mut Vec<PathStep>,
    /// The next state and reward of every history of the tree, for a deterministic model.
    pub(crate) known: Option<Vec<(M::State, f64)>>,
    pub(crate) range: ValueRange,
    /// The prior weights of the history that is being expanded.
    pub(crate) weights: Vec<f64>,
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

impl<M: GenerativeModel> Simulation<'_, M> {
    /// Runs one simulation from `state`, which it consumes.
    pub(crate) fn run(&mut self, state: &mut M::State, random: &mut impl Rng) -> Result<(), PomcpError> {
        let rest = self.descend(state, random)?;
        self.depth = self.depth.max(self.path.len());
        self.back_up(rest)
    }

    /// Follows the tree down to a leaf, stores the path in `path`, and returns the return beyond it.
    fn descend(&mut self, state: &mut M::State, random: &mut impl Rng) -> Result<f64, PomcpError> {
        self.path.clear();
        let mut history = HistoryId::ROOT;
        loop {
            if !self.tree.has_actions(history) {
                let here = self.known.as_ref().map_or(&*state, |known| &known[history.index()].0);
                self.weights.clear();
                self.model.prior_weights(here, &mut self.weights);
                let (weights, action_count) = (self.weights.len(), self.action_count);
                if weights != action_count {
                    return Err(PomcpError::PriorCount { weights, action_count });
                }
                self.tree.add_actions(history, &self.weights)?;
            }
            let chosen = self.tree.select(history, self.settings, &self.range, random);
            let action = self.tree.action(history, chosen);
            if let Some(known) = &self.known {
                if let Some(child) = self.tree.newest_child(action) {
                    let (there, reward) = &known[child.index()];
                    self.path.push(PathStep { history, action, reward: *reward });
                    if self.path.len() >= self.settings.horizon {
                        return self.estimate(there);
                    }
                    history = child;
                    continue;
                }
                state.clone_from(&known[history.index()].0);
            }
            let outcome = self.model.step(state, chosen, random);
            self.check(chosen, outcome.reward)?;
            self.path.push(PathStep { history, action, reward: outcome.reward });
            if outcome.terminal {
                return Ok(0.0);
            }
            if self.path.len() >= self.settings.horizon {
                return self.estimate(state);
            }
            let (child, is_new) = self.tree.child(action, outcome.observation);
            if let Some(known) = &mut self.known {
                known.push((state.clone(), outcome.reward));
            }
            if is_new {
                return self.roll_out(state, random);
            }
            history = child;
        }
    }

    /// The discounted return of the default policy from `state` on.
    fn roll_out(&mut self, state: &mut M::State, random: &mut impl Rng) -> Result<f64, PomcpError> {
        let action_count = self.action_count;
        let steps_left = self.settings.horizon - self.path.len();
        let (mut total, mut weight) = (0.0, 1.0);
        for _ in 0..self.settings.rollout_steps.min(steps_left) {
            let action = self.model.rollout_action(state, random);
            if action >= action_count {
                return Err(PomcpError::RolloutActionOutOfRange { action, action_count });
            }
            let outcome = self.model.rollout_step(state, action, random);
            self.check(action, outcome.reward)?;
            total += weight * outcome.reward;
            weight *= self.discount;
            if outcome.terminal {
                return Ok(total);
            }
        }
        Ok(total + weight * self.estimate(state)?)
    }

    /// Counts a step of the model and checks its reward.
    fn check(&mut self, action: usize, reward: f64) -> Result<(), PomcpError> {
        self.steps += 1;
        if reward.is_finite() { Ok(()) } else { Err(PomcpError::NonFiniteReward { action, reward }) }
    }

    fn estimate(&self, state: &M::State) -> Result<f64, PomcpError> {
        let estimate = self.model.value_estimate(state);
        if estimate.is_finite() { Ok(estimate) } else { Err(PomcpError::NonFiniteEstimate { estimate }) }
    }

    /// Averages the return from each step of the path on into that step's action, the last step first.
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
        Ok(())
    }
}

//! Simulations under way: selection, expansion, rollout and backup.

use rand::Rng;

use crate::puct::{ExplorationTable, ValueRange};
use crate::tree::{ActionId, HistoryId, Tree};
use crate::{GenerativeModel, PomcpError, PomcpSettings, Transition};

/// What the simulations of one search share.
pub(crate) struct Simulations<'a, M: GenerativeModel> {
    pub(crate) model: &'a M,
    pub(crate) settings: &'a PomcpSettings,
    pub(crate) action_count: usize,
    pub(crate) discount: f64,
    pub(crate) tree: &'a mut Tree<M::Observation>,
    /// The next state and reward of every history of the tree, for a deterministic model.
    pub(crate) known: Option<Vec<(M::State, f64)>>,
    pub(crate) table: &'a mut ExplorationTable,
    pub(crate) range: ValueRange,
    /// The prior weights of the history that is being expanded.
    pub(crate) weights: Vec<f64>,
    /// The longest path so far.
    pub(crate) depth: usize,
    /// Steps of the model so far.
    pub(crate) steps: usize,
}

/// One simulation under way; its state is kept beside it.
#[derive(Debug, Clone)]
pub(crate) struct Simulation {
    pub(crate) stage: Stage,
    /// The action of its next step, once chosen.
    pub(crate) action: usize,
    path: Vec<PathStep>,
}

/// Where a simulation is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Stage {
    /// In the tree, at a history; the action chosen there is set with it.
    Tree { history: HistoryId, chosen: Option<ActionId> },
    /// In a rollout from a history: its discounted return so far, the weight of its next reward, and the steps left.
    Rollout { from: HistoryId, total: f64, weight: f64, left: usize },
    /// Backed up, or not started.
    Ended,
}

/// One step that a simulation took inside the tree.
#[derive(Debug, Clone, Copy)]
struct PathStep {
    history: HistoryId,
    action: ActionId,
    reward: f64,
}

/// Returns up to this size can be averaged, and their differences taken, without overflow.
const RETURN_LIMIT: f64 = f64::MAX / 4.0;

impl Simulation {
    /// A place for simulations, none of which has started.
    pub(crate) fn new() -> Self {
        Self { stage: Stage::Ended, action: 0, path: Vec::new() }
    }

    /// Places it at the root.
    pub(crate) fn start(&mut self) {
        self.path.clear();
        self.stage = Stage::Tree { history: HistoryId::ROOT, chosen: None };
    }
}

impl<M: GenerativeModel> Simulations<'_, M> {
    /// Chooses the action of a simulation's next step. A simulation in the tree may end instead, on steps that are
    /// known.
    #[inline(always)]
    pub(crate) fn choose(
        &mut self,
        simulation: &mut Simulation,
        state: &mut M::State,
        random: &mut impl Rng,
    ) -> Result<(), PomcpError> {
        if let Stage::Tree { history, .. } = simulation.stage {
            self.select(simulation, history, state, random)?;
        }
        if let Stage::Rollout { .. } = simulation.stage {
            let (action, action_count) = (self.model.rollout_action(state, random), self.action_count);
            if action >= action_count {
                return Err(PomcpError::RolloutActionOutOfRange { action, action_count });
            }
            if !self.model.is_legal(state, action) {
                return Err(PomcpError::IllegalRolloutAction { action });
            }
            simulation.action = action;
        }
        Ok(())
    }

    /// Takes a simulation to its end.
    pub(crate) fn finish(
        &mut self,
        simulation: &mut Simulation,
        state: &mut M::State,
        random: &mut impl Rng,
    ) -> Result<(), PomcpError> {
        loop {
            self.choose(simulation, state, random)?;
            match simulation.stage {
                Stage::Tree { .. } => {
                    let outcome = self.model.step(state, simulation.action, random);
                    self.after_step(simulation, state, outcome)?;
                }
                Stage::Rollout { .. } => {
                    let outcome = self.model.rollout_step(state, simulation.action, random);
                    self.after_rollout_step(simulation, state, outcome)?;
                }
                Stage::Ended => return Ok(()),
            }
        }
    }

    /// Selects an action at `history`, and at those that known steps lead to, until a step has to be computed.
    ///
    /// At a history of which nothing is known yet, the choice of an action would be blind: a rollout begins there.
    fn select(
        &mut self,
        simulation: &mut Simulation,
        mut history: HistoryId,
        state: &mut M::State,
        random: &mut impl Rng,
    ) -> Result<(), PomcpError> {
        loop {
            if self.tree.is_unknown(history, self.settings) {
                if let Some(known) = &self.known {
                    state.clone_from(&known[history.index()].0);
                }
                return self.start_rollout(simulation, history, state);
            }
            self.expand(history, state)?;
            let chosen = self.tree.select(history, self.settings, self.table, &self.range, random);
            let action = self.tree.action(history, chosen);
            self.tree.begin(history, action);
            if let Some(known) = &self.known {
                if let Some(child) = self.tree.newest_child(action) {
                    let (there, reward) = &known[child.index()];
                    simulation.path.push(PathStep { history, action, reward: *reward });
                    if simulation.path.len() >= self.settings.horizon {
                        let rest = self.estimate(there)?;
                        return self.back_up(simulation, rest);
                    }
                    history = child;
                    continue;
                }
                state.clone_from(&known[history.index()].0);
            }
            simulation.action = chosen;
            simulation.stage = Stage::Tree { history, chosen: Some(action) };
            return Ok(());
        }
    }

    /// Adds a history's actions to the tree, if they are not there yet.
    fn expand(&mut self, history: HistoryId, state: &M::State) -> Result<(), PomcpError> {
        if self.tree.has_actions(history) {
            return Ok(());
        }
        let here = self.known.as_ref().map_or(state, |known| &known[history.index()].0);
        self.weights.clear();
        self.model.prior_weights(here, &mut self.weights);
        let (weights, action_count) = (self.weights.len(), self.action_count);
        if weights != action_count {
            return Err(PomcpError::PriorCount { weights, action_count });
        }
        self.tree.add_actions(history, &self.weights, |action| self.model.is_legal(here, action))
    }

    /// Continues a simulation in the tree with the step that it took to `state`.
    pub(crate) fn after_step(
        &mut self,
        simulation: &mut Simulation,
        state: &M::State,
        outcome: Transition<M::Observation>,
    ) -> Result<(), PomcpError> {
        let Transition { observation, reward, terminal } = outcome;
        let Stage::Tree { history, chosen: Some(action) } = simulation.stage else { return Ok(()) };
        self.check(simulation.action, reward)?;
        simulation.path.push(PathStep { history, action, reward });
        if terminal {
            return self.back_up(simulation, 0.0);
        }
        let steps = simulation.path.len();
        if steps >= self.settings.horizon {
            let rest = self.estimate(state)?;
            return self.back_up(simulation, rest);
        }
        let (child, is_new) = self.tree.child(action, observation);
        if !is_new {
            simulation.stage = Stage::Tree { history: child, chosen: None };
            return Ok(());
        }
        if let Some(known) = &mut self.known {
            known.push((state.clone(), reward));
        }
        self.start_rollout(simulation, child, state)
    }

    /// Sends a simulation at `history` on a rollout, of no step if the settings say so.
    fn start_rollout(
        &mut self,
        simulation: &mut Simulation,
        history: HistoryId,
        state: &M::State,
    ) -> Result<(), PomcpError> {
        let left = self.settings.rollout_steps.min(self.settings.horizon - simulation.path.len());
        if left == 0 {
            let rest = 0.0 + self.estimate(state)?;
            return self.back_up(simulation, rest);
        }
        self.tree.begin_rollout(history);
        simulation.stage = Stage::Rollout { from: history, total: 0.0, weight: 1.0, left };
        Ok(())
    }

    /// Continues a rollout with the step that it took to `state`.
    #[inline(always)]
    pub(crate) fn after_rollout_step(
        &mut self,
        simulation: &mut Simulation,
        state: &M::State,
        outcome: Transition<()>,
    ) -> Result<(), PomcpError> {
        let Stage::Rollout { from, mut total, mut weight, left } = simulation.stage else { return Ok(()) };
        self.check(simulation.action, outcome.reward)?;
        total += weight * outcome.reward;
        weight *= self.discount;
        if !outcome.terminal && left > 1 {
            simulation.stage = Stage::Rollout { from, total, weight, left: left - 1 };
            return Ok(());
        }
        if !outcome.terminal {
            total += weight * self.estimate(state)?;
        }
        self.tree.end_rollout(from);
        self.back_up(simulation, total)
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

    /// Ends a simulation: averages the return from each step of its path on into that step's action, the last step
    /// first. `rest` is the return beyond the path.
    fn back_up(&mut self, simulation: &mut Simulation, rest: f64) -> Result<(), PomcpError> {
        let mut value = rest;
        for step in simulation.path.iter().rev() {
            value = step.reward + self.discount * value;
            if value.is_nan() || value.abs() > RETURN_LIMIT {
                return Err(PomcpError::ReturnOverflow { value });
            }
            let mean = self.tree.record(step.history, step.action, value);
            self.range.include(mean);
        }
        self.depth = self.depth.max(simulation.path.len());
        simulation.stage = Stage::Ended;
        Ok(())
    }
}

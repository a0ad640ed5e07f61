//! The search itself: simulate, grow, back up.

use rand::{Rng, RngExt};

use crate::puct::ValueRange;
use crate::tree::{ActionId, HistoryId, Tree};
use crate::{ActionValue, Decision, GenerativeModel, Outcome, PomcpError, PomcpSettings, SearchEffort};

/// A POMCP planner (Silver & Veness 2010) and the memory it searches in, over problems whose observations are
/// of type `O`.
///
/// Every search starts from an empty tree, and its result depends on the settings, the model, the particles
/// and the generator alone: not on what was searched before. Only the memory is kept, so that from the first
/// few searches on a search allocates its [`Decision`] and one copy of a state, and nothing per simulation.
#[derive(Debug, Clone)]
pub struct Pomcp<O> {
    settings: PomcpSettings,
    tree: Tree<O>,
    path: Vec<PathStep>,
    range: ValueRange,
    effort: SearchEffort,
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

impl<O: Eq> Pomcp<O> {
    /// A planner that has not searched yet.
    ///
    /// # Errors
    /// As [`PomcpSettings::validate`].
    pub fn new(settings: PomcpSettings) -> Result<Self, PomcpError> {
        settings.validate()?;
        Ok(Self {
            settings,
            tree: Tree::new(),
            path: Vec::new(),
            range: ValueRange::EMPTY,
            effort: SearchEffort::default(),
        })
    }

    /// The settings it searches with.
    pub fn settings(&self) -> &PomcpSettings {
        &self.settings
    }

    /// Finds what to do when the present is one of `roots`, all equally likely.
    ///
    /// Each simulation draws one of them, follows PUCT down the tree, grows the tree by the first history it
    /// does not know, plays the default policy from there, and averages the discounted return into every
    /// action it chose on the way. Among actions never tried at a history one is drawn evenly, so that each
    /// is tried once before PUCT compares them.
    ///
    /// # Errors
    /// [`PomcpError::NoRoots`], [`PomcpError::NoActions`] and [`PomcpError::TooLarge`] for what cannot be
    /// searched; the other kinds for a model that breaks one of its promises.
    pub fn search<M>(
        &mut self,
        model: &M,
        roots: &[M::State],
        random: &mut impl Rng,
    ) -> Result<Decision, PomcpError>
    where
        M: GenerativeModel<Observation = O>,
    {
        self.check(model)?;
        let mut state = roots.first().ok_or(PomcpError::NoRoots)?.clone();
        self.tree.reset();
        self.range = ValueRange::EMPTY;
        self.effort = SearchEffort::default();
        for _ in 0..self.settings.simulations {
            state.clone_from(&roots[random.random_range(0..roots.len())]);
            let rest = self.descend(model, &mut state, random)?;
            self.back_up(rest, model.discount())?;
        }
        self.effort.histories = self.tree.history_count();
        let evidence = self.tree.evidence(HistoryId::ROOT);
        let actions = evidence.map(|(visits, value)| ActionValue { visits: visits as usize, value });
        Ok(Decision::new(actions.collect(), self.effort))
    }

    fn check<M: GenerativeModel>(&self, model: &M) -> Result<(), PomcpError> {
        let action_count = model.action_count();
        if action_count == 0 {
            return Err(PomcpError::NoActions);
        }
        let simulations = self.settings.simulations;
        let most_nodes = simulations.checked_add(1).and_then(|histories| histories.checked_mul(action_count));
        if most_nodes.is_none_or(|most| most >= u32::MAX as usize) {
            return Err(PomcpError::TooLarge { simulations, action_count });
        }
        let discount = model.discount();
        if !(0.0..=1.0).contains(&discount) {
            return Err(PomcpError::InvalidDiscount { discount });
        }
        Ok(())
    }

    /// Follows the tree down to its edge, leaving the way in `path`, and returns what was earned beyond it.
    fn descend<M>(
        &mut self,
        model: &M,
        state: &mut M::State,
        random: &mut impl Rng,
    ) -> Result<f64, PomcpError>
    where
        M: GenerativeModel<Observation = O>,
    {
        self.path.clear();
        let mut history = HistoryId::ROOT;
        loop {
            if !self.tree.has_actions(history) {
                self.open(model, state, history)?;
            }
            let chosen = self.tree.select(history, &self.settings, &self.range, random);
            let action = self.tree.action(history, chosen);
            let outcome = self.step(model, state, chosen, random)?;
            self.path.push(PathStep { history, action, reward: outcome.reward });
            self.effort.depth = self.effort.depth.max(self.path.len());
            if outcome.terminal {
                return Ok(0.0);
            }
            if self.path.len() >= self.settings.horizon {
                return estimate(model, state);
            }
            let (child, is_new) = self.tree.child(action, outcome.observation);
            if is_new {
                return self.roll_out(model, state, random);
            }
            history = child;
        }
    }

    /// Gives a history its actions and their priors.
    fn open<M>(&mut self, model: &M, state: &M::State, history: HistoryId) -> Result<(), PomcpError>
    where
        M: GenerativeModel<Observation = O>,
    {
        let weights = (0..model.action_count()).map(|action| model.prior_weight(state, action));
        let (mut sum, mut last) = (0.0_f64, 0.0_f64);
        for weight in weights.clone() {
            sum += weight;
            last = weight;
            if !(weight >= 0.0 && sum.is_finite()) {
                return Err(PomcpError::InvalidPrior { weight, sum });
            }
        }
        if sum <= 0.0 {
            return Err(PomcpError::InvalidPrior { weight: last, sum });
        }
        self.tree.add_actions(history, weights, sum);
        Ok(())
    }

    /// The discounted return of the default policy from `state` on.
    fn roll_out<M>(
        &mut self,
        model: &M,
        state: &mut M::State,
        random: &mut impl Rng,
    ) -> Result<f64, PomcpError>
    where
        M: GenerativeModel<Observation = O>,
    {
        let action_count = model.action_count();
        let steps_left = self.settings.horizon - self.path.len();
        let (mut total, mut weight) = (0.0, 1.0);
        for _ in 0..self.settings.rollout_steps.min(steps_left) {
            let action = model.rollout_action(state, random);
            if action >= action_count {
                return Err(PomcpError::RolloutActionOutOfRange { action, action_count });
            }
            let outcome = self.step(model, state, action, random)?;
            total += weight * outcome.reward;
            weight *= model.discount();
            if outcome.terminal {
                return Ok(total);
            }
        }
        Ok(total + weight * estimate(model, state)?)
    }

    fn step<M>(
        &mut self,
        model: &M,
        state: &mut M::State,
        action: usize,
        random: &mut impl Rng,
    ) -> Result<Outcome<O>, PomcpError>
    where
        M: GenerativeModel<Observation = O>,
    {
        let outcome = model.step(state, action, random);
        self.effort.steps += 1;
        if !outcome.reward.is_finite() {
            return Err(PomcpError::NonFiniteReward { action, reward: outcome.reward });
        }
        Ok(outcome)
    }

    /// Averages what was earned from each step of the path on into that step's action, the last step first.
    fn back_up(&mut self, rest: f64, discount: f64) -> Result<(), PomcpError> {
        let mut value = rest;
        for step in self.path.iter().rev() {
            value = step.reward + discount * value;
            // Written so that a NaN is caught as well.
            if !(value.abs() <= RETURN_LIMIT) {
                return Err(PomcpError::ReturnOverflow { value });
            }
            let mean = self.tree.record(step.history, step.action, value);
            self.range.include(mean);
        }
        Ok(())
    }
}

fn estimate<M: GenerativeModel>(model: &M, state: &M::State) -> Result<f64, PomcpError> {
    let estimate = model.value_estimate(state);
    if estimate.is_finite() { Ok(estimate) } else { Err(PomcpError::NonFiniteEstimate { estimate }) }
}

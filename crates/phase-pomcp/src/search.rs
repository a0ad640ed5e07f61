//! The planner and its memory: one search from root particles to a decision.

use rand::{Rng, RngExt};

use crate::puct::{ExplorationTable, ValueRange};
use crate::simulation::{PathStep, Simulations};
use crate::tree::{HistoryId, Tree};
use crate::widening::{Branching, Distinct, Widened};
use crate::{
    ActionStatistics, Decision, GenerativeModel, HistoryView, ObservationModel, PomcpError, PomcpSettings,
    SearchStatistics, Widening,
};

/// A POMCP planner (Silver & Veness 2010) and the memory it searches in, over problems whose observations are
/// of type `O`.
///
/// A [`search`](Self::search) starts from an empty tree, and its result depends on the settings, the model,
/// the particles and the generator alone, not on earlier searches. Only the memory is reused, so that after
/// the first few searches a search allocates its [`Decision`] and one copy of a state, and nothing per
/// simulation; for a [deterministic](GenerativeModel::is_deterministic) model, a copy of every state in the
/// tree.
#[derive(Debug, Clone)]
pub struct Pomcp<O> {
    settings: PomcpSettings,
    tree: Tree<O>,
    table: ExplorationTable,
    path: Vec<PathStep>,
}

impl<O: PartialEq> Pomcp<O> {
    /// A planner that has not searched yet.
    ///
    /// # Errors
    /// As [`PomcpSettings::validate`].
    pub fn new(settings: PomcpSettings) -> Result<Self, PomcpError> {
        settings.validate()?;
        Ok(Self { settings, tree: Tree::new(), table: ExplorationTable::EMPTY, path: Vec::new() })
    }

    /// The settings it searches with.
    pub fn settings(&self) -> &PomcpSettings {
        &self.settings
    }

    /// Keeps, of the tree of the last search, what follows an action that was taken and the observation that
    /// was made, so that [`search_on`](Self::search_on) goes on from there; returns the number of simulations
    /// that this part has.
    ///
    /// An observation that no simulation made leaves an empty tree, and 0.
    pub fn keep(&mut self, action: usize, observation: &O) -> usize {
        match self.tree.find(HistoryId::ROOT, action, observation) {
            Some(history) => self.tree.keep(history),
            None => self.tree.reset(),
        }
        self.tree.visits(HistoryId::ROOT)
    }

    /// The tree of the last search as data: `levels` of actions deep, without actions and histories that have
    /// fewer visits than `least_visits`. Before the first search it is empty.
    #[must_use]
    pub fn view(&self, levels: u8, least_visits: usize) -> HistoryView<O>
    where
        O: Clone,
    {
        self.tree.view(HistoryId::ROOT, levels, least_visits)
    }

    /// Finds the action to take when the present state is one of `roots`, all equally likely.
    ///
    /// Each simulation samples one of them, follows PUCT down the tree, adds the first history that is not in
    /// the tree yet, follows the default policy from there, and backs up the discounted return to every
    /// action it chose on the path. Actions never tried at a history are sampled uniformly, so that each is
    /// tried once before PUCT compares them.
    ///
    /// # Errors
    /// [`PomcpError::NoRoots`], [`PomcpError::NoActions`] and [`PomcpError::TooLarge`] for invalid inputs;
    /// the other kinds for a model that violates its contract.
    pub fn search<M>(
        &mut self,
        model: &M,
        roots: &[M::State],
        random: &mut impl Rng,
    ) -> Result<Decision, PomcpError>
    where
        M: GenerativeModel<Observation = O>,
    {
        self.tree.reset();
        self.search_on(model, roots, random)
    }

    /// Finds the action as [`search`](Self::search) does, in the tree that [`keep`](Self::keep) left: its
    /// simulations count as well. `roots` is the belief after the observation; the model and the settings
    /// must be those of the search before.
    ///
    /// With fewer particles than simulations a search sees the same few states again and again. The part that
    /// is kept was made from states of the belief before, which this one has forgotten, so the statistics mix
    /// both. The first search after [`new`](Self::new) starts from an empty tree.
    ///
    /// # Errors
    /// As [`search`](Self::search).
    pub fn search_on<M>(
        &mut self,
        model: &M,
        roots: &[M::State],
        random: &mut impl Rng,
    ) -> Result<Decision, PomcpError>
    where
        M: GenerativeModel<Observation = O>,
    {
        // The states that a kept part was made from are gone.
        let remembers = self.tree.history_count() == 1 && model.is_deterministic() && roots.len() == 1;
        self.run(model, roots, Distinct, remembers, random)
    }

    /// Finds the action as [`search`](Self::search) does, where observations seldom repeat, such as real
    /// numbers: by POMCPOW (Sunberg & Kochenderfer 2018) with a finite set of actions.
    ///
    /// The first simulations of an action begin a branch for each observation; from then on, as `widening`
    /// says, most go on in one of those branches. A branch keeps every state that was simulated there,
    /// weighted by the likelihood of the branch's observation, and a simulation that comes there goes on with
    /// one that is drawn by weight. So the branch stands for a belief, which becomes finer with its visits,
    /// and the search does not take the state for known after a single observation. It keeps a copy of a
    /// state for every step that it takes in the tree, which `search` does not.
    ///
    /// # Errors
    /// As [`search`](Self::search), [`PomcpError::InvalidWidening`] and [`PomcpError::InvalidLikelihood`].
    pub fn search_widened<M>(
        &mut self,
        model: &M,
        roots: &[M::State],
        widening: Widening,
        random: &mut impl Rng,
    ) -> Result<Decision, PomcpError>
    where
        M: ObservationModel<Observation = O>,
    {
        widening.validate()?;
        self.tree.reset();
        self.run(model, roots, Widened::new(widening), false, random)
    }

    /// Runs the simulations of a search from the tree as it is. `remembers`: whether steps in the tree are
    /// computed once.
    fn run<M>(
        &mut self,
        model: &M,
        roots: &[M::State],
        branching: impl Branching<M>,
        remembers: bool,
        random: &mut impl Rng,
    ) -> Result<Decision, PomcpError>
    where
        M: GenerativeModel<Observation = O>,
    {
        let root = roots.first().ok_or(PomcpError::NoRoots)?;
        let kept = self.tree.history_count() - 1;
        let action_count = checked_action_count(model, self.settings.simulations.saturating_add(kept))?;
        let discount = checked_discount(model)?;
        let mut range = ValueRange::EMPTY;
        self.tree.values().for_each(|value| range.include(value));
        let mut simulations = Simulations {
            model,
            settings: &self.settings,
            action_count,
            discount,
            tree: &mut self.tree,
            branching,
            known: remembers.then(|| vec![(root.clone(), 0.0)]),
            table: &mut self.table,
            range,
            weights: Vec::with_capacity(action_count),
            path: &mut self.path,
            depth: 0,
            steps: 0,
        };
        let mut progress = Progress { ended: 0, policy: Vec::new() };
        let mut state = root.clone();
        for _ in 0..self.settings.simulations {
            state.clone_from(&roots[random.random_range(0..roots.len())]);
            simulations.run(&mut state, random)?;
            if progress.is_over(&self.settings, simulations.tree) {
                break;
            }
        }
        let depth = simulations.depth;
        let steps = simulations.steps;
        let effort = SearchStatistics { histories: self.tree.history_count(), depth, steps };
        let evidence = self.tree.evidence(HistoryId::ROOT);
        let actions = evidence.map(|(visits, value)| ActionStatistics { visits: visits as usize, value });
        Ok(Decision::new(actions.collect(), effort))
    }
}

/// Number of simulations at which a policy is first compared with that of half as many.
const FIRST_COMPARISON: usize = 128;

/// The progress of a search.
struct Progress {
    /// Simulations that have ended.
    ended: usize,
    /// The policy at the last comparison.
    policy: Vec<f64>,
}

impl Progress {
    /// Counts one more simulation, and says whether no more are needed.
    fn is_over<O: PartialEq>(&mut self, settings: &PomcpSettings, tree: &Tree<O>) -> bool {
        self.ended += 1;
        if settings.stop_when_decided && tree.is_decided(settings.simulations - self.ended) {
            return true;
        }
        let compares = self.ended.is_power_of_two() && self.ended >= FIRST_COMPARISON / 2;
        if settings.convergence > 0.0 && compares {
            let now = tree.policy();
            if self.ended >= FIRST_COMPARISON && total_variation(&self.policy, &now) < settings.convergence {
                return true;
            }
            self.policy = now;
        }
        false
    }
}

/// Half the sum of the absolute differences of two distributions, 0 to 1.
fn total_variation(a: &[f64], b: &[f64]) -> f64 {
    0.5 * a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum::<f64>()
}

fn checked_action_count(model: &impl GenerativeModel, simulations: usize) -> Result<usize, PomcpError> {
    let action_count = model.action_count();
    if action_count == 0 {
        return Err(PomcpError::NoActions);
    }
    // A simulation adds at most one history and expands at most one.
    let most_nodes = simulations.checked_add(1).and_then(|histories| histories.checked_mul(action_count));
    if most_nodes.is_none_or(|most| most >= u32::MAX as usize) {
        return Err(PomcpError::TooLarge { simulations, action_count });
    }
    Ok(action_count)
}

fn checked_discount(model: &impl GenerativeModel) -> Result<f64, PomcpError> {
    let discount = model.discount();
    if (0.0..=1.0).contains(&discount) { Ok(discount) } else { Err(PomcpError::InvalidDiscount { discount }) }
}

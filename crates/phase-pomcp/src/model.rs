//! The interface of a decision problem.

use rand::{Rng, RngExt};

/// A decision problem given by a generative model: samples of the next state, observation and reward.
///
/// Three functions are required: the number of actions, the discount, and the result of one step. The others
/// are hints that improve a search without changing what it converges to.
///
/// The observation distinguishes the branches of the search tree, so it decides what the plan can react to.
/// Keep it coarse: with a new branch for every simulation the tree never grows past its first level, and
/// branches are searched linearly. `()` makes an open-loop tree, whose nodes branch on actions alone; the
/// whole state makes a fully observed problem. For real numbers, implement [`ObservationModel`] too.
pub trait GenerativeModel {
    /// A state of the problem. It is copied once a simulation (with [`Clone::clone_from`]), so keep it small.
    type State: Clone;

    /// The agent's perception after a step.
    type Observation: PartialEq;

    /// The number of actions, numbered `0..action_count()`. It must not change during a search.
    fn action_count(&self) -> usize;

    /// The weight of the next step's reward relative to this one's, in `0..=1`.
    fn discount(&self) -> f64;

    /// Advances `state` by one step under `action` and returns the observation and the reward.
    fn step(
        &self,
        state: &mut Self::State,
        action: usize,
        random: &mut impl Rng,
    ) -> Transition<Self::Observation>;

    /// Advances `state` as [`step`](Self::step) does, for rollouts, which need no observation.
    ///
    /// Override it where observations cost more than the step; it must change the state and return the reward
    /// just as `step` does.
    fn rollout_step(&self, state: &mut Self::State, action: usize, random: &mut impl Rng) -> Transition<()> {
        let Transition { reward, terminal, .. } = self.step(state, action, random);
        Transition { observation: (), reward, terminal }
    }

    /// The action of the default policy, which is followed from a new leaf on; in `0..action_count()`,
    /// and legal.
    ///
    /// Uniform among the legal actions unless overridden. A sensible policy is the cheapest way to better
    /// plans.
    fn rollout_action(&self, state: &Self::State, random: &mut impl Rng) -> usize {
        let legal = || (0..self.action_count()).filter(|&action| self.is_legal(state, action));
        match legal().count() {
            0 => 0,
            count => legal().nth(random.random_range(0..count)).unwrap_or(0),
        }
    }

    /// Whether `action` may be taken in `state`. All may unless overridden; one at least must, unless the
    /// problem has ended.
    ///
    /// A search never takes an illegal action, and reports no visits of it. It asks once per history, for the
    /// first state that selects an action there: legality must follow from the actions and observations so
    /// far, the same for all states that share them. Start states must agree on it too.
    fn is_legal(&self, _state: &Self::State, _action: usize) -> bool {
        true
    }

    /// Prior weight of `action` before any search: finite, zero or more, relative to the other actions'
    /// weights. Their normalised value is the prior P(a) of PUCT.
    ///
    /// Equal for all actions unless overridden. It is queried once per history, for the first state that
    /// selects an action there; all weights of a history being zero is an error.
    fn prior_weight(&self, _state: &Self::State, _action: usize) -> f64 {
        1.0
    }

    /// The prior weights of all actions, in their order, appended to `weights`; override it where computing
    /// them together is cheaper than one by one.
    fn prior_weights(&self, state: &Self::State, weights: &mut Vec<f64>) {
        weights.extend((0..self.action_count()).map(|action| self.prior_weight(state, action)));
    }

    /// Whether the model is deterministic: the next state is a function of state and action, and nothing is
    /// drawn from the generator.
    ///
    /// The search then caches the steps of the tree, if it has a single root, and computes each once. Its
    /// decisions are the same with fewer steps.
    fn is_deterministic(&self) -> bool {
        false
    }

    /// Estimate of the return from `state` on, where a simulation stops before the problem has ended.
    ///
    /// Zero unless overridden. It must be finite, in the reward's unit, discounted to the time of `state`.
    fn value_estimate(&self, _state: &Self::State) -> f64 {
        0.0
    }
}

/// A problem that knows how likely its observations are.
///
/// [`Pomcp::search_widened`](crate::Pomcp::search_widened) and
/// [`ParticleBelief::update_weighted`](crate::ParticleBelief::update_weighted) need it where observations
/// seldom repeat, such as real numbers.
pub trait ObservationModel: GenerativeModel {
    /// The likelihood of `observation` where `action` led to the state `after`: a probability or a density,
    /// or either times a factor that is the same for all states. Finite, zero or more, and above zero for an
    /// observation that [`step`](GenerativeModel::step) made in that state.
    fn likelihood(&self, action: usize, after: &Self::State, observation: &Self::Observation) -> f64;
}

/// The result of one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transition<O> {
    /// The observation of the new state.
    pub observation: O,
    /// The reward of the step; must be finite.
    pub reward: f64,
    /// Whether the problem has ended, so that no further reward is possible.
    pub terminal: bool,
}

//! The interface of a decision problem.

use rand::{Rng, RngExt};

/// A decision problem given by a generative model: samples of the next state, observation and reward.
///
/// Three functions are enough: how many actions there are, how the future is discounted, and what one step
/// does. The rest is advice that makes a search better, never different in what it converges to.
///
/// The observation is what tells one branch of the search tree from another, so it decides what the plan can
/// react to. Keep it coarse: a branch for every simulation is a tree that never grows past its first level,
/// and branches are found by comparing one after another. `()` makes an open-loop tree, whose nodes branch on
/// actions alone; the whole state makes a fully observed problem.
pub trait GenerativeModel {
    /// A state of the problem. It is copied once a simulation (with [`Clone::clone_from`]), so keep it small.
    type State: Clone;

    /// What the agent perceives after a step.
    type Observation: Eq;

    /// The number of actions, named `0..action_count()`. It must not change during a search.
    fn action_count(&self) -> usize;

    /// The weight of the next step's reward relative to this one's, in `0..=1`.
    fn discount(&self) -> f64;

    /// Moves `state` one step on under `action` and says what was perceived and earned.
    fn step(
        &self,
        state: &mut Self::State,
        action: usize,
        random: &mut impl Rng,
    ) -> Transition<Self::Observation>;

    /// As [`step`](Self::step), for rollouts, which need no observation.
    ///
    /// Override it where observations cost more than the step; it must move the state and earn just as
    /// `step` does.
    fn rollout_step(&self, state: &mut Self::State, action: usize, random: &mut impl Rng) -> Transition<()> {
        let Transition { reward, terminal, .. } = self.step(state, action, random);
        Transition { observation: (), reward, terminal }
    }

    /// The action of the default policy, which is played from a newly grown leaf on; in `0..action_count()`.
    ///
    /// Uniform unless overridden. A policy that does something sensible is the cheapest way to a better plan.
    fn rollout_action(&self, _state: &Self::State, random: &mut impl Rng) -> usize {
        random.random_range(0..self.action_count())
    }

    /// How promising `action` looks before any search: a finite weight, zero or more, relative to the other
    /// actions' weights. Their normalised value is the prior P(a) of PUCT.
    ///
    /// Equal for all actions unless overridden. It is asked once a history, of the first state that chooses
    /// an action there; all weights of a history being zero is an error.
    fn prior_weight(&self, _state: &Self::State, _action: usize) -> f64 {
        1.0
    }

    /// Whether no step of this model involves chance: a state and an action decide what happens, and nothing is
    /// drawn from the generator.
    ///
    /// The search then takes every step of the tree once and remembers where it led, if it has a single root.
    /// It decides the same with fewer steps.
    fn is_deterministic(&self) -> bool {
        false
    }

    /// Estimate of the return from `state` on, where a simulation stops before the problem has ended.
    ///
    /// Zero unless overridden. It must be finite, in the reward's unit, discounted to `state`'s own time.
    fn value_estimate(&self, _state: &Self::State) -> f64 {
        0.0
    }
}

/// The result of one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transition<O> {
    /// What the agent perceives of the new state.
    pub observation: O,
    /// What the step earned; must be finite.
    pub reward: f64,
    /// Whether the problem has ended, so that nothing can be earned any more.
    pub terminal: bool,
}

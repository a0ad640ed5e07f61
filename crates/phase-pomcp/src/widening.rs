//! Branches for observations: one for each, or a number that grows with the visits.

use rand::{Rng, RngExt};

use crate::tree::{ActionId, HistoryId, Tree};
use crate::{GenerativeModel, ObservationModel, PomcpError};

/// Progressive widening: after an action with N visits, an observation begins a branch of its own only while
/// the action has no more than `factor` · N^`exponent` branches.
///
/// They are k_o and α_o in the algorithm POMCPOW of Sunberg & Kochenderfer (2018). The default is that of
/// their experiments with the problem "Light Dark", 5 and 1/15: 6 branches at first, and 10 after 10 000
/// visits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Widening {
    /// Number of branches on the first visits; finite, above zero.
    pub factor: f64,
    /// Growth of the number with the visits: 0 (none) to 1 (in proportion).
    pub exponent: f64,
}

impl Default for Widening {
    fn default() -> Self {
        Self { factor: 5.0, exponent: 1.0 / 15.0 }
    }
}

impl Widening {
    pub(crate) fn validate(self) -> Result<(), PomcpError> {
        let Self { factor, exponent } = self;
        let is_fine = factor.is_finite() && factor > 0.0 && (0.0..=1.0).contains(&exponent);
        if is_fine { Ok(()) } else { Err(PomcpError::InvalidWidening { factor, exponent }) }
    }

    fn admits(self, branches: usize, visits: u32) -> bool {
        branches as f64 <= self.factor * libm::pow(f64::from(visits), self.exponent)
    }
}

/// A step of the model that did not end the problem.
pub(crate) struct Made<O> {
    pub(crate) action: usize,
    pub(crate) node: ActionId,
    pub(crate) observation: O,
    pub(crate) reward: f64,
}

/// The history that follows a step.
pub(crate) struct Next {
    pub(crate) history: HistoryId,
    pub(crate) is_new: bool,
    /// The reward of the step that led to the state that the simulation goes on with.
    pub(crate) reward: f64,
}

/// The rule by which observations become branches.
pub(crate) trait Branching<M: GenerativeModel> {
    /// The history that follows a step, added to the tree if it is new. `state` is the state after the step;
    /// it may be exchanged for another one that is possible there.
    fn next(
        &mut self,
        model: &M,
        tree: &mut Tree<M::Observation>,
        made: Made<M::Observation>,
        state: &mut M::State,
        random: &mut impl Rng,
    ) -> Result<Next, PomcpError>;
}

/// Every observation that differs from others has a branch of its own.
pub(crate) struct Distinct;

impl<M: GenerativeModel> Branching<M> for Distinct {
    fn next(
        &mut self,
        _model: &M,
        tree: &mut Tree<M::Observation>,
        made: Made<M::Observation>,
        _state: &mut M::State,
        _random: &mut impl Rng,
    ) -> Result<Next, PomcpError> {
        let (history, is_new) = tree.child(made.node, made.observation);
        Ok(Next { history, is_new, reward: made.reward })
    }
}

/// POMCPOW: progressive widening, and in every history the states that were simulated there, weighted by
/// the likelihood of its observation.
pub(crate) struct Widened<S> {
    widening: Widening,
    /// By history.
    beliefs: Vec<Belief<S>>,
}

struct Belief<S> {
    /// Number of times that the observation was made while it could have begun a branch.
    made: u32,
    /// Each state with the reward of the step that led to it.
    particles: Vec<(S, f64)>,
    /// The sum of the weights up to each particle.
    sums: Vec<f64>,
}

impl<S> Belief<S> {
    const EMPTY: Self = Self { made: 0, particles: Vec::new(), sums: Vec::new() };
}

impl<S> Widened<S> {
    pub(crate) fn new(widening: Widening) -> Self {
        // The root has the particles of the search.
        Self { widening, beliefs: vec![Belief::EMPTY] }
    }

    /// One of an action's histories, by how often its observation was made.
    fn draw<O: PartialEq>(&self, tree: &Tree<O>, node: ActionId, random: &mut impl Rng) -> Option<HistoryId> {
        let made = |history: HistoryId| self.beliefs[history.index()].made;
        let all: u32 = tree.histories_after(node).map(made).sum();
        let mut left = if all > 0 { random.random_range(0..all) } else { 0 };
        tree.histories_after(node).find(|&history| match left.checked_sub(made(history)) {
            Some(rest) => {
                left = rest;
                false
            }
            None => true,
        })
    }
}

impl<M: ObservationModel> Branching<M> for Widened<M::State> {
    fn next(
        &mut self,
        model: &M,
        tree: &mut Tree<M::Observation>,
        made: Made<M::Observation>,
        state: &mut M::State,
        random: &mut impl Rng,
    ) -> Result<Next, PomcpError> {
        let Made { action, node, observation, reward } = made;
        let branches = tree.histories_after(node).count();
        let drawn = match self.widening.admits(branches, tree.action_visits(node)) {
            true => None,
            false => self.draw(tree, node, random),
        };
        let (history, is_new) = match drawn {
            Some(history) => (history, false),
            None => tree.child(node, observation),
        };
        if is_new {
            self.beliefs.push(Belief::EMPTY);
        }
        let belief = &mut self.beliefs[history.index()];
        belief.made += u32::from(drawn.is_none());
        let likelihood =
            tree.observation_of(node, history).map_or(0.0, |made| model.likelihood(action, state, made));
        let is_impossible = likelihood == 0.0 && drawn.is_none();
        if !likelihood.is_finite() || likelihood < 0.0 || is_impossible {
            return Err(PomcpError::InvalidLikelihood { action, likelihood });
        }
        let sum = belief.sums.last().copied().unwrap_or(0.0) + likelihood;
        if sum.is_infinite() {
            return Err(PomcpError::InvalidLikelihood { action, likelihood });
        }
        belief.particles.push((state.clone(), reward));
        belief.sums.push(sum);
        if is_new {
            return Ok(Next { history, is_new, reward });
        }
        let drawn = random.random::<f64>() * sum;
        let index = belief.sums.partition_point(|&below| below <= drawn).min(belief.sums.len() - 1);
        let (there, reward) = &belief.particles[index];
        state.clone_from(there);
        Ok(Next { history, is_new, reward: *reward })
    }
}

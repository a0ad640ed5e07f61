//! Errors of a search.

use thiserror::Error;

/// Why a search could not be set up or finished.
///
/// A failed search leaves its [`Pomcp`](crate::Pomcp) usable for the next one.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum PomcpError {
    /// The settings specify zero simulations.
    #[error("`simulations` is 0; a decision needs at least one")]
    ZeroSimulations,
    /// The settings do not allow even the first step.
    #[error("`horizon` is 0; a decision looks at least one step ahead")]
    ZeroHorizon,
    /// The PUCT constants are outside their ranges.
    #[error("`c_init` {c_init} must be finite and not negative, `c_base` {c_base} finite and positive")]
    InvalidExploration {
        /// The rejected exploration rate.
        c_init: f64,
        /// The rejected visit scale.
        c_base: f64,
    },
    /// The tolerance of convergence is not in the valid range.
    #[error("`convergence` is {convergence}; it must lie in 0..=1")]
    InvalidConvergence {
        /// The rejected tolerance.
        convergence: f64,
    },
    /// The parameters of progressive widening are outside their ranges.
    #[error("widening `factor` {factor} must be finite and positive, `exponent` {exponent} in 0..=1")]
    InvalidWidening {
        /// The rejected factor.
        factor: f64,
        /// The rejected exponent.
        exponent: f64,
    },
    /// A likelihood is negative, infinite or NaN, or zero for an observation that was made in that state.
    #[error(
        "`likelihood` said {likelihood} after action {action}; it must be finite and not negative, and \
         positive for what the state's own step observed"
    )]
    InvalidLikelihood {
        /// The action taken.
        action: usize,
        /// The likelihood that the model returned.
        likelihood: f64,
    },
    /// There is no root particle.
    #[error("the belief has no particles; give at least one root state")]
    NoRoots,
    /// The model has no actions.
    #[error("the model has no actions; `action_count` must be at least 1")]
    NoActions,
    /// No action is legal in a state in which the problem has not ended.
    #[error("`is_legal` allows no action in a state that was not terminal")]
    NoLegalAction,
    /// The default policy chose an action that is not legal.
    #[error("`rollout_action` chose {action}, which `is_legal` forbids")]
    IllegalRolloutAction {
        /// The action it chose.
        action: usize,
    },
    /// The tree could exceed its 32-bit indices.
    #[error("{simulations} simulations of {action_count} actions could need more than 2^32 nodes; use fewer")]
    TooLarge {
        /// Simulations per search.
        simulations: usize,
        /// The model's number of actions.
        action_count: usize,
    },
    /// The model's discount is not in the valid range.
    #[error("`discount` is {discount}; it must lie in 0..=1")]
    InvalidDiscount {
        /// The rejected discount.
        discount: f64,
    },
    /// The reward of a step is infinite or NaN.
    #[error("action {action} earned {reward}; every reward must be finite")]
    NonFiniteReward {
        /// The action taken.
        action: usize,
        /// The reward that the model returned.
        reward: f64,
    },
    /// The value estimate of a simulation's last state is infinite or NaN.
    #[error("`value_estimate` said {estimate}; it must be finite")]
    NonFiniteEstimate {
        /// The value that the model returned.
        estimate: f64,
    },
    /// The rewards are finite, but their sum is too large to be averaged.
    #[error("a simulation's return is {value}, too large to average; scale the rewards down")]
    ReturnOverflow {
        /// The return.
        value: f64,
    },
    /// A prior weight is negative, infinite or NaN, or the weights of a history's legal actions are all zero
    /// or their sum overflows.
    #[error("prior weight {weight} (or sum {sum}) must be finite and not negative, the sum positive")]
    InvalidPrior {
        /// The last weight queried.
        weight: f64,
        /// The sum of the history's weights up to it.
        sum: f64,
    },
    /// The model did not give one prior weight for each action.
    #[error("`prior_weights` gave {weights} weights for {action_count} actions")]
    PriorCount {
        /// The number of weights that the model returned.
        weights: usize,
        /// The model's number of actions.
        action_count: usize,
    },
    /// The default policy returned an invalid action.
    #[error("`rollout_action` chose {action}, but there are only {action_count} actions")]
    RolloutActionOutOfRange {
        /// The action it chose.
        action: usize,
        /// The model's number of actions.
        action_count: usize,
    },
}

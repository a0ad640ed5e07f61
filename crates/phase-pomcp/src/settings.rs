//! Parameters of a search.

use crate::PomcpError;

/// Numbers of simulations and parameters of a search.
///
/// The defaults are those of the PHASE paper's appendix: 1000 simulations, 10 rollout steps, c_init 1.25 and
/// c_base 1000.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PomcpSettings {
    /// Simulations per search, one or more; each adds at most one history to the tree. Fewer are run where
    /// `stop_when_decided` allows it.
    pub simulations: usize,
    /// Steps of the default policy from a new leaf. With zero, a leaf is evaluated by
    /// [`value_estimate`](crate::GenerativeModel::value_estimate) alone.
    pub rollout_steps: usize,
    /// The exploration rate of PUCT at few visits; finite, zero or more.
    pub c_init: f64,
    /// The number of visits on the scale of which the exploration rate starts to grow; finite, above zero.
    pub c_base: f64,
    /// The maximum number of steps from the root in a simulation, tree and rollout together; one or more.
    /// With it the search solves the problem with exactly that horizon. [`usize::MAX`], the default, is no
    /// bound: every simulation goes to its leaf and `rollout_steps` beyond.
    pub horizon: usize,
    /// Whether selection first maps values to 0..1 by the minimum and maximum value in the tree, as MuZero
    /// does (Schrittwieser et al. 2020, appendix B).
    ///
    /// PUCT adds an exploration term of order one to the value, which is intended for values in 0..1. If a
    /// step earns 0.01, say, an unscaled value would be negligible compared with that term and the search
    /// would be spread uniformly over all actions; if it earns 100, the term would be negligible. Reported
    /// values are never mapped.
    ///
    /// The trade-off: a rare disaster anywhere in the tree sets the scale for all other values. Where the
    /// range of returns is far wider than the differences that matter, use a smaller `c_init` or more
    /// simulations.
    pub normalise_values: bool,
    /// Whether a search ends as soon as the remaining simulations could not make any other action the most
    /// visited, even if all of them began with it. The chosen action is the one that all simulations would
    /// have chosen; visits and values are those of the simulations that were run.
    pub stop_when_decided: bool,
    /// A search ends as converged where the policy, the shares of the visits at the root, changed by less
    /// than this while the number of simulations doubled: total variation, 0 to 1, compared after 128, 256,
    /// 512, … simulations. With 0, the default, every search goes on. Unlike `stop_when_decided` it can
    /// change a decision, by about as much as another seed would.
    pub convergence: f64,
    /// Whether every action of a history is tried once before any is tried twice (the default). Otherwise an
    /// untried action is scored like the others, with the mean value of the history in place of its own, so
    /// that its prior decides when it is tried (Silver et al. 2018).
    pub untried_first: bool,
}

impl Default for PomcpSettings {
    fn default() -> Self {
        Self {
            simulations: 1000,
            rollout_steps: 10,
            c_init: 1.25,
            c_base: 1000.0,
            horizon: usize::MAX,
            normalise_values: true,
            stop_when_decided: false,
            convergence: 0.0,
            untried_first: true,
        }
    }
}

impl PomcpSettings {
    /// Checks every parameter against its stated range.
    ///
    /// # Errors
    /// [`PomcpError::ZeroSimulations`], [`PomcpError::ZeroHorizon`], [`PomcpError::InvalidExploration`] or
    /// [`PomcpError::InvalidConvergence`].
    pub fn validate(&self) -> Result<(), PomcpError> {
        if self.simulations == 0 {
            return Err(PomcpError::ZeroSimulations);
        }
        if self.horizon == 0 {
            return Err(PomcpError::ZeroHorizon);
        }
        let init_is_fine = self.c_init.is_finite() && self.c_init >= 0.0;
        let base_is_fine = self.c_base.is_finite() && self.c_base > 0.0;
        if !(init_is_fine && base_is_fine) {
            return Err(PomcpError::InvalidExploration { c_init: self.c_init, c_base: self.c_base });
        }
        if !(0.0..=1.0).contains(&self.convergence) {
            return Err(PomcpError::InvalidConvergence { convergence: self.convergence });
        }
        Ok(())
    }
}

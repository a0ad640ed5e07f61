//! The choices of a mind at each observed state, compared with what the agent did there.
//!
//! A mind's policy is the share of visits of each action in its search. What the agent did is known only as a
//! likelihood of each action ([`action_likelihoods`]). [`chances`] brings the two together for one agent
//! under one hypothesis, and [`log_likelihood`] and [`fitted_lapse`] summarise many steps.
//!
//! ```
//! use phase_simple::choice::{CHOICES, Chance};
//!
//! // The mind chooses the first action with 0.6, the second with 0.4; the motion is twice as likely under
//! // the second.
//! let mut policy = [0.0; CHOICES];
//! let mut likelihoods = [0.0; CHOICES];
//! (policy[0], policy[1]) = (0.6, 0.4);
//! (likelihoods[0], likelihoods[1]) = (0.5, 1.0);
//! let chance = Chance::of(&policy, &likelihoods);
//! assert!((chance.mind - 0.7).abs() < 1e-12); // 0.6 · 0.5 + 0.4 · 1
//! assert!((chance.uniform - 1.5 / 13.0).abs() < 1e-12);
//! ```

use crate::{
    Hypothesis, InverseDynamics,
    generative::{AgentDecision, PreparedEvent},
};
use phase_event::Thought;
use phase_model::{AGENT_COUNT, Action, AgentId};
use phase_pomcp::PomcpError;
use phase_statistics::softmax;

/// Number of choices. The direction of a turn carries little information, and none in recordings of the
/// published simulator, in which all turns are left turns; the two turns are therefore one choice.
pub const CHOICES: usize = Action::ALL.len() - 1;

/// A number for each choice, by [`index`].
pub type ByChoice = [f64; CHOICES];

/// Bisections of the interval of lapse rates: enough for an error below 10⁻¹².
const BISECTIONS: usize = 40;

/// Index of an action among the choices.
#[must_use]
pub const fn index(action: Action) -> usize {
    match action {
        Action::TurnLeft | Action::TurnRight => 0,
        other => other.index() - 1,
    }
}

/// The policy of a decision: the share of visits of each choice. Where nothing was searched, the action taken
/// has probability 1.
#[must_use]
pub fn policy(decided: &AgentDecision) -> ByChoice {
    policy_of(decided.action, &decided.thought)
}

/// The policy behind an action, from its explanation.
pub(crate) fn policy_of(action: Action, thought: &Thought) -> ByChoice {
    let mut policy = [0.0; CHOICES];
    let visits: f64 = thought.actions.iter().map(|value| f64::from(value.visits)).sum();
    if visits > 0.0 {
        for value in &thought.actions {
            policy[index(value.action)] += f64::from(value.visits) / visits;
        }
    } else {
        policy[index(action)] = 1.0;
    }
    policy
}

/// Normalised likelihood of each choice for each step and agent, proportional to e^{−residual/σ}, where the
/// residual is the best that inverse dynamics achieves with that choice and σ (u) is `tolerance`, for noisy
/// rows together with [`InverseDynamics::error_up_to`] the step.
#[must_use]
pub fn action_likelihoods(prepared: &PreparedEvent, tolerance: f64) -> Vec<[ByChoice; AGENT_COUNT]> {
    let motion = prepared.motion();
    (0..motion.actions.len()).map(|step| likelihoods_in(motion, step, tolerance)).collect()
}

/// The normalised likelihood of each choice of each agent in one step; see [`action_likelihoods`].
pub(crate) fn likelihoods_in(
    motion: &InverseDynamics,
    step: usize,
    tolerance: f64,
) -> [ByChoice; AGENT_COUNT] {
    motion.alternatives_in(step).map(|residuals| {
        let mut argmin = [f64::INFINITY; CHOICES];
        for action in Action::ALL {
            let place = index(action);
            argmin[place] = argmin[place].min(f64::from(residuals[action.index()]));
        }
        let best = argmin.iter().copied().fold(f64::INFINITY, f64::min);
        let tolerance = libm::hypot(tolerance, f64::from(motion.error_up_to(step)));
        // Differences from the best are taken before they are scaled, where they are exact.
        softmax(argmin.map(|residual| (best - residual) / tolerance))
    })
}

/// The probability that what was done in one step is chosen, relative to the best that the uncertainty about
/// it allows: 1 for a policy that always takes the likeliest action.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Chance {
    /// Σ P(a) L(a) / max L of the mind's policy, 0 to 1.
    pub mind: f64,
    /// Σ P(a) L(a) / max L of the uniform policy, 0 to 1.
    pub uniform: f64,
}

impl Chance {
    /// The chance of a policy, given the likelihood of each choice.
    #[must_use]
    pub fn of(policy: &ByChoice, likelihoods: &ByChoice) -> Self {
        let best = likelihoods.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let mind: f64 = policy.iter().zip(likelihoods).map(|(policy, likelihood)| policy * likelihood).sum();
        let uniform = likelihoods.iter().sum::<f64>() / CHOICES as f64;
        Self { mind: mind / best, uniform: uniform / best }
    }

    /// The chance if the mind lapses with this probability (0 to 1) into a uniformly random choice.
    #[must_use]
    pub fn with_lapse(self, lapse: f64) -> f64 {
        (1.0 - lapse) * self.mind + lapse * self.uniform
    }

    /// The logarithm of that (nat).
    #[must_use]
    pub fn log(self, lapse: f64) -> f64 {
        libm::log(self.with_lapse(lapse).max(f64::MIN_POSITIVE))
    }
}

/// The chance of what an agent did in each step. The mind of a hypothesis decides at every observed state
/// with estimated beliefs, while the other agent replays its inferred actions. `likelihoods` are those of
/// [`action_likelihoods`] of the same event.
///
/// # Errors
/// Invalid parameters of the agents' search.
pub fn chances(
    prepared: &PreparedEvent,
    likelihoods: &[[ByChoice; AGENT_COUNT]],
    hypothesis: &Hypothesis,
    agent: AgentId,
) -> Result<Vec<Chance>, PomcpError> {
    let decisions = prepared.simulate_agent(hypothesis, agent, 1)?;
    let steps = decisions.iter().zip(likelihoods);
    Ok(steps.map(|(decided, likelihoods)| Chance::of(&policy(decided), &likelihoods[agent])).collect())
}

/// Mean log likelihood of a step (nat) at a lapse rate; `None` without steps.
#[must_use]
pub fn log_likelihood(chances: &[Chance], lapse: f64) -> Option<f64> {
    let sum: f64 = chances.iter().map(|chance| chance.log(lapse)).sum();
    (!chances.is_empty()).then(|| sum / chances.len() as f64)
}

/// The lapse rate, 0 to 1, at which the log likelihood of these steps is greatest. It is concave in the lapse
/// rate, so that bisection on the sign of its derivative finds the maximum.
#[must_use]
pub fn fitted_lapse(chances: &[Chance]) -> f64 {
    let mut low = 0.0;
    let mut high = 1.0;
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        let slope = |chance: &Chance| (chance.uniform - chance.mind) / chance.with_lapse(middle);
        if chances.iter().map(slope).sum::<f64>() > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

//! Helpers and hinderers that do not know the other's goal, as explanations of an agent's motion.

use crate::{
    Budget, InversePlanningSettings, PreparedEvent,
    evidence::{ActionLikelihoods, IntentEvidence, Stride},
};
use phase_model::{AgentId, Attitude, Level};
use phase_pomcp::PomcpError;
use phase_statistics::log_sum_exp;

/// Prior probability that a helper or hinderer does not know the other's goal.
const PRIOR: f64 = 0.5;

/// The levels at which an agent of an attitude can reason, with their prior probabilities. Only hinderers of
/// level 2, who feint, differ from those of level 1, and only if they search.
const fn levels(attitude: Attitude) -> &'static [(Level, f64)] {
    const THIRD: f64 = 1.0 / 3.0;
    match attitude {
        Attitude::Neutral => &[],
        Attitude::Help => &[(Level::Zero, THIRD), (Level::One, 2.0 * THIRD)],
        Attitude::Hinder => &[(Level::Zero, THIRD), (Level::One, THIRD), (Level::Two, THIRD)],
    }
}

/// The evidence on the helpers and hinderers that an agent can be without knowing the other's goal.
#[derive(Debug)]
pub(crate) struct UninformedEvidence {
    of: Vec<(Attitude, Level, f64, IntentEvidence)>,
    /// Whether all of it has caught up with the event; otherwise it does not count.
    complete: bool,
}

/// The explanation of an agent's motion by an intent.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Explained {
    /// ln P(motion | intent), averaged over what the agent knows (nat).
    pub(crate) log: f64,
    /// Probability of each level if the agent has this intent, and does not know the other's goal.
    pub(crate) levels: [f64; Level::ALL.len()],
}

impl UninformedEvidence {
    pub(crate) fn new(prepared: &PreparedEvent, agent: AgentId) -> Result<Self, PomcpError> {
        let mut of = Vec::new();
        for attitude in [Attitude::Help, Attitude::Hinder] {
            for &(level, prior) in levels(attitude) {
                of.push((
                    attitude,
                    level,
                    prior,
                    IntentEvidence::uninformed(prepared, agent, attitude, level)?,
                ));
            }
        }
        Ok(Self { of, complete: false })
    }

    pub(crate) fn forget(&mut self, likelihoods: &ActionLikelihoods, rows: usize) {
        self.of.iter_mut().for_each(|(.., evidence)| evidence.forget(likelihoods, rows));
    }

    /// Looks at all decisions, as far as the budget suffices.
    pub(crate) fn follow(
        &mut self,
        prepared: &PreparedEvent,
        likelihoods: &ActionLikelihoods,
        budget: &mut Budget,
    ) -> Result<(), PomcpError> {
        self.complete = true;
        for (.., evidence) in &mut self.of {
            self.complete &= evidence.follow(prepared, likelihoods, budget)?;
        }
        Ok(())
    }

    /// Averages over what an agent of an attitude knows. `knowing` is ln P(motion | intent) of one that knows
    /// the other's goal (nat).
    pub(crate) fn explain(
        &self,
        attitude: Attitude,
        knowing: f64,
        decisions: usize,
        settings: &InversePlanningSettings,
    ) -> Explained {
        let mut levels = [0.0; Level::ALL.len()];
        if attitude == Attitude::Neutral || !self.complete {
            return Explained { log: knowing, levels };
        }
        let of_attitude = self.of.iter().filter(|(of, ..)| *of == attitude);
        let logs: Vec<(Level, f64)> = of_attitude
            .map(|(_, level, prior, evidence)| {
                let log = evidence.log_likelihood(decisions, Stride::EVERY, settings);
                (*level, log + libm::log(PRIOR * prior))
            })
            .collect();
        let knows = knowing + libm::log(1.0 - PRIOR);
        let log = log_sum_exp(logs.iter().map(|(_, log)| *log).chain([knows]));
        for (level, of_level) in logs {
            levels[usize::from(u8::from(level))] = libm::exp(of_level - log);
        }
        Explained { log, levels }
    }
}

//! Scores of roles: naming the agent that helps or hinders the other.

use super::{RecognisedEvent, SocialRole};
use crate::Estimate;
use phase_model::RoleProbabilities;
use serde::{Deserialize, Serialize};

/// Probabilities that differ by less are equal but for rounding errors.
const ROUNDING: f64 = 1e-9;

/// Scores of a method at naming the agent that helps or hinders, given the relation: its probability that the
/// right agent has the right attitude, beside that of the other agent having it.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct RoleScores {
    /// Number of events in which one agent helps or hinders the other.
    pub n: usize,
    /// The right agent is the likelier one; equally likely ones do not count.
    pub named: Estimate,
    /// Brier score of the two: (1 − p)², where p is the probability of the right agent over that of both;
    /// 0.25 for a method that does not know.
    pub brier: Estimate,
}

impl RoleScores {
    /// Scores the events in which one agent helps or hinders the other; `None` if there is none, or a method
    /// does not say. The seed is that of the intervals.
    #[must_use]
    pub fn of<'a>(events: impl IntoIterator<Item = &'a RecognisedEvent>, seed: u64) -> Option<Self> {
        let social = events.into_iter().filter_map(|event| Some((event.label.role?, event.answer.roles)));
        let shares: Vec<f64> =
            social.map(|(role, said)| Some(share(role, &said?))).collect::<Option<Vec<f64>>>()?;
        let over = |value: fn(f64) -> f64| {
            Estimate::of(&shares.iter().map(|share| value(*share)).collect::<Vec<f64>>(), seed)
        };
        Some(Self {
            n: shares.len(),
            named: over(|share| f64::from(u8::from(share > 0.5 + ROUNDING)))?,
            brier: over(|share| (1.0 - share) * (1.0 - share))?,
        })
    }
}

/// The probability that the right agent has the attitude, if one of the two has it; a half if neither may.
fn share(SocialRole { agent, attitude }: SocialRole, said: &RoleProbabilities) -> f64 {
    let [right, wrong] = [agent, agent.other()].map(|agent| said.of(agent, attitude));
    if right + wrong > 0.0 { right / (right + wrong) } else { 0.5 }
}

//! Error breakdown of the recognised goals.

use super::{RecognisedEvent, canonical};
use phase_model::Goal;
use serde::{Deserialize, Serialize};

/// Kinds of goals, in the order of [`ErrorBreakdown::kinds`].
pub const GOAL_KINDS: [&str; 3] = ["agent on landmark", "object on landmark", "touch"];

/// Error breakdown of the most likely goals, counted by agents. Goals that are neither correct nor of another
/// kind nor missing are counted in one of `sign`, `landmark`, `entity` and `both`.
#[derive(Clone, PartialEq, Eq, Default, Debug, Serialize, Deserialize)]
pub struct ErrorBreakdown {
    /// Everything is correct.
    pub right: usize,
    /// The kind, the entity and the landmark are correct, and the sign is wrong.
    pub sign: usize,
    /// The kind and the entity are correct, and the landmark is wrong, whatever the sign.
    pub landmark: usize,
    /// The kind and the landmark are correct, and the entity is wrong, whatever the sign.
    pub entity: usize,
    /// The kind is correct, and both the entity and the landmark are wrong, whatever the sign.
    pub both: usize,
    /// Confusion matrix of kinds: `kinds[right][said]`, both in the order of [`GOAL_KINDS`]. The correct kind
    /// is counted too.
    pub kinds: [[usize; GOAL_KINDS.len()]; GOAL_KINDS.len()],
    /// No goal was named.
    pub nothing: usize,
}

impl ErrorBreakdown {
    /// Counts those of all agents.
    #[must_use]
    pub fn of(events: &[RecognisedEvent]) -> Self {
        let mut mistakes = Self::default();
        for event in events {
            for (ranked, &right) in event.answer.goals.iter().zip(&event.label.goals) {
                mistakes.count(ranked.first().map(|share| share.goal), right);
            }
        }
        mistakes
    }

    fn count(&mut self, said: Option<Goal>, right: Goal) {
        let Some(said) = said else {
            self.nothing += 1;
            return;
        };
        let said = canonical(said);
        let right = canonical(right);
        let [said_kind, said_entity, said_landmark] = parts(said);
        let [kind, entity, landmark] = parts(right);
        self.kinds[kind][said_kind] += 1;
        if said_kind != kind {
            return;
        }
        *match (said_entity == entity, said_landmark == landmark, said == right) {
            (true, true, true) => &mut self.right,
            (true, true, false) => &mut self.sign,
            (true, false, _) => &mut self.landmark,
            (false, true, _) => &mut self.entity,
            (false, false, _) => &mut self.both,
        } += 1;
    }
}

/// The kind as an index into [`GOAL_KINDS`], the entity, and the landmark; for touching it is always the
/// same.
fn parts(goal: Goal) -> [usize; 3] {
    match goal {
        Goal::AgentOnLandmark { agent, landmark, .. } => [0, agent.into(), landmark.into()],
        Goal::ObjectOnLandmark { object, landmark, .. } => [1, object.into(), landmark.into()],
        Goal::Touch { .. } => [2, 0, 0],
    }
}

//! Error breakdown of the recognised goals.

use super::{RecognisedEvent, canonical};
use phase_model::Goal;
use serde::Serialize;

/// Kinds of goals, in the order of [`ErrorBreakdown::kinds`].
pub const GOAL_KINDS: [&str; 3] = ["agent on landmark", "object on landmark", "touch"];

/// What is right and what is wrong about the goals that were thought likeliest, counted by agents. Whatever is neither
/// right nor of another kind nor unnamed is in one of `sign`, `landmark`, `entity` and `both`.
#[derive(Clone, PartialEq, Eq, Default, Debug, Serialize)]
pub struct ErrorBreakdown {
    /// All of it right.
    pub right: usize,
    /// The kind, who or what, and the landmark are right, and the sign is wrong.
    pub sign: usize,
    /// The kind and who or what are right, and the landmark is wrong, whatever the sign.
    pub landmark: usize,
    /// The kind and the landmark are right, and it is another agent or object, whatever the sign.
    pub entity: usize,
    /// The kind is right, and it is another agent or object and another landmark, whatever the sign.
    pub both: usize,
    /// Which kind was taken for which: `kinds[right][said]`, both in the order of [`GOAL_KINDS`]. The right kind is
    /// counted too.
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
        let (said, right) = (canonical(said), canonical(right));
        let ([said_kind, said_entity, said_landmark], [kind, entity, landmark]) = (parts(said), parts(right));
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

/// The kind as a place in [`GOAL_KINDS`], who or what is to be there, and the landmark; of touching it is always the same.
fn parts(goal: Goal) -> [usize; 3] {
    match goal {
        Goal::AgentOnLandmark { agent, landmark, .. } => [0, agent.into(), landmark.into()],
        Goal::ObjectOnLandmark { object, landmark, .. } => [1, object.into(), landmark.into()],
        Goal::Touch { .. } => [2, 0, 0],
    }
}

//! Intents: what one agent can want, as another agent or an observer may suppose.

use crate::{AgentId, Attitude, Goal, LandmarkId, Literal, ObjectId, Sign};
use core::fmt;
use serde::{Deserialize, Serialize};

/// One agent's intent: its own goal, or helping or hindering the other with one of the other's goals.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub struct Intent {
    /// α towards the other.
    pub attitude: Attitude,
    /// The agent's own goal if it is neutral, otherwise the other's.
    pub goal: Goal,
}

impl Intent {
    /// All possible intents of an agent in an event with the given number of objects: 42 with two of them,
    /// its own goals first.
    #[must_use]
    pub fn all(agent: AgentId, objects: usize) -> Vec<Self> {
        let own = physical_goals(agent, objects).into_iter();
        let neutral = own.map(|goal| Self { attitude: Attitude::Neutral, goal });
        let social = [Attitude::Help, Attitude::Hinder].into_iter().flat_map(|attitude| {
            physical_goals(agent.other(), objects).into_iter().map(move |goal| Self { attitude, goal })
        });
        neutral.chain(social).collect()
    }
}

/// `On(object 0, landmark 1)` for an own goal, and `to help` or `to hinder`.
impl fmt::Display for Intent {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.attitude {
            Attitude::Neutral => Literal::from(self.goal).fmt(formatter),
            Attitude::Help => formatter.write_str("to help"),
            Attitude::Hinder => formatter.write_str("to hinder"),
        }
    }
}

/// The physical goals that an agent can have in an event with the given number of objects: being on each
/// landmark, each object on each landmark, approaching the other and getting away from it. Fourteen with two
/// objects.
#[must_use]
pub fn physical_goals(agent: AgentId, objects: usize) -> Vec<Goal> {
    let me = agent;
    let other = agent.other();
    let landmarks = LandmarkId::ALL.into_iter();
    let mut goals: Vec<Goal> = landmarks
        .clone()
        .map(|landmark| Goal::AgentOnLandmark { agent: me, landmark, sign: Sign::Positive })
        .collect();
    goals.extend(ObjectId::ALL.into_iter().take(objects).flat_map(|object| {
        landmarks.clone().map(move |landmark| Goal::ObjectOnLandmark {
            object,
            landmark,
            sign: Sign::Positive,
        })
    }));
    goals.push(Goal::Touch { agent: me, other, sign: Sign::Positive });
    // In a chase both goals name the chaser first.
    goals.push(Goal::Touch { agent: other, other: me, sign: Sign::Negative });
    goals
}

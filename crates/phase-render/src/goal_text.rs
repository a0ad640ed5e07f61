//! Goals in words, with colours in place of numbers.

use crate::Palette;
use phase_model::{AgentId, Goal, Sign};

impl Palette {
    /// What an agent with a goal wants, such as "the pink object on the blue landmark".
    #[must_use]
    pub fn goal_text(&self, goal: Goal, whose: AgentId) -> String {
        match goal {
            Goal::AgentOnLandmark { agent, landmark, sign } => {
                let who = if agent == whose {
                    "to be".to_owned()
                } else {
                    format!("the {} agent", self.agent_names[agent])
                };
                format!("{who} {} the {} landmark", place(sign), self.landmark_names[usize::from(landmark)])
            }
            Goal::ObjectOnLandmark { object, landmark, sign } => {
                let (object, landmark) =
                    (self.object_names[object], self.landmark_names[usize::from(landmark)]);
                format!("the {object} object {} the {landmark} landmark", place(sign))
            }
            Goal::Touch { sign: Sign::Positive, .. } => "to touch the other".to_owned(),
            Goal::Touch { sign: Sign::Negative, .. } => "to get away from the other".to_owned(),
        }
    }

    /// [`goal_text`](Self::goal_text) short enough for a line below a picture, such as "pink object on blue".
    #[must_use]
    pub fn goal_label(&self, goal: Goal, whose: AgentId) -> String {
        let text = self.goal_text(goal, whose);
        match goal {
            Goal::AgentOnLandmark { .. } | Goal::ObjectOnLandmark { .. } => {
                text.replace("the ", "").trim_end_matches(" landmark").to_owned()
            }
            Goal::Touch { .. } => text,
        }
    }
}

const fn place(sign: Sign) -> &'static str {
    match sign {
        Sign::Positive => "on",
        Sign::Negative => "away from",
    }
}

#[cfg(test)]
mod tests {
    use crate::Palette;
    use phase_model::{AgentId, Goal, LandmarkId, ObjectId, Sign};

    #[test]
    fn goals_are_told_in_colours() {
        let landmark = LandmarkId::TOP_LEFT;
        let text = |goal| Palette::PAPER.goal_text(goal, AgentId::ZERO);
        let own = Goal::AgentOnLandmark { agent: AgentId::ZERO, landmark, sign: Sign::Positive };
        let others = Goal::AgentOnLandmark { agent: AgentId::ONE, landmark, sign: Sign::Negative };
        let object = Goal::ObjectOnLandmark { object: ObjectId::ALL[1], landmark, sign: Sign::Positive };
        let name = Palette::PAPER.landmark_names[usize::from(landmark)];
        assert_eq!(text(own), format!("to be on the {name} landmark"));
        assert_eq!(text(others), format!("the green agent away from the {name} landmark"));
        assert_eq!(text(object), format!("the pink object on the {name} landmark"));
        assert_eq!(Palette::PAPER.goal_label(object, AgentId::ZERO), format!("pink object on {name}"));
        assert_eq!(Palette::PAPER.goal_label(own, AgentId::ZERO), format!("to be on {name}"));
    }
}

//! Goals in words, with colours in place of numbers.

use phase_model::{AgentId, Goal, Sign};
use phase_render::Palette;

/// What an agent with a goal wants, such as "the pink object on the blue landmark".
pub(super) fn goal_text(goal: Goal, whose: AgentId, palette: &Palette) -> String {
    match goal {
        Goal::AgentOnLandmark { agent, landmark, sign } => {
            let who = if agent == whose {
                "to be".to_owned()
            } else {
                format!("the {} agent", palette.agent_names[agent])
            };
            format!("{who} {} the {} landmark", place(sign), palette.landmark_names[usize::from(landmark)])
        }
        Goal::ObjectOnLandmark { object, landmark, sign } => {
            let (object, landmark) =
                (palette.object_names[object], palette.landmark_names[usize::from(landmark)]);
            format!("the {object} object {} the {landmark} landmark", place(sign))
        }
        Goal::Touch { sign: Sign::Positive, .. } => "to touch the other".to_owned(),
        Goal::Touch { sign: Sign::Negative, .. } => "to get away from the other".to_owned(),
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
    use super::goal_text;
    use phase_model::{AgentId, Goal, LandmarkId, ObjectId, Sign};
    use phase_render::Palette;

    #[test]
    fn goals_are_told_in_colours() {
        let landmark = LandmarkId::TOP_LEFT;
        let text = |goal| goal_text(goal, AgentId::ZERO, &Palette::PAPER);
        let own = Goal::AgentOnLandmark { agent: AgentId::ZERO, landmark, sign: Sign::Positive };
        let others = Goal::AgentOnLandmark { agent: AgentId::ONE, landmark, sign: Sign::Negative };
        let object = Goal::ObjectOnLandmark { object: ObjectId::ALL[1], landmark, sign: Sign::Positive };
        let name = Palette::PAPER.landmark_names[usize::from(landmark)];
        assert_eq!(text(own), format!("to be on the {name} landmark"));
        assert_eq!(text(others), format!("the green agent away from the {name} landmark"));
        assert_eq!(text(object), format!("the pink object on the {name} landmark"));
    }
}

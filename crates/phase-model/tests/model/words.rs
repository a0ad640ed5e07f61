//! Scenes in words.

use phase_model::{
    AgentId, Goal, LandmarkId, ObjectId, Sign,
    words::{Names, wants_to},
};

#[test]
fn goals_read_as_sentences() {
    let positive = Sign::Positive;
    let negative = Sign::Negative;
    let on = |agent, sign| Goal::AgentOnLandmark { agent, landmark: LandmarkId::BOTTOM_LEFT, sign };
    let put = |sign| Goal::ObjectOnLandmark { object: ObjectId::ONE, landmark: LandmarkId::TOP_LEFT, sign };
    let touch = |sign| Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign };
    let cases = [
        (0, on(AgentId::ZERO, positive), "go to the yellow landmark (bottom left)"),
        (0, on(AgentId::ONE, positive), "get the green agent to the yellow landmark (bottom left)"),
        (0, on(AgentId::ONE, negative), "keep the green agent off the yellow landmark (bottom left)"),
        (1, put(positive), "put the pink object on the blue landmark (top left)"),
        (0, put(negative), "keep the pink object off the blue landmark (top left)"),
        (0, touch(positive), "catch the green agent"),
        (1, touch(negative), "get away from the red agent"),
        (0, touch(negative), "get away from the green agent"),
        (1, touch(positive), "let the red agent reach the green agent"),
    ];
    for (agent, it, expected) in cases {
        assert_eq!(Names::PAPER.plain(&wants_to(it, AgentId::ALL[agent])), expected);
    }
}

#[test]
fn goals_read_as_what_is_wanted() {
    let landmark = LandmarkId::TOP_LEFT;
    let positive = Sign::Positive;
    let negative = Sign::Negative;
    let on = |agent, sign| Goal::AgentOnLandmark { agent, landmark, sign };
    let object = Goal::ObjectOnLandmark { object: ObjectId::ONE, landmark, sign: positive };
    let touch = |sign| Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign };
    let cases = [
        (on(AgentId::ZERO, positive), "to be on the blue landmark", "to be on blue"),
        (
            on(AgentId::ONE, negative),
            "the green agent away from the blue landmark",
            "green agent away from blue",
        ),
        (object, "the pink object on the blue landmark", "pink object on blue"),
        (touch(positive), "to touch the other agent", "to touch the other"),
        (touch(negative), "to get away from the other agent", "to get away from the other"),
    ];
    for (goal, wanted, briefly) in cases {
        assert_eq!(Names::PAPER.wants(goal, AgentId::ZERO), wanted);
        assert_eq!(Names::PAPER.wants_briefly(goal, AgentId::ZERO), briefly);
    }
}

//! Scenes in words.

use phase_dataset::words::{goal, plain};
use phase_model::{Goal, Sign};

#[test]
fn goals_read_as_sentences() {
    let (positive, negative) = (Sign::Positive, Sign::Negative);
    let on = |agent, sign| Goal::AgentOnLandmark { agent, landmark: 3, sign };
    let put = |sign| Goal::ObjectOnLandmark { object: 1, landmark: 0, sign };
    let touch = |sign| Goal::Touch { agent: 0, other: 1, sign };
    let cases = [
        (0, on(0, positive), "go to the yellow landmark (bottom left)"),
        (0, on(1, positive), "get the green agent to the yellow landmark (bottom left)"),
        (0, on(1, negative), "keep the green agent off the yellow landmark (bottom left)"),
        (1, put(positive), "put the pink object on the blue landmark (top left)"),
        (0, put(negative), "keep the pink object off the blue landmark (top left)"),
        (0, touch(positive), "catch the green agent"),
        (1, touch(negative), "get away from the red agent"),
        (0, touch(negative), "get away from the green agent"),
        (1, touch(positive), "let the red agent reach the green agent"),
    ];
    for (agent, it, expected) in cases {
        assert_eq!(plain(&goal(agent, it)), expected);
    }
}

//! Plans that can be carried out, those that cannot, and none.

use crate::support::{Setup, agent_on, everything, layout, object_on, plain};
use phase_model::{AgentId, Attitude, Size::*, Strength::*, Vec2};
use phase_planner::{Plan, Planner, PlannerParameters};

/// A way through a door is feasible for a body that fits, and only for that.
#[test]
fn plans_say_whether_they_can_be_carried_out() {
    let way = |size| {
        let agents = [(size, Strong, Vec2::new(8.0, 6.0)), (Small, Strong, Vec2::new(24.0, 8.0))];
        Setup { layout: layout(4, None), agents, goals: [agent_on(0, 0), agent_on(1, 2)], ..plain() }.plan(0)
    };
    let (fits, too_wide) = (way(Small), way(Huge));
    assert!(fits.is_feasible && fits.distance < 100.0, "{fits:?}");
    assert!(!too_wide.is_feasible && too_wide.distance > 100.0, "{too_wide:?}");
    assert_eq!(too_wide.subgoals, fits.subgoals, "it tries all the same");
}

#[test]
fn what_does_not_exist_has_no_plan() {
    let setup = plain();
    let planner =
        |goals| Planner::new(setup.physics(), setup.layout, AgentId::ZERO, goals, Attitude::Neutral);
    for goals in [[object_on(0, 2), agent_on(1, 0)], [agent_on(0, 2), object_on(1, 0)]] {
        assert_eq!(planner(goals).plan(&setup.state(), everything()), Plan::NONE, "there is no object");
    }
    let mut state = setup.state();
    state.bodies[0].position.x = f32::NAN;
    assert_eq!(planner(setup.goals).plan(&state, everything()), Plan::NONE);
    for wrong in [-5.0, f32::NAN, f32::INFINITY] {
        let parameters = PlannerParameters { grasp: wrong, ..PlannerParameters::default() };
        let error = parameters.validate().expect_err("out of range").to_string();
        assert!(error.starts_with("field `grasp` must be 0 to 1000"), "{error}");
    }
}

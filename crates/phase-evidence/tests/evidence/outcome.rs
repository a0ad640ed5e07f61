//! Steps at which a goal counts as reached.

use crate::support::{Move, track};
use phase_evidence::{GoalOutcome, contact::TOUCH_GAP};
use phase_model::{AgentId, Body, Goal, LandmarkId, ObjectId, Sign, Vec2};

/// Agent 0 and object 0 move as given along y = 4.5; agent 1 stands at (16, 4.5), both face up.
fn trajectory(agent: &[f32], object: &[f32]) -> phase_evidence::Track {
    let moves = agent.iter().zip(object).map(|(&agent, &object)| Move {
        agents: [(agent, 4.5, 0.0), (16.0, 4.5, 0.0)],
        objects: vec![(object, 4.5)],
        ..Move::default()
    });
    track(moves)
}

#[test]
fn being_somewhere_counts_at_the_end() {
    // Landmark 3 is at (8.5, 4.5).
    let far = 12.0;
    let near = 8.5;
    let just = 8.5 + 0.56;
    let beyond = 8.5 + 0.57;
    let goal = |sign| Goal::AgentOnLandmark { agent: AgentId::ZERO, landmark: LandmarkId::BOTTOM_LEFT, sign };
    let cases: &[(&[f32], bool, Option<usize>)] = &[
        (&[far, near, near], true, Some(1)),
        (&[near, far, near], true, Some(2)),
        (&[near, near, near], true, Some(0)),
        (&[far, near, far], false, None),
        (&[far, far, just], true, Some(2)),
        (&[far, far, beyond], false, None),
    ];
    for (xs, reached, steps) in cases {
        let rows = trajectory(xs, &[20.0; 3]);
        let outcome = GoalOutcome::of(&rows, goal(Sign::Positive));
        assert_eq!(outcome, GoalOutcome { reached: *reached, steps: *steps }, "{xs:?}");
        let outcome = GoalOutcome::of(&rows, goal(Sign::Negative));
        assert_eq!(outcome, GoalOutcome { reached: !reached, steps: None }, "{xs:?} negated");
    }
}

#[test]
fn an_object_may_lie_farther_off_than_an_agent() {
    let goal = Goal::ObjectOnLandmark {
        object: ObjectId::ZERO,
        landmark: LandmarkId::BOTTOM_LEFT,
        sign: Sign::Positive,
    };
    for (x, reached) in [(8.5 + 1.41, true), (8.5 + 1.42, false)] {
        let outcome = GoalOutcome::of(&trajectory(&[20.0; 2], &[20.0, x]), goal);
        assert_eq!(outcome.reached, reached, "{x}");
    }
}

/// Two trapezoids of radius 1 that stand side by side have bases 3 wide, so they touch at 3 u.
#[test]
fn touching_counts_at_any_time_and_getting_away_at_the_end() {
    let goal = |sign| Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign };
    let apart = 8.0;
    let touching = 13.0;
    let just = 13.0 - 0.99 * TOUCH_GAP;
    let beyond = 13.0 - 1.01 * TOUCH_GAP;
    let cases: &[(&[f32], Option<usize>, bool)] = &[
        (&[apart, touching, apart], Some(1), true),
        (&[apart, apart, touching], Some(2), false),
        (&[apart, 15.0, 15.0], Some(1), false),
        (&[apart, apart, apart], None, true),
        (&[apart, just, apart], Some(1), true),
        (&[apart, beyond, beyond], None, true),
    ];
    for (xs, first, away) in cases {
        let rows = trajectory(xs, &[20.0; 3]);
        let outcome = GoalOutcome::of(&rows, goal(Sign::Positive));
        assert_eq!(outcome, GoalOutcome { reached: first.is_some(), steps: *first }, "{xs:?}");
        let outcome = GoalOutcome::of(&rows, goal(Sign::Negative));
        assert_eq!(outcome, GoalOutcome { reached: *away, steps: None }, "{xs:?}");
    }
}

#[test]
fn head_on_agents_touch_by_their_flat_fronts() {
    let mut rows = trajectory(&[16.0, 16.0], &[20.0; 2]);
    // Agent 0 below, facing up; agent 1 above, facing down: fronts meet at a distance of 2 u.
    for (state, y) in rows.states.iter_mut().zip([9.0, 6.55]) {
        state.bodies[1] = Body::at_rest(Vec2::new(16.0, y), core::f32::consts::PI);
    }
    let goal = Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign: Sign::Positive };
    assert_eq!(GoalOutcome::of(&rows, goal).steps, Some(1));
}

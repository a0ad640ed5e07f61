//! Help and hindrance as differences.

use phase_evidence::{Effect, GoalOutcome};

fn outcome(steps: Option<usize>) -> GoalOutcome {
    GoalOutcome { reached: steps.is_some(), steps }
}

#[test]
fn a_tenth_counts() {
    // Steps with the agent, without it; helped, hindered.
    let cases = [
        (Some(30), None, true, false),
        (None, Some(30), false, true),
        (None, None, false, false),
        (Some(30), Some(30), false, false),
        (Some(27), Some(30), true, false),
        (Some(28), Some(30), false, false),
        (Some(30), Some(27), false, true),
        (Some(30), Some(28), false, false),
        (Some(0), Some(0), false, false),
        (Some(0), Some(1), true, false),
    ];
    for (with, without, helped, hindered) in cases {
        let effect = Effect { with: outcome(with), without: outcome(without) };
        assert_eq!((effect.helped(), effect.hindered()), (helped, hindered), "{with:?} {without:?}");
    }
}

#[test]
fn goals_without_a_time_count_by_success_alone() {
    let kept = |reached| GoalOutcome { reached, steps: None };
    assert!(Effect { with: kept(true), without: kept(false) }.helped());
    assert!(!Effect { with: kept(true), without: kept(true) }.helped());
}

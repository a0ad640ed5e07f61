//! Whether an observer can tell a helper from an agent with the same goal.

use super::problems::problems;
use phase_model::{AgentId, Attitude, BodySet, Entity, Goal, LandmarkId, Subgoal};
use phase_planner::Planner;
use proptest::{
    strategy::{Strategy, ValueTree},
    test_runner::TestRunner,
};

/// Random situations with an object to be moved.
const SITUATIONS: usize = 2000;
/// Upper bound of the share of situations in which both have the same subgoal.
const MAX_SAME_SHARE: f64 = 0.6;

/// A helper of an agent that wants an object on a landmark, and a neutral agent that wants it there itself:
/// how often their first subgoals are the same.
#[test]
fn helping_differs_from_an_own_errand() {
    let mut runner = TestRunner::deterministic();
    let strategy = problems();
    let observed: BodySet = Entity::ALL.into_iter().collect();
    let mut count = 0;
    let mut same = 0;
    while count < SITUATIONS {
        let situation = strategy.new_tree(&mut runner).expect("a problem").current();
        let goal @ Goal::ObjectOnLandmark { .. } = situation.goal else { continue };
        let state = situation.state();
        let physics = situation.physics();
        if phase_predicates::achieved(&physics, &state, goal) {
            continue;
        }
        let first = |attitude: Attitude, others: Goal| {
            Planner::new(physics.clone(), situation.layout, AgentId::ZERO, [goal, others], attitude)
                .plan(&state, observed)
                .first()
        };
        let elsewhere = Goal::AgentOnLandmark {
            agent: AgentId::ONE,
            landmark: LandmarkId::TOP_LEFT,
            sign: phase_model::Sign::Positive,
        };
        let helper = first(Attitude::Help, goal);
        let own = first(Attitude::Neutral, elsewhere);
        assert_ne!(own, Subgoal::Stay, "{situation:?}");
        count += 1;
        same += usize::from(helper == own);
    }
    let share = same as f64 / count as f64;
    println!("the same first subgoal in {:.0} % of {count} situations", 100.0 * share);
    assert!(share < MAX_SAME_SHARE, "{share}");
}

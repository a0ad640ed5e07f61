//! Plans of a hinderer in random situations.

use super::problems::problems;
use phase_model::{AgentId, Attitude, BodySet, Entity, Goal, Subgoal};
use phase_navigation::Map;
use phase_planner::{
    Planner, PlannerParameters, PlanningProblem, search,
    symbolic::Node,
    task::{Effort, PlanningTask},
};
use phase_predicates::achieved;
use proptest::{
    strategy::{Strategy, ValueTree},
    test_runner::TestRunner,
};

/// Random situations in which agent 1 can reach its goal.
const SITUATIONS: usize = 2000;

/// While the other can reach its goal, or has reached it, a hinderer has something to do.
#[test]
fn a_hinderer_never_stays_while_the_other_has_a_way() {
    let mut runner = TestRunner::deterministic();
    let strategy = problems();
    let observed: BodySet = Entity::ALL.into_iter().collect();
    let costs = PlannerParameters::default();
    let mut count = 0;
    while count < SITUATIONS {
        let situation = strategy.new_tree(&mut runner).expect("a problem").current();
        if situation.goal.subject() == Entity::Agent(AgentId::ZERO)
            || matches!(situation.goal, Goal::Touch { .. })
        {
            continue;
        }
        let physics = situation.physics();
        let state = situation.state();
        let map = Map::new(situation.layout);
        let problem = PlanningProblem::new(&physics, &map, &state, costs);
        let task = PlanningTask {
            problem: &problem,
            goal: situation.goal,
            actors: [false, true],
            efforts: [Effort::OWN; 2],
            cooperative: false,
            narrowed: None,
        };
        let mut start = Node::start(&problem);
        start.holds[AgentId::ZERO] = None;
        let cost = search::solve(&task, start).map_or(f32::INFINITY, |plan| plan.cost);
        if cost >= costs.impassable && !achieved(&physics, &state, situation.goal) {
            continue;
        }
        let goals = [situation.goal.negated(), situation.goal];
        let plan = Planner::new(physics, situation.layout, AgentId::ZERO, goals, Attitude::Hinder)
            .plan(&state, observed);
        assert_ne!(plan.first(), Subgoal::Stay, "{situation:?}");
        count += 1;
    }
}

//! V(B, h, g) computed by hand.

use phase_model::{AgentId, Entity, LandmarkId, Literal, Predicate, Subgoal};
use phase_planner::{Plan, value::candidates};

fn plan(landmark: u8, distance: f32) -> Plan {
    let subgoal = Subgoal::Achieve(Literal::is(Predicate::On(
        Entity::Agent(AgentId::ZERO),
        LandmarkId::ALL[usize::from(landmark)],
    )));
    Plan { subgoals: vec![subgoal], distance, is_feasible: true }
}

#[test]
fn value_is_share_minus_weighted_mean_cost() {
    // Three of four particles far away, one near: V = 3/4 − λ 20 and 1/4 − λ 4.
    let plans = [plan(0, 18.0), plan(0, 20.0), plan(0, 22.0), plan(1, 4.0)];
    let plans: Vec<&Plan> = plans.iter().collect();
    for (lambda, first, value, other) in
        [(0.05, 1, 0.25 - 0.05 * 4.0, 0.75 - 0.05 * 20.0), (0.0, 0, 0.75, 0.25)]
    {
        let found = candidates(&plans, lambda);
        let expected = Subgoal::Achieve(Literal::is(Predicate::On(
            Entity::Agent(AgentId::ZERO),
            LandmarkId::ALL[first],
        )));
        assert_eq!(found[0].subgoal, expected);
        assert!((found[0].value - value).abs() < 1e-9);
        assert!((found[1].value - other).abs() < 1e-9);
        assert_eq!(found.iter().map(|candidate| candidate.particles.len()).sum::<usize>(), 4);
    }
}

#[test]
fn no_particles_no_candidates() {
    assert!(candidates(&[], 0.05).is_empty());
}

//! Marginals of weighted hypotheses, computed by hand.

use phase_model::{AgentId, Attitude, Goal, LandmarkId, ObjectId, Relation, Sign, Strength};
use phase_simple::{Hypothesis, Posterior, geometric_median, physical_goals};

fn place(agent: u8, landmark: u8) -> Goal {
    Goal::AgentOnLandmark {
        agent: AgentId::ALL[usize::from(agent)],
        landmark: LandmarkId::ALL[usize::from(landmark)],
        sign: Sign::Positive,
    }
}

fn thing(object: u8, landmark: u8) -> Goal {
    Goal::ObjectOnLandmark {
        object: ObjectId::ALL[usize::from(object)],
        landmark: LandmarkId::ALL[usize::from(landmark)],
        sign: Sign::Positive,
    }
}

const CHASE: Goal = Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign: Sign::Positive };
const FLIGHT: Goal = Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign: Sign::Negative };

fn neutral(goals: [Goal; 2]) -> Hypothesis {
    Hypothesis::new(goals, [Attitude::Neutral; 2], [Strength::Fair; 2])
}

fn social(goal: Goal, attitude: Attitude) -> Hypothesis {
    Hypothesis::new([place(0, 0), goal], [attitude, Attitude::Neutral], [Strength::Fair; 2])
}

#[test]
fn a_social_agent_bears_the_others_goal() {
    assert_eq!(social(thing(0, 3), Attitude::Help).goals, [thing(0, 3); 2]);
    assert_eq!(social(thing(0, 3), Attitude::Hinder).goals, [thing(0, 3).negated(), thing(0, 3)]);
    assert_eq!(social(thing(0, 3), Attitude::Neutral).goals, [place(0, 0), thing(0, 3)]);
}

#[test]
fn there_are_fourteen_goals_with_two_objects() {
    for (objects, count) in [(0, 6), (1, 10), (2, 14)] {
        for agent in AgentId::ALL {
            let mut goals = physical_goals(agent, objects);
            assert_eq!(goals.len(), count);
            goals.sort();
            goals.dedup();
            assert_eq!(goals.len(), count, "no goal twice");
        }
    }
    // In a chase both goals name the chaser.
    assert!(
        physical_goals(AgentId::ZERO, 0).contains(&CHASE)
            && physical_goals(AgentId::ONE, 0).contains(&FLIGHT)
    );
}

/// Weights 3/4 and 1/4 from log likelihoods that are ln 3 apart, far below what exp can hold.
#[test]
fn weights_are_likelihoods_in_proportion() {
    let a = neutral([place(0, 1), place(1, 2)]);
    let b = neutral([place(0, 1), thing(0, 2)]);
    let posterior = Posterior::new([(b, -5000.0), (a, -5000.0 + 3f64.ln())]);
    let weights: Vec<f64> = posterior.hypotheses.iter().map(|(_, weight)| *weight).collect();
    assert_eq!(posterior.hypotheses[0].0, a);
    assert!((weights[0] - 0.75).abs() < 1e-12 && (weights[1] - 0.25).abs() < 1e-12);
    let certain = posterior.goals(AgentId::ZERO);
    assert!(matches!(certain[..], [(goal, p)] if goal == place(0, 1) && (p - 1.0).abs() < 1e-12));
    let goals = posterior.goals(AgentId::ONE);
    assert_eq!(goals[0].0, place(1, 2));
    assert!((goals[1].1 - 0.25).abs() < 1e-12);
}

#[test]
fn equal_particles_add_up() {
    let a = neutral([place(0, 1), place(1, 2)]);
    let b = social(thing(0, 2), Attitude::Help);
    let posterior = Posterior::new([(a, -1.0), (b, -1.0), (a, -1.0)]);
    assert_eq!(posterior.hypotheses.len(), 2);
    assert!((posterior.attitude(AgentId::ZERO, Attitude::Help) - 1.0 / 3.0).abs() < 1e-12);
    assert!((posterior.attitude(AgentId::ONE, Attitude::Neutral) - 1.0).abs() < 1e-12);
}

/// Every kind of friendly and adversarial relation that the paper names, and neither.
#[test]
fn relations_follow_from_goals_and_attitudes() {
    let cases = [
        (social(thing(0, 2), Attitude::Help), Relation::Friendly),
        (neutral([thing(0, 2); 2]), Relation::Friendly),
        (social(thing(0, 2), Attitude::Hinder), Relation::Adversarial),
        (neutral([thing(0, 2), thing(0, 1)]), Relation::Adversarial),
        (neutral([CHASE, FLIGHT]), Relation::Adversarial),
        (neutral([thing(0, 2), thing(1, 1)]), Relation::Neutral),
        (neutral([place(0, 2), place(1, 2)]), Relation::Neutral),
    ];
    for (hypothesis, relation) in cases {
        let probabilities = Posterior::new([(hypothesis, -3.0)]).relation();
        assert_eq!(probabilities.of(relation), 1.0, "{hypothesis:?}");
    }
    let all = Posterior::new(cases.map(|(hypothesis, _)| (hypothesis, -7.0))).relation();
    for (action_likelihoods, expected) in [(all.friendly, 2.0), (all.adversarial, 3.0), (all.neutral, 2.0)] {
        assert!((action_likelihoods - expected / 7.0).abs() < 1e-12);
    }
}

/// With 14 goals: no agent social 1/3 · (1/14)², one social in a given way 1/6 · 1/14, strengths 1/16 each
/// time; all hypotheses together 1.
#[test]
fn the_prior_adds_up_to_one() {
    let goals = [physical_goals(AgentId::ZERO, 2), physical_goals(AgentId::ONE, 2)];
    let mut sum = 0.0;
    for &first in &goals[0] {
        for &second in &goals[1] {
            sum += neutral([first, second]).log_prior(14).exp() * 16.0;
        }
    }
    for (agent, goals) in AgentId::ALL.into_iter().zip(&goals) {
        for &goal in goals {
            for attitude in [Attitude::Help, Attitude::Hinder] {
                let mut attitudes = [Attitude::Neutral; 2];
                attitudes[agent.other()] = attitude;
                let hypothesis = Hypothesis::new([goal; 2], attitudes, [Strength::Weak; 2]);
                sum += hypothesis.log_prior(14).exp() * 16.0;
            }
        }
    }
    assert!((sum - 1.0).abs() < 1e-12, "{sum}");
}

#[test]
fn the_median_of_places() {
    use phase_model::Vec2;
    let at = |x: f32, y: f32, weight: f64| (Vec2::new(x, y), weight);
    let near = |places: &[(Vec2, f64)], x: f32, y: f32| {
        let median = geometric_median(places);
        assert!(median.distance(Vec2::new(x, y)) < 0.01, "{median}");
    };
    near(&[at(3.0, 4.0, 1.0)], 3.0, 4.0);
    // More than half of the weight decides alone, however far away the rest is.
    near(&[at(0.0, 0.0, 0.6), at(100.0, 0.0, 0.4)], 0.0, 0.0);
    // The corners of a square: its centre.
    near(&[at(0.0, 0.0, 1.0), at(2.0, 0.0, 1.0), at(2.0, 2.0, 1.0), at(0.0, 2.0, 1.0)], 1.0, 1.0);
    assert_eq!(geometric_median(&[]), Vec2::ZERO);
}

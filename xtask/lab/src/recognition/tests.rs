//! Posteriors whose figures are told by hand.

use super::{Recognition, SocialAgent};
use phase_model::{AgentId, Attitude, Goal, LandmarkId, ObjectId, Sign, Strength};
use phase_simple::{Hypothesis, Posterior};

const OBJECT_TOP_LEFT: Goal =
    Goal::ObjectOnLandmark { object: ObjectId::ZERO, landmark: LandmarkId::TOP_LEFT, sign: Sign::Positive };
const OBJECT_TOP_RIGHT: Goal =
    Goal::ObjectOnLandmark { object: ObjectId::ZERO, landmark: LandmarkId::TOP_RIGHT, sign: Sign::Positive };

fn touch(agent: AgentId, sign: Sign) -> Goal {
    Goal::Touch { agent, other: agent.other(), sign }
}

fn helped_by(agent: AgentId, goal: Goal, strength: Strength) -> Hypothesis {
    let mut attitudes = [Attitude::Neutral; 2];
    attitudes[agent] = Attitude::Help;
    Hypothesis::new([goal; 2], attitudes, [strength; 2])
}

fn posterior(weights: &[(Hypothesis, f64)]) -> Posterior {
    Posterior::new(weights.iter().map(|(hypothesis, weight)| (*hypothesis, weight.ln())))
}

#[test]
fn the_truth_is_summed_over_strengths_and_the_helper_is_told_from_the_helpee() {
    let truth = helped_by(AgentId::ZERO, OBJECT_TOP_LEFT, Strength::Fair);
    let posterior = posterior(&[
        (truth, 0.2),
        (helped_by(AgentId::ZERO, OBJECT_TOP_LEFT, Strength::ALL[0]), 0.1),
        (helped_by(AgentId::ZERO, OBJECT_TOP_RIGHT, Strength::Fair), 0.05),
        (helped_by(AgentId::ONE, OBJECT_TOP_LEFT, Strength::Fair), 0.25),
        (Hypothesis::new([OBJECT_TOP_LEFT; 2], [Attitude::Neutral; 2], [Strength::Fair; 2]), 0.4),
    ]);
    let Recognition { log_posterior, relation, relation_right, goals_right, social } =
        Recognition::of(&posterior, &truth);
    assert!((log_posterior - 0.3_f64.ln()).abs() < 1e-9, "{log_posterior}");
    assert!((relation - 1.0).abs() < 1e-9 && relation_right, "helping and collaborating are friendly");
    assert_eq!(goals_right, 2);
    let SocialAgent { right, wrong, named } = social.expect("somebody helps");
    assert!((right - 0.35).abs() < 1e-9 && (wrong - 0.25).abs() < 1e-9, "{right} {wrong}");
    assert!(!named, "that nobody helps is likelier");
}

#[test]
fn a_touch_is_the_same_whoever_is_named_first() {
    let neutral = |goals| Hypothesis::new(goals, [Attitude::Neutral; 2], [Strength::Fair; 2]);
    let chase = touch(AgentId::ZERO, Sign::Positive);
    let flight = touch(AgentId::ZERO, Sign::Negative);
    let posterior = posterior(&[(neutral([chase, touch(AgentId::ONE, Sign::Negative)]), 1.0)]);
    let found = Recognition::of(&posterior, &neutral([chase, flight]));
    assert!(found.log_posterior.abs() < 1e-9, "{}", found.log_posterior);
    assert_eq!((found.goals_right, found.social), (2, None));
}

#[test]
fn a_truth_without_weight_has_a_finite_logarithm() {
    let truth = helped_by(AgentId::ZERO, OBJECT_TOP_LEFT, Strength::Fair);
    let found = Recognition::of(
        &posterior(&[(helped_by(AgentId::ONE, OBJECT_TOP_RIGHT, Strength::Fair), 1.0)]),
        &truth,
    );
    assert!(found.log_posterior.is_finite() && found.log_posterior < -700.0);
    let social = found.social.expect("somebody helps");
    assert!(!social.named && social.wrong > 0.9 && found.goals_right == 0);
}

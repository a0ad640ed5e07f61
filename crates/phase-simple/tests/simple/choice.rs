//! The chance of what was done, by hand and by its definition.

use phase_event::{ActionEvaluation, ObservedEvent, Thought};
use phase_minds::MindParameters;
use phase_model::{Action, AgentId, Body, Goal, LandmarkId, Layout, Sign, Size, Strength, Vec2};
use phase_simple::{
    AgentDecision, Hypothesis, PreparedEvent,
    choice::{CHOICES, Chance, action_likelihoods, chances, fitted_lapse, index, log_likelihood, policy},
};
use proptest::prelude::*;

fn decided(action: Action, visits: &[(Action, u32)]) -> AgentDecision {
    let actions = visits.iter().map(|&(action, visits)| ActionEvaluation { action, visits, value: 0.0 });
    let thought = Thought { actions: actions.collect(), ..Thought::IDLE };
    AgentDecision { action, thought, deviation: 0.0 }
}

#[test]
fn both_turns_are_one_choice_and_all_others_are_their_own() {
    assert_eq!(index(Action::TurnLeft), index(Action::TurnRight));
    let mut indices: Vec<usize> = Action::ALL.into_iter().map(index).collect();
    indices.sort_unstable();
    indices.dedup();
    assert_eq!(indices, (0..CHOICES).collect::<Vec<_>>());
}

#[test]
fn the_policy_is_the_share_of_visits() {
    let visits = [(Action::TurnLeft, 10), (Action::TurnRight, 20), (Action::Stop, 10)];
    let policy = policy(&decided(Action::TurnRight, &visits));
    assert!((policy[index(Action::TurnLeft)] - 0.75).abs() < 1e-12);
    assert!((policy[index(Action::Stop)] - 0.25).abs() < 1e-12);
    assert!((policy.iter().sum::<f64>() - 1.0).abs() < 1e-12);
}

#[test]
fn an_only_action_is_certain() {
    let policy = policy(&decided(Action::Stop, &[]));
    assert_eq!(policy[index(Action::Stop)], 1.0);
    assert_eq!(policy.iter().sum::<f64>(), 1.0);
}

#[test]
fn lapses_are_fitted_as_by_hand() {
    // One step in two that the mind would never have chosen, of which the uniform choice takes one in ten,
    // and one that it is certain of: ln(0.1 e) + ln(1 - 0.9 e) is greatest at e = 1/1.8.
    let steps = [Chance { mind: 0.0, uniform: 0.1 }, Chance { mind: 1.0, uniform: 0.1 }];
    assert!((fitted_lapse(&steps) - 1.0 / 1.8).abs() < 1e-9);
    let expected = 0.5 * ((0.1_f64 / 1.8).ln() + 0.5_f64.ln());
    assert!((log_likelihood(&steps, fitted_lapse(&steps)).expect("steps") - expected).abs() < 1e-9);
    assert!(fitted_lapse(&steps[1..]) < 1e-9, "a perfect mind never lapses");
    assert!(fitted_lapse(&steps[..1]) > 1.0 - 1e-9, "a mind that is always wrong always does");
    assert_eq!(log_likelihood(&[], 0.5), None);
}

proptest! {
    #[test]
    fn chances_are_probabilities_and_the_fitted_lapse_is_best(
        steps in prop::collection::vec((0.0..=1.0_f64, 0.08..=1.0_f64), 1..20),
        other in 0.0..=1.0_f64,
    ) {
        let steps: Vec<Chance> = steps.into_iter().map(|(mind, uniform)| Chance { mind, uniform }).collect();
        let fitted = fitted_lapse(&steps);
        prop_assert!((0.0..=1.0).contains(&fitted));
        prop_assert!(log_likelihood(&steps, fitted) >= log_likelihood(&steps, other).map(|log| log - 1e-9));
    }

    #[test]
    fn a_chance_is_largest_for_the_likeliest_choice(
        likelihoods in prop::array::uniform13(0.0..1.0_f64), weights in prop::array::uniform13(0.01..1.0_f64),
    ) {
        let sum: f64 = weights.iter().sum();
        let chance = Chance::of(&weights.map(|weight| weight / sum), &likelihoods);
        prop_assert!((0.0..=1.0 + 1e-12).contains(&chance.mind));
        prop_assert!(chance.uniform <= 1.0 + 1e-12 && chance.uniform >= 1.0 / 13.0 - 1e-12);
        let best = (0..CHOICES).max_by(|&a, &b| likelihoods[a].total_cmp(&likelihoods[b])).expect("choices");
        let mut certain = [0.0; CHOICES];
        certain[best] = 1.0;
        prop_assert!((Chance::of(&certain, &likelihoods).mind - 1.0).abs() < 1e-12);
    }
}

#[test]
fn an_agent_at_rest_is_likelier_to_want_to_be_where_it_is() {
    let rest = [Vec2::new(8.5, 19.5), Vec2::new(23.5, 4.5), Vec2::ZERO, Vec2::ZERO];
    let rows = vec![rest.map(|place| Body::at_rest(place, 0.0)); 7];
    let layout = Layout::new(0, None).expect("a layout");
    let observed = ObservedEvent::new(layout, [Size::Small; 2], Vec::new(), rows).expect("an event");
    let minds = MindParameters::default().with_particles(5).with_simulations(20);
    let prepared = PreparedEvent::new(&observed, minds, 1);
    let likelihoods = action_likelihoods(&prepared, 0.03);
    let agent = AgentId::ZERO;
    let mean = |landmark: LandmarkId| {
        let goal = Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive };
        let hypothesis = Hypothesis::new([goal; 2], Default::default(), [Strength::Fair; 2]);
        let chances = chances(&prepared, &likelihoods, &hypothesis, agent).expect("sound parameters");
        assert_eq!(chances.len(), 6);
        chances.iter().map(|chance| chance.mind).sum::<f64>() / 6.0
    };
    let [here, elsewhere] = [LandmarkId::TOP_LEFT, LandmarkId::BOTTOM_LEFT].map(mean);
    assert!(here > 0.9 && elsewhere < here, "{here} {elsewhere}");
}

#[test]
fn a_decision_at_a_step_depends_on_no_other_and_steps_past_the_end_are_left_out() {
    let rows = (0..=6_u8).map(|step| {
        let places = [Vec2::new(23.5, 6.0 + f32::from(step)), Vec2::new(8.5, 19.5), Vec2::ZERO, Vec2::ZERO];
        let mut row = places.map(|place| Body::at_rest(place, 0.0));
        row[0].velocity = Vec2::new(0.0, 12.0);
        row
    });
    let layout = Layout::new(0, None).expect("a layout");
    let observed =
        ObservedEvent::new(layout, [Size::Small; 2], Vec::new(), rows.collect()).expect("an event");
    let minds = MindParameters::default().with_particles(5).with_simulations(20);
    let prepared = PreparedEvent::new(&observed, minds, 1);
    let agent = AgentId::ZERO;
    let goal = Goal::AgentOnLandmark { agent, landmark: LandmarkId::TOP_RIGHT, sign: Sign::Positive };
    let hypothesis = Hypothesis::new([goal; 2], Default::default(), [Strength::Fair; 2]);
    let at = |steps: &[usize]| {
        let decided = prepared.decide_at(&hypothesis, agent, minds, steps).expect("sound parameters");
        decided.into_iter().map(|it| (it.action, policy(&it), it.deviation)).collect::<Vec<_>>()
    };
    let all = at(&[0, 1, 2, 3, 4, 5]);
    assert_eq!(all.len(), 6);
    assert_eq!(at(&[5, 3]), [all[5], all[3]]);
    assert_eq!(at(&[4, 6, 100]), [all[4]]);
}

//! Scores of beliefs, and the rules that answer without minds.

use core::ops::ControlFlow;
use phase_eval::{
    beliefs::{BeliefEvent, BeliefSummary, asked_steps},
    trivial::BeliefRule,
};
use phase_event::{BeliefOrder, BeliefReader, Beliefs, ObservedEvent, SEEN, certain};
use phase_model::{AgentId, Body, Layout, MAX_ENTITIES, RoomId, Size, Vec2, layout::room_of};

const HERE: Vec2 = Vec2::new(23.0, 8.0);
const THERE: Vec2 = Vec2::new(8.5, 19.5);

/// Both agents face away from the object, which is in one room up to row 1 and in another afterwards; in row
/// 3, agent 0 turns to it.
fn observed() -> ObservedEvent {
    let row = |step: usize| -> [Body; MAX_ENTITIES] {
        let object = if step < 2 { HERE } else { THERE };
        let angle = if step == 3 { 0.0 } else { core::f32::consts::PI };
        let agent = |x: f32, angle: f32| Body::at_rest(Vec2::new(x, 14.0), angle);
        [agent(8.5, angle), agent(23.0, 0.0), Body::at_rest(object, 0.0), Body::default()]
    };
    let rows = (0..6).map(row).collect();
    let layout = Layout::new(0, None).expect("a layout");
    ObservedEvent::new(layout, [Size::Small; 2], vec![Size::Small], rows).expect("an event")
}

/// The place of the object in an agent's belief after each step.
fn places(rule: BeliefRule, agent: AgentId) -> Vec<usize> {
    places_of(rule, BeliefOrder::First, agent)
}

fn places_of(rule: BeliefRule, order: BeliefOrder, agent: AgentId) -> Vec<usize> {
    let steps: Vec<usize> = (0..6).collect();
    let answer = rule.read_beliefs(&observed(), order, &steps, 1, &mut || ControlFlow::Continue(()));
    let (beliefs, _) = answer.expect("an answer").expect("not cancelled");
    let place = |of: &Beliefs| of[agent][1].iter().position(|&p| p == 1.0).expect("a place");
    beliefs.iter().map(place).collect()
}

#[test]
fn rules_know_what_they_say() {
    let [here, there] = [HERE, THERE].map(|place| room_of(place).index());
    let zero = AgentId::ZERO;
    assert_eq!(places(BeliefRule::LastSeen, zero), [here, here, here, SEEN, there, there]);
    assert_eq!(places(BeliefRule::TrueState, zero), [here, here, there, SEEN, there, there]);
    assert_eq!(places(BeliefRule::FirstState, zero), [here, here, here, SEEN, here, here]);
    assert_eq!(places(BeliefRule::LastSeen, AgentId::ONE)[5], here, "it never turned");
    assert_eq!(places(BeliefRule::OwnBelief, zero), places(BeliefRule::LastSeen, zero));
}

/// Agent 1 never sees the object; agent 0 does in row 3.
#[test]
fn rules_about_beliefs_look_through_the_others_eyes() {
    let [here, there] = [HERE, THERE].map(|place| room_of(place).index());
    let of = |rule| places_of(rule, BeliefOrder::Second, AgentId::ZERO);
    assert_eq!(of(BeliefRule::LastSeen), [here; 6]);
    assert_eq!(of(BeliefRule::OwnBelief), [here, here, here, there, there, there]);
    assert_eq!(of(BeliefRule::TrueState), [here, here, there, there, there, there]);
    let other = |rule| places_of(rule, BeliefOrder::Second, AgentId::ONE);
    assert_eq!(other(BeliefRule::LastSeen), places(BeliefRule::LastSeen, AgentId::ZERO));
    assert_eq!(other(BeliefRule::OwnBelief), [here, here, here, SEEN, here, here]);
}

#[test]
fn scores_are_those_of_the_questions() {
    let other = [0.25, 0.25, 0.25, 0.25, 0.0];
    let truth: Vec<Beliefs> = vec![[vec![certain(SEEN), certain(0)], vec![certain(1), other]]];
    let unsure = [0.5, 0.25, 0.25, 0.0, 0.0];
    let answers: Vec<Beliefs> = vec![[vec![certain(SEEN), unsure], vec![certain(2), certain(0)]]];
    let moved = |_, agent: AgentId, _| agent == AgentId::ZERO;
    let questions = BeliefEvent::questions(BeliefOrder::First, &[4], 1, &truth, &answers, moved);
    let questions = questions.expect("answers for every entity");
    // The particles of the fourth belief agree on no place.
    assert_eq!(questions.len(), 3);
    let event = BeliefEvent {
        id: "event".into(),
        order: BeliefOrder::First,
        questions,
        cpu_seconds: None,
        details: Default::default(),
    };
    let summary = BeliefSummary::of(&[event], 1).expect("one event");
    let [all, unseen, moved] =
        [&summary.all, &summary.unseen, &summary.moved].map(|it| it.as_ref().expect("questions"));
    assert_eq!((all.questions, unseen.questions, moved.questions), (3, 2, 1));
    assert!((all.accuracy.value - 2.0 / 3.0).abs() < 1e-12);
    assert!((unseen.accuracy.value - 0.5).abs() < 1e-12);
    // 0.5² + 2 · 0.25², and 2 for a certain error.
    assert!((moved.brier.value - 0.375).abs() < 1e-12);
    assert!((unseen.brier.value - 1.1875).abs() < 1e-12);
    assert!((moved.calibration.error - 0.5).abs() < 1e-12);
    assert_eq!(asked_steps(11), [4, 8]);
}

#[test]
fn answers_of_another_form_are_refused() {
    let truth: Vec<Beliefs> = vec![[vec![certain(RoomId::TOP_LEFT.index())], vec![certain(1)]]];
    let ask = |answers: &[Beliefs]| {
        BeliefEvent::questions(BeliefOrder::First, &[4], 0, &truth, answers, |_, _, _| false)
    };
    assert!(ask(&truth).is_ok());
    assert!(ask(&[]).unwrap_err().contains("after 1 steps"));
    assert!(ask(&[[vec![], vec![certain(1)]]]).unwrap_err().contains("1 entities"));
    assert!(ask(&[[vec![[0.5; 5]], vec![certain(1)]]]).unwrap_err().contains("sum to 1"));
}

//! Scores of believed intents.

use phase_eval::intents::{BelievedIntents, IntentEvent, IntentSummary};
use phase_model::{AGENT_COUNT, AgentId, Attitude, Goal, Intent, LandmarkId, Sign};
use std::collections::BTreeMap;

const ONE: AgentId = AgentId::ONE;

fn goes(landmark: LandmarkId) -> Intent {
    let goal = Goal::AgentOnLandmark { agent: ONE, landmark, sign: Sign::Positive };
    Intent { attitude: Attitude::Neutral, goal }
}

/// Agent 1 approaches agent 0, said in one of two ways.
fn approaches(agent: AgentId) -> Intent {
    let goal = Goal::Touch { agent, other: agent.other(), sign: Sign::Positive };
    Intent { attitude: Attitude::Neutral, goal }
}

/// Beliefs of agent 0; agent 1 knows what agent 0 wants.
fn of(intents: &[(Intent, f64)]) -> BelievedIntents {
    let mut believed = BelievedIntents::default();
    believed[AgentId::ZERO] = intents.iter().copied().collect();
    believed
}

/// Answers need probabilities of both agents.
fn said(intents: &[(Intent, f64)]) -> BelievedIntents {
    let both: BTreeMap<Intent, f64> = intents.iter().copied().collect();
    [both.clone(), both]
}

const WANTS: [LandmarkId; 2] = [LandmarkId::TOP_LEFT, LandmarkId::TOP_RIGHT];

fn intents() -> [Intent; AGENT_COUNT] {
    [goes(WANTS[0]), goes(WANTS[0])]
}

#[test]
fn answers_are_compared_with_the_particles_and_not_with_what_the_other_wants() {
    let [left, right] = WANTS.map(goes);
    let truth = [of(&[(left, 0.5), (right, 0.5)]), of(&[(right, 0.8), (left, 0.2)]), of(&[(left, 1.0)])];
    let answers = [said(&[(left, 1.0)]), said(&[(left, 1.0)]), said(&[(left, 0.75), (right, 0.25)])];
    let questions = IntentEvent::questions(&[4, 8, 12], &truth, &answers, intents()).expect("questions");
    let steps: Vec<usize> = questions.iter().map(|it| it.step).collect();
    assert_eq!(steps, [8, 12], "after step 4 the particles do not agree");
    assert!(questions.iter().all(|it| it.agent == AgentId::ZERO), "agent 1 knows what agent 0 wants");
    assert!(questions[0].mistaken && !questions[1].mistaken);
    assert!((questions[0].brier - 2.0 * 0.8 * 0.8).abs() < 1e-12);
    assert!((questions[1].brier - 2.0 * 0.25 * 0.25).abs() < 1e-12);
    let event = IntentEvent { id: "one".into(), questions, cpu_seconds: None, details: Default::default() };
    let summary = IntentSummary::of(&[event], 1).expect("scores");
    let accuracy = |scores: Option<phase_eval::beliefs::BeliefScores>| scores.expect("scores").accuracy.value;
    assert_eq!(accuracy(summary.all), 0.5);
    assert_eq!(accuracy(summary.mistaken), 0.0);
    let by_step: Vec<(usize, f64)> =
        summary.by_step.iter().map(|it| (it.step, it.scores.accuracy.value)).collect();
    assert_eq!(by_step, [(8, 0.0), (12, 1.0)]);
}

#[test]
fn a_touch_is_about_both_agents() {
    let truth = [of(&[(approaches(ONE), 0.5), (approaches(AgentId::ZERO), 0.5)])];
    let answers = [said(&[(approaches(AgentId::ZERO), 1.0)])];
    let questions = IntentEvent::questions(&[4], &truth, &answers, [approaches(ONE); 2]).expect("questions");
    assert_eq!((questions.len(), questions[0].brier, questions[0].mistaken), (1, 0.0, false));
}

#[test]
fn answers_that_are_no_probabilities_are_refused() {
    let [left, right] = WANTS.map(goes);
    let truth = [of(&[(left, 1.0)])];
    for answer in [said(&[(left, 0.5)]), said(&[(left, 1.5), (right, -0.5)]), said(&[])] {
        assert!(IntentEvent::questions(&[4], &truth, &[answer], intents()).is_err());
    }
    assert!(IntentEvent::questions(&[4], &truth, &[], intents()).is_err());
    assert_eq!(IntentSummary::of(&[], 1), None);
}

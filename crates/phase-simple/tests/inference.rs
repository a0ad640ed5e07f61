//! Whole inferences, on events whose labels are known to the test and to nobody else.

use phase_dataset::phase_events::Recording;
use phase_model::{
    Attitude, Goal, Layout, ObservedEvent, Relation,
    random::{Purpose, stream},
};
use phase_sampler::{Request, Variant, sample};
use phase_sim::Event;
use phase_simple::{AnyStrength, Settings, Stage, explain, reconstruction};

/// An event of a variant, by minds that think less than the paper's.
fn event(variant: Variant, seed: u64) -> Event {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let request = Request { variant, turn: seed as usize, layouts: &layouts };
    let scene = sample(&request, &mut stream(seed, Purpose::Scene, 0)).expect("there are such scenes");
    let minds = phase_agent::Settings { simulations: 100, ..phase_agent::Settings::default() };
    let settings = phase_sim::Settings { minds, ..phase_sim::Settings::default() };
    phase_sim::simulate(&scene, seed, &settings).expect("a sound scene")
}

fn observed(event: &Event) -> ObservedEvent {
    recording(event.clone()).observed().expect("a sound event")
}

fn recording(event: Event) -> Recording {
    Recording::of_event("event", event, "test".into(), serde_json::Value::Null)
}

fn quick() -> Settings {
    let minds = phase_agent::Settings { simulations: 20, particles: 10, ..phase_agent::Settings::default() };
    Settings { minds, iterations: 1, ..Settings::default() }
}

#[test]
fn no_label_is_seen() {
    let event = event(Variant::Places, 1);
    let mut relabelled = recording(event.clone());
    for agent in &mut relabelled.scene.agents {
        agent.goal = Goal::ObjectOnLandmark { object: 0, landmark: 0, sign: phase_model::Sign::Positive };
        agent.attitude = Attitude::Hinder;
        agent.strength = phase_model::Strength::Mighty;
    }
    relabelled.relation = Relation::Adversarial;
    relabelled.recorded_steps = Some(77);
    relabelled.simulation = None;
    assert_eq!(relabelled.observed().expect("a sound event"), observed(&event));
}

#[test]
fn the_same_seed_gives_the_same_answer() {
    let event = observed(&event(Variant::Places, 2)).watched_for(25);
    let answers = [1, 1, 2].map(|seed| explain(&event, &AnyStrength, seed, &quick()).expect("is sound"));
    assert_eq!(answers[0], answers[1]);
    let together: f64 = answers[0].posterior.hypotheses.iter().map(|(_, weight)| weight).sum();
    assert!((together - 1.0).abs() < 1e-9, "{together}");
    assert_ne!(answers[0].posterior, answers[2].posterior, "another seed draws other futures");
}

/// Both walk to their landmarks and stop: the plainest event there is.
#[test]
fn two_who_walk_to_their_landmarks_are_understood() {
    let event = event(Variant::Places, 3);
    let judgement = explain(&observed(&event), &AnyStrength, 1, &Settings::default())
        .expect("is sound")
        .posterior
        .judgement();
    for (goals, goal) in judgement.goals.iter().zip(event.scene.goals()) {
        assert_eq!(goals[0].0, goal, "{goals:?}");
    }
}

/// Held objects are found by how they sit, and free ones are not.
#[test]
fn grips_are_found_again() {
    let (mut found, mut missed, mut false_alarms) = (0, 0, 0);
    for seed in 0..3 {
        let event = event(Variant::Carry, seed);
        let states = reconstruction::states(&observed(&event));
        for (step, state) in event.steps.iter().zip(&states[1..]) {
            for agent in 0..2 {
                match (step.substeps[4].held_object(agent), state.held_object(agent)) {
                    (Some(truth), Some(guess)) if truth == guess => found += 1,
                    (Some(_), _) => missed += 1,
                    (None, Some(_)) => false_alarms += 1,
                    (None, None) => {}
                }
            }
        }
    }
    assert!(found > 20, "somebody carries something: {found}");
    assert!(missed * 5 < found && false_alarms * 5 < found, "{found} {missed} {false_alarms}");
}

/// Simulated with the very beliefs that led to it, an anchored event deviates less under what is true than under
/// what is false.
#[test]
fn the_truth_deviates_least() {
    let event = event(Variant::Places, 5);
    let seen = observed(&event);
    let stage = Stage::new(&seen, Settings::default().minds, 1);
    let strengths = event.scene.agents.map(|agent| agent.strength);
    let deviation = |goals: [Goal; 2]| {
        let hypothesis = phase_simple::Hypothesis::new(goals, [Attitude::Neutral; 2], strengths);
        let deviations = stage.simulate(&hypothesis, Some(10), f64::INFINITY).expect("is sound");
        assert_eq!(deviations.len(), seen.steps());
        deviations.iter().sum::<f64>()
    };
    let truth = deviation(event.scene.goals());
    let swapped = event.scene.goals().map(|goal| match goal {
        Goal::AgentOnLandmark { agent, landmark, sign } => {
            Goal::AgentOnLandmark { agent, landmark: (landmark + 2) % 4, sign }
        }
        other => other,
    });
    assert!(truth < deviation(swapped), "{truth}");
    // Whoever asks for no more than a part gets no more.
    let hypothesis = phase_simple::Hypothesis::new(swapped, [Attitude::Neutral; 2], strengths);
    let part = stage.simulate(&hypothesis, Some(10), truth).expect("is sound");
    assert!(part.len() < seen.steps() && part.iter().sum::<f64>() > truth);
}

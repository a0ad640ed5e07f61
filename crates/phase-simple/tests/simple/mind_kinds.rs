//! The kind of minds that made an event is inferred with the rest.

use phase_event::{ObservedEvent, Recording};
use phase_minds::{MindKind, MindParameters};
use phase_model::{
    Layout,
    random::{Purpose, stream},
};
use phase_sampler::{Request, Starts, Variant, sample};
use phase_sim::SimulationSettings;
use phase_simple::{
    Algorithm, Cues, Inference, InferenceSettings, InversePlanningSettings, PreparedEvent, UniformStrength,
    explain, infer,
};

/// Steps that are observed.
const STEPS: usize = 30;
/// Seeds of scenes.
const SEEDS: [u64; 3] = [5, 6, 7];
/// Share of the events whose true kind is the likelier one.
const ATTRIBUTED: f64 = 0.75;
/// Odds for the true kinds in all events together.
const ODDS: f64 = 9.0;

/// The start of an event of a variant by minds of a kind.
fn observed(variant: Variant, kind: MindKind, seed: u64) -> ObservedEvent {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let request = Request { variant, goal_index: 0, layouts: &layouts, starts: Starts::Near };
    let scene = sample(&request, &mut stream(seed, Purpose::Scene, 0)).expect("there are such scenes");
    let minds = MindParameters::of(kind).with_simulations(200);
    let settings = SimulationSettings { minds, ..SimulationSettings::default() };
    let event = phase_sim::simulate(&scene, 1, &settings).expect("a sound scene");
    let recording = Recording::of_event("event", event, "test".into(), serde_json::Value::Null);
    recording.observed().expect("a sound event").prefix(STEPS)
}

fn probability(inference: &Inference, kind: MindKind) -> f64 {
    inference.minds.iter().filter(|it| it.agents.minds.kind() == kind).map(|it| it.probability).sum()
}

/// Both kinds walk alike to a landmark that they see, so that a single start of an event may leave it open.
#[test]
fn events_are_attributed_to_the_minds_that_made_them() {
    let mut of_truth = Vec::new();
    for variant in [Variant::Carry, Variant::Places] {
        for (kind, seed) in MindKind::ALL.into_iter().flat_map(|kind| SEEDS.map(|seed| (kind, seed))) {
            let event = observed(variant, kind, seed);
            let inference = explain(&event, &UniformStrength, 1, &InferenceSettings::averaged());
            of_truth.push(probability(&inference.expect("is sound"), kind));
        }
    }
    let attributed = of_truth.iter().filter(|probability| **probability > 0.5).count();
    assert!(attributed as f64 >= ATTRIBUTED * of_truth.len() as f64, "{of_truth:?}");
    let log_odds: f64 = of_truth.iter().map(|probability| (probability / (1.0 - probability)).ln()).sum();
    assert!(log_odds > ODDS.ln(), "{of_truth:?}");
}

/// By the law of total probability, P(Y) = Σ P(kind) P(Y | kind).
#[test]
fn the_answer_is_the_average_over_kinds() {
    let event = observed(Variant::Places, MindKind::Phase, SEEDS[0]).prefix(8);
    let settings = InferenceSettings::averaged();
    let inference = explain(&event, &UniformStrength, 1, &settings).expect("is sound");
    let sum: f64 = inference.minds.iter().map(|kind| kind.probability).sum();
    assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    for (hypothesis, weight) in &inference.posterior.hypotheses {
        let mean: f64 = inference
            .minds
            .iter()
            .map(|kind| {
                let weighted = kind.posterior.hypotheses.iter();
                let own: f64 = weighted.filter(|(it, _)| it == hypothesis).map(|(_, weight)| weight).sum();
                kind.probability * own
            })
            .sum();
        assert!((mean - weight).abs() < 1e-9, "{mean} {weight}");
    }
}

/// These settings of inverse planning, if every decision is looked at.
fn looking_at_all(settings: InferenceSettings) -> InferenceSettings {
    let Algorithm::InversePlanning(planning) = settings.algorithm else { panic!("not inverse planning") };
    let planning = InversePlanningSettings { tolerated_change: 0.0, ..planning };
    InferenceSettings { algorithm: Algorithm::InversePlanning(planning), ..settings }
}

/// An inference with one kind of minds is that kind's part of the average.
#[test]
fn one_kind_alone_gives_its_part_of_the_average() {
    let event = observed(Variant::Carry, MindKind::Published, SEEDS[0]).prefix(8);
    let both = looking_at_all(InferenceSettings::averaged());
    let average = explain(&event, &UniformStrength, 1, &both).expect("is sound");
    let first = both.with_agents(both.agents);
    let second = both.alternative.expect("there are two kinds");
    let Algorithm::InversePlanning(planning) = both.algorithm else { panic!("not inverse planning") };
    let planning = InversePlanningSettings { lapse_rate: second.lapse_rate, ..planning };
    let second = InferenceSettings {
        algorithm: Algorithm::InversePlanning(planning),
        ..both.with_agents(second.agents)
    };
    for (kind, settings) in average.minds.iter().zip([first, second]) {
        let prepared = PreparedEvent::new(&event, settings.agents, 1);
        let cues = Cues { strengths: &UniformStrength, guide: None };
        let alone = infer(&prepared, &cues, 1, &settings, &mut || core::ops::ControlFlow::Continue(()));
        let alone = alone.expect("is sound").expect("nobody breaks it off");
        assert_eq!(alone.posterior, kind.posterior);
        assert_eq!(alone.minds[0].probability.to_bits(), 1.0_f64.to_bits());
    }
}

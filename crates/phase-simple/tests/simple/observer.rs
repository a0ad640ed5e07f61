//! An event watched row by row is understood as if it had been seen at once.

use core::ops::ControlFlow;
use phase_event::{ObservedEvent, Recording, from_json};
use phase_minds::MindParameters;
use phase_model::{
    AgentId, Body, Layout, MAX_ENTITIES, Vec2,
    random::{Purpose, stream},
};
use phase_sampler::{Request, Starts, Variant, sample};
use phase_sim::SimulationSettings;
use phase_simple::{
    AlternativeAgents, Budget, ChainSettings, Cues, Guidance, Guide, ImaginedAgents, Inference,
    InferenceSettings, IntentNetwork, InverseDynamics, MotionTracker, Observer, ObserverError, PreparedEvent,
    UniformStrength, Update, infer,
};
use std::{fs, path::Path, sync::Arc};

/// Rows after which the answers are compared.
const COMPARED: usize = 7;

/// The start of an event of a variant.
fn observed(variant: Variant, steps: usize) -> ObservedEvent {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let request = Request { variant, goal_index: 0, layouts: &layouts, starts: Starts::Near };
    let scene = sample(&request, &mut stream(5, Purpose::Scene, 0)).expect("there are such scenes");
    let minds = MindParameters::default().with_simulations(100);
    let settings = SimulationSettings { minds, ..SimulationSettings::default() };
    let event = phase_sim::simulate(&scene, 1, &settings).expect("a sound scene");
    let recording = Recording::of_event("event", event, "test".into(), serde_json::Value::Null);
    recording.observed().expect("a sound event").prefix(steps)
}

/// SIMPLE's settings with less search.
fn settings() -> InferenceSettings {
    let averaged = InferenceSettings::averaged_over_knowledge();
    let cheap = |agents: ImaginedAgents| {
        let minds = agents.minds.with_particles(5).with_simulations(10).searching_once();
        agents.with_minds(minds)
    };
    let alternative = averaged.alternative.map(|it| AlternativeAgents { agents: cheap(it.agents), ..it });
    InferenceSettings { agents: cheap(averaged.agents), alternative, ..averaged }
}

fn at_once(observed: &ObservedEvent, guide: Option<Guide>) -> Inference {
    let settings = settings();
    let prepared = PreparedEvent::new(observed, settings.agents, 3);
    let cues = Cues { strengths: &UniformStrength, guide };
    let inference = infer(&prepared, &cues, 3, &settings, &mut || ControlFlow::Continue(()));
    inference.expect("sound parameters").expect("nobody breaks it off")
}

#[test]
fn every_answer_is_that_of_the_rows_seen_so_far() {
    let network = Arc::new(IntentNetwork::bundled().expect("a sound file"));
    let guide = Guide { network: Arc::clone(&network), guidance: Guidance::default() };
    for (variant, guide) in
        [(Variant::Places, None), (Variant::Carry, Some(guide.clone())), (Variant::Block, Some(guide))]
    {
        let whole = observed(variant, 45);
        let mut observer =
            Observer::new(&whole.prefix(0), guide.as_ref(), 3, &settings()).expect("inverse planning");
        for (step, row) in whole.rows().iter().enumerate().skip(1) {
            observer.push(*row).expect("a sound row");
            if step % COMPARED != 0 && step != whole.steps() {
                continue;
            }
            let tick = &mut || ControlFlow::Continue(());
            let inference =
                observer.inference(tick).expect("sound parameters").expect("nobody breaks it off");
            let expected = at_once(&whole.prefix(step), guide.clone());
            assert_eq!(inference, expected, "{variant:?} after {step} steps");
        }
    }
}

/// Nothing is known of minds that cannot be simulated, so the guide answers; with more effort the answer
/// comes nearer to the whole.
#[test]
fn what_there_is_no_time_for_is_left_to_the_guide() {
    let network = Arc::new(IntentNetwork::bundled().expect("a sound file"));
    let guide = Guide { network: Arc::clone(&network), guidance: Guidance::default() };
    let whole = observed(Variant::Carry, 30);
    let settings = settings();
    let distance = |decisions: usize| {
        let mut observer =
            Observer::new(&whole.prefix(0), Some(&guide), 3, &settings).expect("inverse planning");
        observer.set_budget(Budget { decisions: Some(decisions) });
        let mut last = None;
        for row in &whole.rows()[1..] {
            last = Some(observer.push(*row).expect("a sound row").posterior);
        }
        let expected = at_once(&whole, Some(guide.clone())).posterior;
        let said = last.expect("there are rows");
        if decisions == 0 {
            let alone = network.posterior(&whole);
            for agent in AgentId::ALL {
                for ((goal, p), (expected, of_network)) in said.goals(agent).iter().zip(alone.goals(agent)) {
                    assert_eq!(*goal, expected);
                    assert!((p - of_network).abs() < 1e-9);
                }
            }
        }
        let mut distance = 0.0;
        for (hypothesis, weight) in &expected.hypotheses {
            let found = said.hypotheses.iter().find(|it| it.0 == *hypothesis).map_or(0.0, |it| it.1);
            distance += 0.5 * (weight - found).abs();
        }
        distance
    };
    let nothing = distance(0);
    let plenty = distance(100_000);
    assert!(nothing > 1e-3, "the guide alone is right: {nothing}");
    assert!(plenty < 1e-12, "{plenty}");
}

/// Conclusions about earlier steps are taken back, also in mirrored recordings.
#[test]
fn motion_is_explained_as_if_it_had_been_seen_at_once() {
    let mut events = vec![observed(Variant::Carry, 60), observed(Variant::Block, 60)];
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/real-phase/dev.json");
    if path.is_file() {
        let recordings = from_json(&fs::read_to_string(&path).expect("a text")).expect("the recordings");
        let recordings =
            recordings.iter().step_by(9).map(|it| it.observed().expect("a sound event").prefix(60));
        events.extend(recordings);
    } else {
        println!("skipped: the published recordings are not at hand");
    }
    for event in events {
        let mut watched = event.prefix(0);
        let mut tracker = MotionTracker::new(&watched);
        for (step, row) in event.rows().iter().enumerate().skip(1) {
            let before = tracker.motion().states.clone();
            watched.push(*row).expect("a sound row");
            let unchanged = tracker.push(&watched).expect("a sound row");
            assert_eq!(before[..unchanged], tracker.motion().states[..unchanged]);
            if step % COMPARED == 0 || step == event.steps() {
                let motion = tracker.motion();
                let expected = InverseDynamics::new(&watched);
                assert_eq!(motion.states, expected.states, "{step}");
                assert_eq!(motion.actions, expected.actions, "{step}");
                assert_eq!(motion.log_strengths, expected.log_strengths, "{step}");
                assert_eq!(motion.alternatives_in(step - 1), expected.alternatives_in(step - 1), "{step}");
            }
        }
    }
}

#[test]
fn what_cannot_be_watched_is_refused() {
    let event = observed(Variant::Places, 3);
    let chains = InferenceSettings::chains(ChainSettings::resynchronised(Update::Initial));
    assert!(matches!(Observer::new(&event, None, 1, &chains), Err(ObserverError::Chains)));

    let mut observer = Observer::new(&event, None, 3, &settings()).expect("inverse planning");
    let broken = [Body::at_rest(Vec2::new(f32::NAN, 1.0), 0.0); MAX_ENTITIES];
    assert!(matches!(observer.push(broken), Err(ObserverError::Row(_))));
    assert_eq!(observer.observed(), &event);
    let again = observer.push(event.rows()[3]).expect("a sound row");
    let mut longer = event.clone();
    longer.push(event.rows()[3]).expect("a sound row");
    assert_eq!(again, at_once(&longer, None));
}

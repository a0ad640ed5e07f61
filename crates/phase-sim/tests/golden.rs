//! Whole events are pinned bit for bit: scene, actions, explanations and every substep.

use phase_event::Event;
use phase_golden::{Digest, Golden};
use phase_model::{
    Awareness, EventKind, Intent, Layout, Level, Scene,
    random::{Purpose, stream},
};
use phase_sampler::{About, Contrast, ContrastRequest, Stance, Starts};
use phase_sim::{SimulationSettings, simulate};

/// Seed of the scenes and of the events.
const SEED: u64 = 2021;
/// Stands for the landmark of a goal without one.
const NO_LANDMARK: u64 = u64::MAX;

fn scene(kind: EventKind) -> Scene {
    let mut random = stream(SEED, Purpose::Scene, kind as u64);
    phase_sampler::sample_kind(kind, &mut random).expect("a scene of every kind")
}

fn digest(event: &Event) -> String {
    let physics = event.scene.physics();
    let mut digest = Digest::new();
    digest.state(&physics, &event.initial);
    for step in &event.steps {
        for (action, thought) in step.actions.iter().zip(&step.thoughts) {
            digest.integer(action.index() as u64);
            digest.text(&thought.subgoal.to_string());
            for proposed in &thought.subgoals {
                digest.text(&proposed.subgoal.to_string());
                digest.double(proposed.value);
                digest.integer(proposed.particles as u64);
            }
            for subgoal in &thought.plan {
                digest.text(&subgoal.to_string());
            }
            for supposed in &thought.intents {
                let Intent { attitude, goal } = supposed.intent;
                digest.double(f64::from(attitude.alpha()));
                digest.double(f64::from(goal.sign().value()));
                digest.integer(goal.subject().index() as u64);
                digest.integer(goal.landmark().map_or(NO_LANDMARK, |it| it.index() as u64));
                digest.integer(supposed.particles as u64);
            }
            if let Some(suspicion) = thought.suspicion {
                digest.double(suspicion);
            }
            for searched in &thought.actions {
                digest.integer(searched.action.index() as u64);
                digest.integer(u64::from(searched.visits));
                digest.double(searched.value);
            }
        }
        for substep in &step.substeps {
            digest.state(&physics, substep);
        }
    }
    digest.hex()
}

fn check(name: &str, events: Vec<(String, Scene, SimulationSettings)>) -> Result<(), String> {
    let run = |(name, scene, settings): (String, Scene, SimulationSettings)| {
        (name, simulate(&scene, SEED, &settings))
    };
    let events: Vec<_> = if cfg!(target_family = "wasm") {
        // There are no threads.
        events.into_iter().map(run).collect()
    } else {
        // One event per thread: the result depends on the seed alone.
        std::thread::scope(|scope| {
            let threads: Vec<_> = events.into_iter().map(|it| scope.spawn(|| run(it))).collect();
            threads.into_iter().map(|thread| thread.join().expect("no panic")).collect()
        })
    };
    let mut golden = Golden::new(env!("CARGO_MANIFEST_DIR"), name);
    for (name, event) in events {
        let event = event.map_err(|error| error.to_string())?;
        golden.add(format!("{name}-steps"), event.steps.len().to_string());
        golden.add(name, digest(&event));
    }
    golden.check()
}

#[test]
fn golden_events_of_every_kind_are_unchanged() -> Result<(), String> {
    let event = |kind: EventKind| (kind.name().to_owned(), scene(kind), SimulationSettings::default());
    check("events", EventKind::ALL.map(event).into())
}

#[test]
fn golden_event_of_few_simulations_is_unchanged() -> Result<(), String> {
    let mut settings = SimulationSettings::default();
    settings.minds = settings.minds.with_simulations(50);
    let kind = EventKind::Hindering;
    check("event-50-simulations", vec![(kind.name().to_owned(), scene(kind), settings)])
}

#[test]
fn golden_events_of_minds_that_find_out_are_unchanged() -> Result<(), String> {
    let event = |kind: EventKind, level: Level| {
        let mut scene = scene(kind);
        scene.agents.iter_mut().for_each(|agent| agent.awareness = Awareness::ignorant(level));
        (format!("{}-level-{}", kind.name(), u8::from(level)), scene, SimulationSettings::default())
    };
    let [one, two] = [Level::One, Level::Two];
    let social = [(EventKind::Helping, one), (EventKind::Hindering, one), (EventKind::Hindering, two)];
    check("events-unknown-goals", social.map(|(kind, level)| event(kind, level)).into())
}

#[test]
fn golden_pair_of_beliefs_is_unchanged() -> Result<(), String> {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let stances = [Stance::Unaware, Stance::Told];
    let (about, starts, goal_index) = (About::Object, Starts::Near, 0);
    let request = ContrastRequest { stances: &stances, about, goal_index, layouts: &layouts, starts };
    let pair = Contrast::sample(&request, &mut stream(SEED, Purpose::Scene, 0));
    let scenes = pair.map_err(|error| error.to_string())?.scenes;
    let names = ["false-belief", "true-belief"];
    let event = |(name, scene): (&str, Scene)| (name.to_owned(), scene, SimulationSettings::default());
    check("pair-of-beliefs", names.into_iter().zip(scenes).map(event).collect())
}

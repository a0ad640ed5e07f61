//! Whole events are pinned bit for bit: scene, actions, explanations and every substep.

use phase_event::Event;
use phase_golden::{Digest, Golden};
use phase_model::{
    EventKind, Scene,
    random::{Purpose, stream},
};
use phase_sim::{SimulationSettings, simulate};

/// Seed of the scenes and of the events.
const SEED: u64 = 2021;

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

fn check(name: &str, events: &[(EventKind, SimulationSettings)]) -> Result<(), String> {
    let run =
        |(kind, settings): &(EventKind, SimulationSettings)| (*kind, simulate(&scene(*kind), SEED, settings));
    let events: Vec<_> = if cfg!(target_family = "wasm") {
        // There are no threads.
        events.iter().map(run).collect()
    } else {
        // One event per thread: the result depends on the seed alone.
        std::thread::scope(|scope| {
            let threads: Vec<_> = events.iter().map(|it| scope.spawn(|| run(it))).collect();
            threads.into_iter().map(|thread| thread.join().expect("no panic")).collect()
        })
    };
    let mut golden = Golden::new(env!("CARGO_MANIFEST_DIR"), name);
    for (kind, event) in events {
        let event = event.map_err(|error| error.to_string())?;
        golden.add(format!("{}-steps", kind.name()), event.steps.len().to_string());
        golden.add(kind.name(), digest(&event));
    }
    golden.check()
}

#[test]
fn golden_events_of_every_kind_are_unchanged() -> Result<(), String> {
    check("events", &EventKind::ALL.map(|kind| (kind, SimulationSettings::default())))
}

#[test]
fn golden_event_of_few_simulations_is_unchanged() -> Result<(), String> {
    let mut settings = SimulationSettings::default();
    settings.minds = settings.minds.with_simulations(50);
    check("event-50-simulations", &[(EventKind::Hindering, settings)])
}

//! Inverse dynamics, and all of SIMPLE beside it. Inverse dynamics of whole events: six simulated ones, one
//! of each kind, and the recordings of the file `PHASE_EVENTS`.

use core::{hint::black_box, ops::ControlFlow, time::Duration};
use criterion::{Criterion, SamplingMode};
use phase_dataset::phase_events;
use phase_event::{ObservedEvent, Recording};
use phase_minds::MindParameters;
use phase_model::{
    EventKind,
    random::{Purpose, stream},
};
use phase_sim::SimulationSettings;
use phase_simple::{ForecastSettings, MotionTracker, Simple, futures};
use std::{path::Path, time::Instant};

/// Of the recordings, every so many are explained.
const THINNED: usize = 5;
/// Of these, every so many are understood by SIMPLE.
const UNDERSTOOD: usize = 5;
/// Steps that are watched, and as many are foreseen.
const WATCHED: usize = 20;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    bench(&mut criterion, "inverse dynamics/generated", &EventKind::ALL.map(simulated));
    if let Some(path) = std::env::var_os("PHASE_EVENTS") {
        match recorded(Path::new(&path)) {
            Ok(events) => {
                bench(&mut criterion, "inverse dynamics/recordings", &events);
                bench_simple(&mut criterion, &events);
            }
            Err(error) => {
                eprintln!("error: {error}");
                std::process::exit(2);
            }
        }
    }
    criterion.final_summary();
}

/// An event of a kind, by minds that search little.
fn simulated(kind: EventKind) -> ObservedEvent {
    let scene =
        phase_sampler::sample_kind(kind, &mut stream(1, Purpose::Scene, 0)).expect("a scene of every kind");
    let minds = MindParameters::default().with_simulations(100);
    let settings = SimulationSettings { minds, ..SimulationSettings::default() };
    let event = phase_sim::simulate(&scene, 1, &settings).expect("a sound scene");
    let recording = Recording::of_event("event", event, "bench".into(), serde_json::Value::Null);
    recording.observed().expect("a sound event")
}

fn recorded(path: &Path) -> Result<Vec<ObservedEvent>, phase_files::FileError> {
    let recordings = phase_events::read(path)?;
    Ok(recordings.iter().step_by(THINNED).filter_map(|recording| recording.observed().ok()).collect())
}

fn bench(criterion: &mut Criterion, name: &str, events: &[ObservedEvent]) {
    let steps: usize = events.iter().map(ObservedEvent::steps).sum();
    println!("{name}: {} events, {steps} steps", events.len());
    let mut group = criterion.benchmark_group(name);
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group.bench_function("explained", |bencher| {
        bencher.iter(|| -> usize {
            let explained = |event| MotionTracker::new(event).into_motion().residuals.len();
            black_box(events).iter().map(explained).sum()
        });
    });
    group.finish();
}

/// Goals of whole events, futures after their first seconds, and goals after every row as it is watched; and
/// the time of single rows.
fn bench_simple(criterion: &mut Criterion, events: &[ObservedEvent]) {
    let simple = Simple::bundled().expect("sound files");
    let tick = &mut || ControlFlow::Continue(());
    let mut understand = |event: &ObservedEvent, ahead: usize| {
        let prepared = simple.prepare(event, 1);
        let inference = simple.infer(&prepared, 1, tick).expect("sound parameters");
        let inference = inference.expect("nobody breaks it off");
        if ahead > 0 {
            let forecast = ForecastSettings::default();
            black_box(futures(&prepared, &inference, ahead, 1, &forecast, tick).expect("sound parameters"));
        }
        black_box(inference);
    };
    let mut took = watch(&simple, &events.iter().collect::<Vec<_>>());
    took.sort();
    let mean = took.iter().sum::<Duration>() / took.len().max(1) as u32;
    let part = |share: f64| took.get((share * took.len() as f64) as usize).copied().unwrap_or_default();
    println!("SIMPLE/a row: mean {mean:?}, median {:?}, 99th percentile {:?}", part(0.5), part(0.99));
    let mut group = criterion.benchmark_group("SIMPLE/recordings");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    for (name, watched, ahead) in [("goals", usize::MAX, 0), ("futures", WATCHED, WATCHED)] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                for event in events.iter().step_by(UNDERSTOOD) {
                    understand(&event.prefix(watched.min(event.steps())), ahead);
                }
            });
        });
    }
    let watched: Vec<&ObservedEvent> = events.iter().step_by(UNDERSTOOD).collect();
    group.bench_function("rows", |bencher| bencher.iter(|| watch(&simple, &watched)));
    group.finish();
}

/// The time that every row of some events takes an observer.
fn watch(simple: &Simple, events: &[&ObservedEvent]) -> Vec<Duration> {
    let mut took = Vec::new();
    for event in events {
        let mut observer = simple.observer(&event.prefix(0), 1).expect("inverse planning");
        for row in &event.rows()[1..] {
            let begun = Instant::now();
            black_box(observer.push(*row).expect("a sound row"));
            took.push(begun.elapsed());
        }
    }
    took
}

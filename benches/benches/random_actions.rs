//! One step of the forward model under random actions, averaged over many lively states.

use core::hint::black_box;
use criterion::Criterion;
use phase_dataset::phase_events;
use phase_forward::Forward;
use phase_model::{
    Action, Dynamics, EventKind, State,
    random::{Pcg64Mcg, Purpose, stream},
};
use phase_world::World;
use rand::RngExt;
use std::path::Path;

/// Scenes of each kind, steps of each that give a state, and steps for which its actions are held.
const SCENES: u64 = 3;
const STEPS: usize = 40;
const HELD: usize = 4;
/// Steps from each state of a recording.
const AHEAD: usize = 10;

type Actions = [Action; 2];
type Step = fn(&Forward, &mut State, Actions);

/// An initial state, with the dynamics of its scene and the actions to come.
struct Start<'a> {
    forward: &'a Forward,
    state: State,
    actions: Vec<Actions>,
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut random = stream(1, Purpose::Search, 0);
    let played: Vec<(Forward, Vec<State>)> = EventKind::ALL
        .into_iter()
        .flat_map(|kind| (0..SCENES).map(move |index| (kind, index)))
        .map(|(kind, index)| play(kind, index, &mut random))
        .collect();
    bench(&mut criterion, "forward/random actions/five-substep step, average", &played, 1, &mut random);
    if let Some(path) = std::env::var_os("PHASE_EVENTS") {
        match recorded(Path::new(&path)) {
            Ok(rows) => bench(&mut criterion, "forward/random actions/recordings", &rows, AHEAD, &mut random),
            Err(error) => {
                eprintln!("error: {error}");
                std::process::exit(2);
            }
        }
    }
    criterion.final_summary();
}

/// The states of a scene after each step of random held actions in the reference world.
fn play(kind: EventKind, index: u64, random: &mut Pcg64Mcg) -> (Forward, Vec<State>) {
    let scene = phase_sampler::sample_kind(kind, &mut stream(1, Purpose::Scene, index))
        .expect("a scene of every kind");
    let physics = scene.physics();
    let mut world = World::new(&physics, &scene.initial_state());
    let mut actions = draw(random);
    let mut step = |k: usize| {
        if k.is_multiple_of(HELD) {
            actions = draw(random);
        }
        let [.., after] = world.step(actions);
        after
    };
    (Forward::new(&physics), (0..STEPS).map(&mut step).collect())
}

/// The states of all rows of all recordings of a file.
fn recorded(path: &Path) -> Result<Vec<(Forward, Vec<State>)>, phase_files::FileError> {
    let recordings = phase_events::read(path)?;
    let rows = |recording: &phase_event::Recording| {
        let trajectory = &recording.trajectory;
        let states = (0..=trajectory.steps()).filter_map(|t| trajectory.state(t)).collect();
        (Forward::new(&recording.scene.physics()), states)
    };
    Ok(recordings.iter().map(rows).collect())
}

/// Measures steps one by one, cycling through all initial states.
fn bench(
    criterion: &mut Criterion,
    name: &str,
    scenes: &[(Forward, Vec<State>)],
    ahead: usize,
    random: &mut Pcg64Mcg,
) {
    let all = scenes.iter().flat_map(|(forward, states)| states.iter().map(move |&state| (forward, state)));
    let starts: Vec<Start<'_>> = all
        .map(|(forward, state)| Start { forward, state, actions: (0..ahead).map(|_| draw(random)).collect() })
        .collect();
    let steps: [(&str, Step); 2] = [("exact", Forward::step), ("coarse", Forward::step_approximate)];
    for (how, step) in steps {
        criterion.bench_function(&format!("{name}, {how}"), |bencher| {
            bencher.iter_custom(|iterations| {
                let mut steps = starts.iter().cycle().flat_map(|start| {
                    let mut state = start.state;
                    start.actions.iter().map(move |&actions| {
                        step(start.forward, &mut state, black_box(actions));
                        black_box(&state);
                    })
                });
                let begun = std::time::Instant::now();
                for _ in 0..iterations {
                    steps.next();
                }
                begun.elapsed()
            });
        });
    }
}

/// A uniformly sampled action of each agent.
fn draw(random: &mut Pcg64Mcg) -> Actions {
    [0, 1].map(|_| Action::ALL[random.random_range(0..Action::ALL.len())])
}

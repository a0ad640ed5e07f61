//! Four steps of the reference world and of the forward model, exact and coarse: free, pushing an object,
//! carrying it.

use core::hint::black_box;
use criterion::Criterion;
use phase_forward::Forward;
use phase_model::{Action, Body, Dynamics, PhysicsConfig, State, Vec2, physics::AgentBody};
use phase_world::World;

/// Two strong agents, the first below a small object; walls as in layout 7.
fn scene(gap: f32) -> (PhysicsConfig, State) {
    let layout = phase_model::Layout::new(7, None).expect("layout 7 exists");
    let agent = AgentBody { radius: 0.8, max_force: 450.0 };
    let physics = PhysicsConfig {
        walls: layout.walls(),
        agents: [agent; 2],
        object_radii: [0.8, 0.0],
        object_count: 1,
    };
    let at = |x, y| Body::at_rest(Vec2::new(x, y), 0.0);
    let state = State::new([at(20.0, 6.0), at(10.0, 18.0), at(20.0, 7.6 + gap), Body::default()]);
    (physics, state)
}

/// The first agent's action in each case, and the distance of the object (u).
const CASES: [(&str, f32, &[Action]); 3] = [
    ("free", 8.0, &[Action::Up, Action::Up, Action::TurnLeft, Action::Up]),
    ("contact", 0.02, &[Action::Up, Action::Up, Action::Up, Action::Up]),
    ("carrying", 0.05, &[Action::Attach, Action::Up, Action::Left, Action::Up]),
];

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    for (name, gap, actions) in CASES {
        let (physics, start) = scene(gap);
        let forward = Forward::new(&physics);
        criterion.bench_function(&format!("forward/four steps/{name}"), |bencher| {
            bencher.iter(|| {
                let mut state = black_box(start);
                for &action in actions {
                    forward.step(&mut state, [action, Action::NoForce]);
                }
                state
            });
        });
        criterion.bench_function(&format!("forward, coarse/four steps/{name}"), |bencher| {
            bencher.iter(|| {
                let mut state = black_box(start);
                for &action in actions {
                    forward.step_approximate(&mut state, [action, Action::NoForce]);
                }
                state
            });
        });
        criterion.bench_function(&format!("world/four steps/{name}"), |bencher| {
            bencher.iter_batched(
                || World::new(&physics, &start),
                |mut world| {
                    for &action in actions {
                        black_box(world.step([action, Action::NoForce]));
                    }
                },
                criterion::BatchSize::SmallInput,
            );
        });
    }
    let (physics, start) = scene(0.05);
    criterion.bench_function("state/copy", |bencher| bencher.iter(|| black_box(start)));
    criterion.bench_function("world/new", |bencher| bencher.iter(|| World::new(&physics, &start)));
    criterion.final_summary();
}

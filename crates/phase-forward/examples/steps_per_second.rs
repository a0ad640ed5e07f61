//! Times steps of the kernel: free motion, pushing, carrying, and random actions in all layouts.

use phase_forward::Forward;
use phase_model::{
    Action, AgentBody, Body, Dynamics, Grip, Layout, ObjectId, PhysicsConfig, Side, Size, State, Strength,
    Vec2, arena::START_POINTS,
};
use std::time::Instant;

/// Steps between resets to the start state.
const EPISODE: usize = 60;

fn main() {
    let steps: usize = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(2_000_000);
    let agent =
        |size: Size, strength: Strength| AgentBody { radius: size.radius(), max_force: strength.max_force() };
    let open = PhysicsConfig {
        walls: Vec::new(),
        agents: [agent(Size::Small, Strength::Strong), agent(Size::Large, Strength::Mighty)],
        object_radii: [0.8, 1.2],
        object_count: 2,
    };
    let at = |places: [(f32, f32); 4]| State::new(places.map(|(x, y)| Body::at_rest(Vec2::new(x, y), 0.0)));
    let excluded_pairs = at([(10.0, 6.0), (22.0, 15.0), (22.0, 6.0), (10.0, 18.0)]);
    let near = at([(10.0, 8.0), (20.0, 8.0), (10.0, 9.65), (20.0, 10.45)]);
    let mut held = near;
    held.bodies[2].position.y = 9.6;
    held.bodies[3].position.y = 10.4;
    for (k, grip) in held.grips.iter_mut().enumerate() {
        *grip =
            Some(Grip { object: ObjectId::ALL[usize::from(k as u8)], side: Side::Head, relative_angle: 0.0 });
    }
    let forward = Forward::new(&open);
    let turns = [Action::Up, Action::Down, Action::TurnLeft, Action::TurnRight];
    report(
        "free, pushing to and fro",
        steps,
        |k| (&forward, excluded_pairs, k % 4 == 0),
        |k| [turns[k / 2 % 2]; 2],
    );
    report("free, turning", steps, |k| (&forward, excluded_pairs, k % 4 == 0), |k| [turns[2 + k / 2 % 2]; 2]);
    report("pushing two objects", steps, |k| (&forward, near, k % 8 == 0), |_| [Action::Up; 2]);
    report("carrying two objects", steps, |k| (&forward, held, k % 8 == 0), |k| [turns[k / 4 % 4]; 2]);

    let mut dice = SmallRng(1);
    let scenes: Vec<(Forward, State)> = Layout::all_used()
        .flat_map(|layout| [layout; 4])
        .map(|layout| {
            let mut size = || Size::ALL[dice.roll(4)];
            let sizes = [size(), size(), size(), size()];
            let physics = PhysicsConfig {
                walls: layout.walls(),
                agents: [0, 1].map(|k| agent(sizes[k], Strength::ALL[dice.roll(4)])),
                object_radii: [sizes[2].radius(), sizes[3].radius()],
                object_count: 2,
            };
            let mut places: Vec<Vec2> = START_POINTS.into_iter().flatten().collect();
            let bodies = [0, 1, 2, 3].map(|_| {
                let place = places.swap_remove(dice.roll(places.len()));
                Body::at_rest(place, dice.roll(628) as f32 / 100.0)
            });
            (Forward::new(&physics), State::new(bodies))
        })
        .collect();
    let mut actions = SmallRng(7);
    report(
        "random actions",
        steps,
        |k| {
            let (forward, state) = &scenes[k / EPISODE % scenes.len()];
            (forward, *state, k % EPISODE == 0)
        },
        |_| [Action::ALL[actions.roll(14)], Action::ALL[actions.roll(14)]],
    );
    let mut actions = SmallRng(7);
    report(
        "held random actions",
        steps,
        |k| {
            let (forward, state) = &scenes[k / EPISODE % scenes.len()];
            (forward, *state, k % EPISODE == 0)
        },
        |k| {
            let mut held = SmallRng(actions.0 ^ (k / 6) as u64);
            [Action::ALL[held.roll(14)], Action::ALL[held.roll(14)]]
        },
    );
    actions.roll(2);
}

/// Times steps. `scene` returns the kernel and start state for a step, and whether to restart from it.
fn report<'a>(
    name: &str,
    steps: usize,
    scene: impl Fn(usize) -> (&'a Forward, State, bool),
    mut actions: impl FnMut(usize) -> [Action; 2],
) {
    if std::env::args().nth(2).is_some_and(|only| !name.starts_with(&only)) {
        return;
    }
    let mut state = scene(0).1;
    let (start, start_busy) = (Instant::now(), active());
    for k in 0..steps {
        let (forward, fresh, restart) = scene(k);
        if restart {
            state = fresh;
        }
        forward.step(&mut state, actions(k));
    }
    let per_step = |nanoseconds: u128| nanoseconds as f64 / steps as f64;
    let elapsed = per_step(start.elapsed().as_nanos());
    let spent = active().zip(start_busy).map_or(f64::NAN, |(end, start)| per_step(end - start));
    println!(
        "{name}: {spent:.0} ns a step on the processor, {elapsed:.0} by the clock (ends at {:?})",
        state.bodies[0].position
    );
}

/// CPU time of this process (ns), where the system reports it.
fn active() -> Option<u128> {
    let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok()
}

/// A small pseudorandom number generator.
struct SmallRng(u64);

impl SmallRng {
    fn roll(&mut self, sides: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut word = self.0;
        word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((word ^ (word >> 31)) % sides as u64) as usize
    }
}

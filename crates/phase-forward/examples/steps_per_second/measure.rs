//! Steps of all engines from the same states, by the same actions.

use crate::starts::Starts;
use core::hint::black_box;
use phase_forward::Forward;
use phase_model::{
    AGENT_COUNT, Action, Dynamics, State,
    random::{Pcg64Mcg, Purpose, stream},
};
use phase_world::World;
use rand::RngExt;
use std::time::Instant;

/// Worlds that begin in each state.
const WORLDS: usize = 8;
/// Steps of each.
const STEPS: usize = 10;
/// Each engine is measured as often, and the fastest time counts.
const ROUNDS: usize = 3;

/// Steps a second.
pub(crate) struct Rates {
    /// The kernel's exact steps.
    pub(crate) exact: f64,
    /// The kernel's coarse steps.
    pub(crate) coarse: f64,
    /// Steps of the reference world.
    pub(crate) rapier: f64,
    /// The states from which they were made.
    pub(crate) states: usize,
}

impl Rates {
    pub(crate) fn to_json(&self) -> serde_json::Value {
        serde_json::json!({
            "exact": self.exact,
            "coarse": self.coarse,
            "rapier": self.rapier,
            "states": self.states,
        })
    }
}

type Joint = [Action; AGENT_COUNT];
type Step = fn(&Forward, &mut State, Joint);

/// Measures all engines.
pub(crate) fn measure(starts: &[Starts]) -> Rates {
    Rates {
        exact: kernel(starts, Forward::step),
        coarse: kernel(starts, Forward::step_approximate),
        rapier: rapier(starts),
        states: starts.iter().map(|starts| starts.states.len()).sum(),
    }
}

fn kernel(starts: &[Starts], step: Step) -> f64 {
    let forwards: Vec<Forward> = starts.iter().map(|starts| Forward::new(&starts.physics)).collect();
    fastest(|random| {
        for (starts, forward) in starts.iter().zip(&forwards) {
            for state in &starts.states {
                let mut worlds = [*state; WORLDS];
                for _ in 0..STEPS {
                    for (world, actions) in black_box(&mut worlds).iter_mut().zip(draw(random)) {
                        step(forward, world, actions);
                    }
                }
            }
        }
        starts.iter().map(|starts| starts.states.len() * WORLDS * STEPS).sum()
    })
}

fn rapier(starts: &[Starts]) -> f64 {
    fastest(|random| {
        let mut steps = 0;
        for starts in starts {
            // A world is made for each state, which is counted among its ten steps; so fewer states are
            // enough.
            for state in starts.states.iter().step_by(4) {
                let mut world = World::new(&starts.physics, state);
                for _ in 0..STEPS {
                    black_box(world.step(draw(random)[0]));
                    steps += 1;
                }
            }
        }
        steps
    })
}

/// The greatest number of steps a second over several rounds of something that returns how many it made.
fn fastest(mut run: impl FnMut(&mut Pcg64Mcg) -> usize) -> f64 {
    let mut most = 0.0_f64;
    for _ in 0..ROUNDS {
        let mut random = stream(1, Purpose::Search, 0);
        let (begun, busy) = (Instant::now(), active());
        let steps = run(&mut random) as f64;
        let seconds = active().zip(busy).map_or(begun.elapsed().as_secs_f64(), |(end, start)| end - start);
        most = most.max(steps / seconds);
    }
    most
}

/// Uniformly sampled actions of both agents in each world.
fn draw(random: &mut Pcg64Mcg) -> [Joint; WORLDS] {
    [(); WORLDS].map(|()| [(); AGENT_COUNT].map(|()| Action::ALL[random.random_range(0..Action::ALL.len())]))
}

/// Processor time of this process (s), where the system reports it.
fn active() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds * 1e-9)
}

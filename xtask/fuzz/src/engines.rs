//! Both engines in random scenes: energy from nowhere, overlaps, worlds rebuilt from their state, two agents
//! that meet.

mod energy;
mod meeting;
mod overlap;
mod rebuilt;
mod report;

pub use energy::{EnergyGains, GAIN, energy_gains};
pub use meeting::{Meetings, meetings};
pub use overlap::{Overlaps, overlap_beyond, overlaps};
pub use rebuilt::{Rebuilt, rebuilt};
pub use report::report;

use crate::scenes::{Doing, Start, actions, physique, start};
use phase_forward::{Forward, SolverCache};
use phase_model::{
    AGENT_COUNT, Action, PhysicsConfig, State,
    arena::SUBSTEPS,
    random::{Purpose, stream},
};
use phase_statistics::percentile;
use phase_world::World;

/// An engine, and how it is run.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// The reference world.
    World,
    /// The reference world with this many sweeps over the constraints of a substep.
    WorldWithPasses(usize),
    /// The kernel, every step from the state alone.
    Kernel,
    /// The kernel with what its solver remembers.
    KernelWithCache,
}

impl Kind {
    /// The engine in tables.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::World => "world".into(),
            Self::WorldWithPasses(passes) => format!("world, {passes} sweeps"),
            Self::Kernel => "kernel".into(),
            Self::KernelWithCache => "kernel with cache".into(),
        }
    }
}

/// An engine in the middle of a scene.
pub enum Running {
    /// The reference world.
    World(Box<World>),
    /// The kernel, a state and perhaps the solver's memory.
    Kernel(Box<Forward>, State, Option<Box<SolverCache>>),
}

impl Running {
    /// An engine at the start of a scene.
    #[must_use]
    pub fn new(kind: Kind, physics: &PhysicsConfig, start: &State) -> Self {
        match kind {
            Kind::World => Self::World(Box::new(World::new(physics, start))),
            Kind::WorldWithPasses(passes) => {
                Self::World(Box::new(World::new(physics, start).with_solver_passes(passes)))
            }
            Kind::Kernel => Self::Kernel(Box::new(Forward::new(physics)), *start, None),
            Kind::KernelWithCache => {
                let forward = Forward::new(physics);
                let cache = Box::new(forward.fresh_cache(start));
                Self::Kernel(Box::new(forward), *start, Some(cache))
            }
        }
    }

    /// The present state.
    #[must_use]
    pub fn state(&self) -> State {
        match self {
            Self::World(world) => world.state(),
            Self::Kernel(_, state, _) => *state,
        }
    }

    /// One step; the state after each substep.
    pub fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS] {
        match self {
            Self::World(world) => world.step(actions),
            Self::Kernel(forward, state, None) => forward.step_substeps(state, actions),
            Self::Kernel(forward, state, Some(cache)) => forward.step_warm(state, cache, actions),
        }
    }
}

/// The largest distance between the places of one body in two states (u).
pub(crate) fn apart(physics: &PhysicsConfig, a: &State, b: &State) -> f32 {
    physics.entities().map(|entity| a.position(entity).distance(b.position(entity))).fold(0.0, f32::max)
}

/// Random scenes that are run in an engine.
struct Scenes {
    kind: Kind,
    begins: Start,
    doing: Doing,
    /// Length of each (steps).
    steps: usize,
    /// The seeds of the scenes.
    seeds: core::ops::Range<u64>,
}

/// A substep of a scene.
struct Substep<'a> {
    physics: &'a PhysicsConfig,
    /// Number of its step in the scene, from 0.
    step: usize,
    /// Whether it is the first substep of the scene.
    is_first: bool,
    before: &'a State,
    after: &'a State,
}

impl Scenes {
    /// Runs the scenes one after another, and shows every substep.
    fn run(self, mut look: impl FnMut(Substep<'_>)) {
        for seed in self.seeds {
            let mut random = stream(seed, Purpose::Scene, 0);
            let physics = physique(&mut random);
            let Some(state) = start(&physics, self.begins, &mut random) else { continue };
            let mut engine = Running::new(self.kind, &physics, &state);
            let mut before = engine.state();
            for (step, actions) in actions(self.doing, self.steps, &mut random).into_iter().enumerate() {
                for (substep, after) in engine.step(actions).into_iter().enumerate() {
                    let is_first = step == 0 && substep == 0;
                    look(Substep { physics: &physics, step, is_first, before: &before, after: &after });
                    before = after;
                }
            }
        }
    }
}

/// Distances (u): median, nine in ten, 99 in 100, all; `None` if there are none.
pub type Quantiles = Option<[f32; 4]>;

fn quantiles(distances: &[f32]) -> Quantiles {
    let [a, b, c, d] = [50, 90, 99, 100].map(|hundredths| percentile(distances, hundredths));
    Some([a?, b?, c?, d?])
}

//! The interface that an engine implements to be compared with recordings.

use phase_model::{AGENT_COUNT, Action, PhysicsConfig, State, Vec2, arena::SUBSTEPS};

/// An engine in motion. An implementation is an adapter that holds the engine, its state and whatever it
/// remembers from step to step.
pub trait Engine: Sized {
    /// Whether a probe is replayed through the engine's own idle substep, or from the recorded state after it.
    /// An engine with a memory needs the former; for one without, the latter says all there is, and keeps what
    /// it makes of overlaps at the start out of the errors of everything else.
    const RUNS_IDLE_SUBSTEP: bool;

    /// Freshly set up in a state, grips included. This is also how a run is restarted.
    fn set_up(physics: &PhysicsConfig, state: &State) -> Self;

    /// One substep of 1/60 s in which nobody acts. The published simulator ran one before the first step.
    fn settle(&mut self);

    /// Gives a body (by [`phase_model::Entity::index`]) another velocity of its centre of mass (u/s). Only
    /// called between set-up and the first step.
    fn set_velocity(&mut self, body: usize, velocity: Vec2);

    /// The present state.
    fn state(&self) -> State;

    /// One step under both agents' actions: the states after its five substeps of 1/60 s.
    fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS];
}

//! The interface that an engine implements to be compared with recordings.

use phase_model::{AGENT_COUNT, Action, PhysicsConfig, State, Vec2, arena::SUBSTEPS};

/// A running engine. An implementation is an adapter that holds the engine, its state and its internal memory
/// from step to step.
pub trait Engine: Sized {
    /// Whether a probe is replayed through the engine's own idle substep, or from the recorded state after
    /// it. The former is needed for an engine with internal memory; for one without, the latter is sufficient
    /// and keeps its handling of overlaps at the start out of the errors of everything else.
    const RUNS_IDLE_SUBSTEP: bool;

    /// Newly set up in a state, grips included. This is also how a run is restarted.
    fn set_up(physics: &PhysicsConfig, state: &State) -> Self;

    /// One substep of 1/60 s without actions. The published simulator ran one before the first step.
    fn settle(&mut self);

    /// Sets the velocity of a body's centre of mass (u/s), the body being given by
    /// [`phase_model::Entity::index`]. Only called between set-up and the first step.
    fn set_velocity(&mut self, body: usize, velocity: Vec2);

    /// The present state.
    fn state(&self) -> State;

    /// One step under both agents' actions: the states after its five substeps of 1/60 s.
    fn step(&mut self, actions: [Action; AGENT_COUNT]) -> [State; SUBSTEPS];
}

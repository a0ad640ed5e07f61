//! The reference dynamics behind the planners' interface.

use crate::World;
use phase_model::{AGENT_COUNT, Action, Dynamics, PhysicsConfig, State};

/// [`Dynamics`] by the reference world: builds a [`World`] from the state, steps it once and reads the state
/// back.
///
/// Convenient wherever something takes `Dynamics`. It depends on the state alone, so a released object that
/// still overlaps its holder is pushed clear from the next step on, whereas [`World`] lets the two overlap by
/// up to [`RELEASED_OVERLAP`](phase_model::physics::RELEASED_OVERLAP).
///
/// The cost is that the engine's sets, graphs and trees are rebuilt for every step: 10 to 25 µs in addition
/// to the 60 to 200 µs of the five substeps. Loop over [`World::step`] where that matters.
#[derive(Clone, Debug)]
pub struct WorldDynamics {
    /// Walls, radii and forces.
    pub physics: PhysicsConfig,
}

impl Dynamics for WorldDynamics {
    fn step(&self, state: &mut State, actions: [Action; AGENT_COUNT]) {
        let states = World::new(&self.physics, state).step(actions);
        *state = states[states.len() - 1];
    }
}

//! The reference dynamics behind the planners' interface.

use crate::World;
use phase_model::{AGENT_COUNT, Action, Dynamics, PhysicsConfig, State};

/// [`Dynamics`] by the true world: builds a [`World`] from the state, steps it once and reads the state back.
///
/// Convenient wherever something takes `Dynamics`. It knows nothing but the state, so an object that was let
/// go and still overlaps its holder is solid at once and gets pushed clear, which [`World`] leaves be.
///
/// The price is that the engine's sets, graphs and trees are built anew for every step: 10 to 25 µs on top of
/// the 60 to 200 µs of the five substeps. Loop over [`World::step`] where that matters.
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

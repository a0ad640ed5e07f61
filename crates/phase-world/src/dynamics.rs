//! The true world behind the interface that planners use.

use crate::World;
use phase_model::{AGENT_COUNT, Action, Dynamics, Physique, State};

/// [`Dynamics`] by the true world: builds a [`World`] from the state, steps it once and reads the state back.
///
/// Convenient wherever something takes `Dynamics`, and exact as [`World`] itself up to pairs that were let go
/// and still overlap. The price is that the engine's sets, graphs and trees are built anew for every step,
/// some tens of microseconds on top of the five substeps; loop over [`World::step`] where that matters.
#[derive(Clone, Debug)]
pub struct WorldDynamics {
    /// Walls, radii and forces.
    pub physique: Physique,
}

impl Dynamics for WorldDynamics {
    fn step(&self, state: &mut State, actions: [Action; AGENT_COUNT]) {
        let states = World::new(&self.physique, state).step(actions);
        *state = states[states.len() - 1];
    }
}

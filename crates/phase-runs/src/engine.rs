//! Seeds of events and attempts, and simulations whose errors name the event.

use crate::error::RunError;
use core::ops::ControlFlow;
use phase_event::{Event, Step};
use phase_model::{
    Scene,
    random::{self, Purpose},
};
use phase_sim::SimulationSettings;

/// Name and version of this program, as stored in files.
pub const GENERATOR: &str = concat!("phase ", env!("CARGO_PKG_VERSION"));

/// The seed of one event of a file of scenes.
#[must_use]
pub(crate) fn event_seed(seed: u64, index: usize) -> u64 {
    random::derive_seed(seed, Purpose::Event, index as u64)
}

/// The seed of an attempt at one slot of a dataset, from which its scene and all randomness in its event are
/// derived.
#[must_use]
pub(crate) fn attempt_seed(dataset_seed: u64, slot: usize, attempt: usize) -> u64 {
    random::derive_seed(event_seed(dataset_seed, slot), Purpose::Attempt, attempt as u64)
}

/// Simulates an event; `None` if `on_step` cancelled it.
///
/// # Errors
/// [`RunError::Simulation`].
pub fn simulate(
    id: &str,
    scene: &Scene,
    seed: u64,
    settings: &SimulationSettings,
    on_step: &mut dyn FnMut(&Step) -> ControlFlow<()>,
) -> Result<Option<Event>, RunError> {
    let (event, finished) = phase_sim::simulate_with(scene, seed, settings, on_step)
        .map_err(|source| RunError::Simulation { id: id.into(), source })?;
    Ok(finished.then_some(event))
}

//! States to step from.

use phase_event::Recording;
use phase_model::{
    EventKind, PhysicsConfig, State,
    arena::SUBSTEPS,
    random::{Purpose, stream},
};
use std::path::Path;

/// Steps of each event that is simulated.
const STEPS: usize = 60;
/// Every how many rows of a recording a state is taken.
const EVERY: usize = 5;

/// States of one scene.
pub(crate) struct Starts {
    pub(crate) physics: PhysicsConfig,
    pub(crate) states: Vec<State>,
}

/// The states of one simulated event of each kind, in the sampler's first scene of it.
pub(crate) fn generated() -> Vec<Starts> {
    let settings = phase_sim::SimulationSettings {
        min_steps: STEPS,
        max_steps: STEPS,
        ..phase_sim::SimulationSettings::default()
    };
    let event = |kind| {
        let scene = phase_sampler::sample_kind(kind, &mut stream(1, Purpose::Scene, 0))
            .expect("a scene of every kind");
        let event = phase_sim::simulate(&scene, 1, &settings).expect("the default settings are valid");
        let states = event.steps.iter().map(|step| step.substeps[SUBSTEPS - 1]).collect();
        Starts { physics: event.scene.physics(), states }
    };
    EventKind::ALL.into_iter().map(event).collect()
}

/// States of all recordings of a file in the format `phase-events/1`.
pub(crate) fn recorded(path: &Path) -> Result<Vec<Starts>, phase_files::FileError> {
    let recordings = phase_dataset::phase_events::read(path)?;
    let starts = |recording: &Recording| {
        let trajectory = &recording.trajectory;
        let states = (0..=trajectory.steps()).step_by(EVERY).filter_map(|t| trajectory.state(t)).collect();
        Starts { physics: recording.scene.physics(), states }
    };
    Ok(recordings.iter().map(starts).collect())
}

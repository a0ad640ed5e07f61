//! Replays: measured recordings whose actions are known.

use crate::{Deviation, Engine, deviation::mean};
use phase_event::Recording;
use phase_model::{AGENT_COUNT, Action, Body, MAX_ENTITIES, PhysicsConfig, State};

/// One measured recording. One idle substep lies between its initial state and its first step.
#[derive(Clone, PartialEq, Debug)]
pub struct Replay {
    /// The recording's id.
    pub id: String,
    /// Walls, radii, forces.
    pub physics: PhysicsConfig,
    /// The state before the idle substep.
    pub initial: State,
    /// Actions of both agents, by step.
    pub actions: Vec<[Action; AGENT_COUNT]>,
    /// The means over the five substeps of each step; angular velocities are not recorded.
    pub rows: Vec<[Body; MAX_ENTITIES]>,
}

impl Replay {
    /// A recording with its recovered actions, as far as they are known.
    ///
    /// The recorder turned every agent counter-clockwise, whichever way it intended to turn, so both turns
    /// are left turns here. `None` without recovered actions, and for a mirrored recording: its row 0 lies
    /// within the first step, so no engine can start from it.
    #[must_use]
    pub fn of_recording(recording: &Recording) -> Option<Self> {
        let recovered =
            recording.recovered_actions.as_ref().filter(|recovered| !recovered.steps.is_empty())?;
        if recording.scene.layout.flip().is_some() {
            return None;
        }
        let left_only = |action| if action == Action::TurnRight { Action::TurnLeft } else { action };
        let rows = (1..=recovered.steps.len()).map(|t| Some(recording.trajectory.state(t)?.bodies));
        Some(Self {
            id: recording.id.clone(),
            physics: recording.scene.physics(),
            initial: recording.trajectory.state(0)?,
            actions: recovered.steps.iter().map(|both| both.map(left_only)).collect(),
            rows: rows.collect::<Option<_>>()?,
        })
    }

    /// Errors of the means over an engine's substeps with respect to each row, as long as actions are known.
    #[must_use]
    pub fn follow<E: Engine>(&self) -> Vec<Deviation> {
        let mut engine = E::set_up(&self.physics, &self.initial);
        engine.settle();
        let steps = self.actions.iter().zip(&self.rows);
        let far = |found: [Body; MAX_ENTITIES], row| Deviation::between(&self.physics, &found, row);
        steps.map(|(&actions, row)| far(mean(&engine.step(actions)), row)).collect()
    }
}

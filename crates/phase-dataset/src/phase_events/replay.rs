//! A recording as something an engine can be held against.

use super::Recording;
use phase_calibration::Replay;
use phase_model::Action;

impl Recording {
    /// The recording with its recovered actions, as far as they are known.
    ///
    /// The recorder turned every agent counter-clockwise, whichever way it wanted to turn, so both turns are
    /// left turns here. `None` without recovered actions, and for a mirrored recording: its row 0 lies within
    /// the first step, so no engine can start from it.
    #[must_use]
    pub fn replay(&self) -> Option<Replay> {
        let recovered = self.recovered_actions.as_ref().filter(|recovered| !recovered.steps.is_empty())?;
        if self.scene.layout.flip().is_some() {
            return None;
        }
        let left_only = |action| if action == Action::TurnRight { Action::TurnLeft } else { action };
        let rows = (1..=recovered.steps.len()).map(|t| Some(self.trajectory.state(t)?.bodies));
        Some(Replay {
            id: self.id.clone(),
            physique: self.scene.physique(),
            initial: self.trajectory.state(0)?,
            actions: recovered.steps.iter().map(|both| both.map(left_only)).collect(),
            rows: rows.collect::<Option<_>>()?,
        })
    }
}

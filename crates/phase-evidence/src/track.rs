//! One state for each step: the basis of all judgements.

use phase_event::{Event, mean_state};
use phase_model::{Entity, PhysicsConfig, State};

/// The state of every entity at every step of one event.
#[derive(Clone, PartialEq, Debug)]
pub struct Track {
    /// Walls, radii and forces.
    pub physics: PhysicsConfig,
    /// State 0 is the initial state; state t ≥ 1 belongs to step t. Recordings contain no grips or contacts.
    pub states: Vec<State>,
}

impl Track {
    /// The track of a simulated event: the initial state, then one [`mean_state`] a step, just as the rows of
    /// trajectories in files.
    #[must_use]
    pub fn of_event(event: &Event) -> Self {
        let steps = event.steps.iter().map(mean_state);
        Self {
            physics: event.scene.physics(),
            states: core::iter::once(event.initial).chain(steps).collect(),
        }
    }

    /// Steps after the initial state.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.states.len().saturating_sub(1)
    }

    /// The track up to and including a step.
    #[must_use]
    pub fn until(&self, step: usize) -> Self {
        let states = self.states.iter().take(step.saturating_add(1)).copied().collect();
        Self { physics: self.physics.clone(), states }
    }

    /// Distance an entity travelled in the steps of a range, from state to state (u). Steps past the end
    /// contribute nothing.
    #[must_use]
    pub fn distance_travelled(&self, entity: Entity, steps: core::ops::Range<usize>) -> f32 {
        steps.map(|step| self.distance_in_step(entity, step)).sum()
    }

    /// Distance an entity travelled in step t ≥ 1 (u); 0 for step 0 and past the end.
    #[must_use]
    pub fn distance_in_step(&self, entity: Entity, step: usize) -> f32 {
        let before = step.checked_sub(1).and_then(|before| self.states.get(before));
        match (before, self.states.get(step)) {
            (Some(before), Some(after)) => before.position(entity).distance(after.position(entity)),
            _ => 0.0,
        }
    }
}

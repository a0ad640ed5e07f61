//! Motion of an agent: how fast, how far, and how long it was in contact.

use crate::{Track, contact};
use phase_model::{AgentId, Entity, arena::STEP_SECONDS};

/// Motion of one agent in the first steps of an event.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct MotionStatistics {
    /// Its speed in each step (u per second of physics): the distance between its origins before and after,
    /// over five substeps of 1/60 s. Turning on the spot is not motion, so it is not the velocity of the
    /// centre of mass. All states but the first are means over substeps, so the first step is measured over
    /// three substeps only.
    pub speeds: Vec<f32>,
    /// Length of its path (u), from state to state.
    pub path: f32,
    /// Steps in which it touched the other agent or an object, walls not counted.
    pub contact_steps: usize,
}

impl MotionStatistics {
    /// Motion of an agent in steps 1 to `steps` of a track, or to its end if that comes first. Contact is
    /// judged by outlines alone, so that recordings and simulations are measured alike.
    #[must_use]
    pub fn of(track: &Track, agent: AgentId, steps: usize) -> Self {
        let steps = steps.min(track.steps());
        let entity = Entity::Agent(agent);
        let others: Vec<Entity> = track.physics.entities().filter(|&other| other != entity).collect();
        let states = track.states.iter().skip(1).take(steps);
        let in_contact = states
            .filter(|state| others.iter().any(|&other| contact::near(&track.physics, state, entity, other)));
        let seconds = STEP_SECONDS as f32;
        Self {
            speeds: (1..=steps).map(|step| track.distance_in_step(entity, step) / seconds).collect(),
            path: track.distance_travelled(entity, 1..steps + 1),
            contact_steps: in_contact.count(),
        }
    }

    /// Share of the steps in which it was in contact, 0 to 1; `None` if there are no steps.
    #[must_use]
    pub fn contact_share(&self) -> Option<f32> {
        let steps = self.speeds.len();
        (steps > 0).then(|| self.contact_steps as f32 / steps as f32)
    }
}

/// The steps that two tracks both have. Quantities that are summed or counted over an event can only be
/// compared over these, since one track may have been cut earlier than the other.
#[must_use]
pub fn common_steps(a: &Track, b: &Track) -> usize {
    a.steps().min(b.steps())
}

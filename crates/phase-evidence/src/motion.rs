//! Motion of an agent: how fast, how far, and how long it was in contact.

use crate::{Track, contact};
use phase_model::{
    AGENT_COUNT, AgentId, Entity, Vec2,
    arena::{STEP_SECONDS, STEP_VIDEO_SECONDS},
};

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

/// Motion that viewers of a video see, for matching videos of different conditions. Seconds are those of the
/// video.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct VideoMotion {
    /// Duration (s).
    pub seconds: f64,
    /// Length of each agent's path (u).
    pub path: [f64; AGENT_COUNT],
    /// Each agent's mean speed (u/s).
    pub speed: [f64; AGENT_COUNT],
    /// The mean magnitude of each agent's acceleration (u/s²), from the change of its velocity between
    /// steps. The first step, over which a track has a part of the motion only, does not count.
    pub acceleration: [f64; AGENT_COUNT],
    /// Mean distance of the two agents' origins (u).
    pub distance: f64,
    /// Least distance of the two agents' origins (u).
    pub least_distance: f64,
    /// Share of the steps in which the agents touch each other, 0 to 1.
    pub agents_touch: f64,
    /// Share of the steps in which each agent touches the other or an object, 0 to 1.
    pub contact: [f64; AGENT_COUNT],
}

impl VideoMotion {
    /// The motion in a whole track; `None` if it has no steps. Contact is judged by outlines alone.
    #[must_use]
    pub fn of(track: &Track) -> Option<Self> {
        let steps = track.steps();
        if steps == 0 {
            return None;
        }
        let seconds = steps as f64 * STEP_VIDEO_SECONDS;
        let motion = AgentId::ALL.map(|agent| MotionStatistics::of(track, agent, steps));
        let path = motion.each_ref().map(|motion| f64::from(motion.path));
        let [one, other] = AgentId::ALL.map(Entity::Agent);
        let apart: Vec<f64> = track
            .states
            .iter()
            .map(|state| f64::from(state.position(one).distance(state.position(other))))
            .collect();
        let touching = track.states.iter().skip(1);
        let touching = touching.filter(|state| contact::near(&track.physics, state, one, other)).count();
        Some(Self {
            seconds,
            path,
            speed: path.map(|path| path / seconds),
            acceleration: AgentId::ALL.map(|agent| acceleration(track, Entity::Agent(agent))),
            distance: apart.iter().sum::<f64>() / apart.len() as f64,
            least_distance: apart.iter().copied().fold(f64::INFINITY, f64::min),
            agents_touch: touching as f64 / steps as f64,
            contact: motion.each_ref().map(|motion| f64::from(motion.contact_share().unwrap_or_default())),
        })
    }
}

/// The mean magnitude of an entity's acceleration between steps (u/s² of video); 0 in tracks of less than
/// three steps.
fn acceleration(track: &Track, entity: Entity) -> f64 {
    let places: Vec<Vec2> = track.states.iter().skip(1).map(|state| state.position(entity)).collect();
    let changes: Vec<f64> = places
        .windows(3)
        .map(|three| f64::from((three[2] - three[1] - (three[1] - three[0])).length()))
        .collect();
    let mean = changes.iter().sum::<f64>() / changes.len().max(1) as f64;
    mean / (STEP_VIDEO_SECONDS * STEP_VIDEO_SECONDS)
}

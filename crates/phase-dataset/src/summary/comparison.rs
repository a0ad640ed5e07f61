//! One event, recorded and simulated.

use super::Quartiles;
use crate::ids;
use phase_event::{Event, Recording};
use phase_evidence::{GoalOutcome, MotionStatistics, Track, motion::common_steps};
use phase_files::checksum::FileEntry;
use phase_model::{AGENT_COUNT, AgentId, EventKind, Goal, Sign};
use serde::{Deserialize, Serialize};

/// One event, recorded and simulated, as the summary keeps it.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EventComparison {
    /// The simulated event's id.
    #[serde(deserialize_with = "ids::deserialize")]
    pub id: String,
    /// The recording whose first state it started from, and the seed.
    pub source: RecordingSource,
    /// Its kind.
    pub kind: EventKind,
    /// Steps of the recording (0 if the input had the start alone).
    pub recorded_steps: usize,
    /// Steps of the simulation.
    pub simulated_steps: usize,
    /// Steps over which motion is compared: the first ones, as many as both have.
    pub compared_steps: usize,
    /// The agents.
    pub agents: [AgentComparison; AGENT_COUNT],
    /// The simulated event.
    pub event: FileEntry,
    /// Its video, if one was made.
    pub video: Option<FileEntry>,
}

/// Origin of a simulated event.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordingSource {
    /// The recording's id in the input.
    pub id: String,
    /// The seed of the run that the event's own seed is derived from.
    pub seed: u64,
}

/// The outcome of one agent's goal in both, and how it moved.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AgentComparison {
    /// The goal.
    pub goal: Goal,
    /// Social utility weight.
    pub alpha: i8,
    /// In the recording.
    pub recorded: GoalOutcome,
    /// In the simulation.
    pub simulated: GoalOutcome,
    /// The agent's motion in the recording; null if there are no steps to compare.
    pub recorded_motion: Option<MotionSummary>,
    /// The agent's motion in the simulation; null if there are no steps to compare.
    pub simulated_motion: Option<MotionSummary>,
}

/// One agent's motion in one event, over the steps compared.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionSummary {
    /// Quartiles of its speed over the steps (u per second of physics).
    pub speed: Quartiles,
    /// Length of its path (u).
    pub path: f32,
    /// Share of the steps in which it touched another entity, 0 to 1.
    pub contact: f32,
}

/// A comparison with the motion of both agents step by step, which is not stored but needed for pooling.
#[derive(Clone, PartialEq, Debug)]
pub struct MeasuredPair {
    /// The comparison as it is stored in the file.
    pub comparison: EventComparison,
    /// Motion of both agents in the recording, over the steps compared.
    pub recorded: [MotionStatistics; AGENT_COUNT],
    /// Motion of both agents in the simulation, over the steps compared.
    pub simulated: [MotionStatistics; AGENT_COUNT],
}

impl AgentComparison {
    /// Whether the goal is the agent's own and positive: it neither helps nor hinders, and there is something
    /// to bring about rather than to avoid.
    #[must_use]
    pub(crate) fn own_positive(&self) -> bool {
        self.alpha == 0 && self.goal.sign() == Sign::Positive
    }

    /// Whether the goal was reached in both or in neither.
    #[must_use]
    pub const fn matched(&self) -> bool {
        self.recorded.reached == self.simulated.reached
    }
}

impl MotionSummary {
    fn of(motion: &MotionStatistics) -> Option<Self> {
        let speed = Quartiles::of(&motion.speeds)?;
        let contact = motion.contact_share()?;
        Some(Self { speed, path: motion.path, contact })
    }
}

impl MeasuredPair {
    /// Compares a recording with the simulation of this id and seed, whose files are its JSON and perhaps a
    /// video.
    #[must_use]
    pub fn of(
        recording: &Recording,
        id: String,
        seed: u64,
        simulated: &Event,
        (event, video): (FileEntry, Option<FileEntry>),
    ) -> Self {
        let track = Track { physics: recording.scene.physics(), states: recording.trajectory.states() };
        let ours = Track::of_event(simulated);
        let steps = common_steps(&track, &ours);
        let recorded = AgentId::ALL.map(|agent| MotionStatistics::of(&track, agent, steps));
        let motion = AgentId::ALL.map(|agent| MotionStatistics::of(&ours, agent, steps));
        let agents = core::array::from_fn(|i| {
            let agent = &recording.scene.agents[i];
            AgentComparison {
                goal: agent.goal,
                alpha: agent.attitude.alpha(),
                recorded: GoalOutcome::of(&track, agent.goal),
                simulated: GoalOutcome::of(&ours, agent.goal),
                recorded_motion: MotionSummary::of(&recorded[i]),
                simulated_motion: MotionSummary::of(&motion[i]),
            }
        });
        let comparison = EventComparison {
            kind: recording.scene.kind,
            recorded_steps: recording.trajectory.steps(),
            simulated_steps: simulated.steps.len(),
            compared_steps: steps,
            agents,
            event,
            video,
            source: RecordingSource { id: recording.id.clone(), seed },
            id,
        };
        Self { comparison, recorded, simulated: motion }
    }
}

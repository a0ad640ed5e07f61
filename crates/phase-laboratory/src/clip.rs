//! A part of an event, cut between two steps.

use phase_event::{Recording, Row, Tracking, Trajectory};
use phase_evidence::{GoalOutcome, MotionStatistics, Track};
use phase_model::{
    AGENT_COUNT, AgentId, Attitude, Body, EventKind, Goal, MAX_ENTITIES, Relation, State, Vec2,
    arena::{STEP_VIDEO_SECONDS, SUBSTEPS},
};
use serde::Serialize;
use thiserror::Error;

/// Why an event has no such clip.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum ClipError {
    /// Not a whole number of steps.
    #[error("{0} s is no whole number of steps of {STEP_VIDEO_SECONDS} s, 1 at least")]
    Seconds(f64),
    /// The event ends before the clip does.
    #[error("event {id} lasts {available} s; a clip from {from} s to {to} s does not fit")]
    TooShort {
        /// The event.
        id: String,
        /// Its length (s of video).
        available: f64,
        /// Begin of the clip (s).
        from: f64,
        /// End of the clip (s).
        to: f64,
    },
}

/// The place at which clips begin.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Start {
    /// As many steps lie before the clip as after it; one more after it if their number is odd.
    Middle,
    /// After this many steps.
    Step(usize),
}

/// The part that is cut out of every event.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Cut {
    /// Length (steps), at least 1.
    pub steps: usize,
    /// Place.
    pub start: Start,
}

/// The steps of a clip in its event.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct Window {
    /// Steps before the clip.
    pub first_step: usize,
    /// Steps of the clip.
    pub steps: usize,
}

/// The number of steps that lasts some seconds of video.
///
/// # Errors
/// [`ClipError::Seconds`] unless it is a whole number of steps.
pub fn steps_of(seconds: f64) -> Result<usize, ClipError> {
    let steps = seconds / STEP_VIDEO_SECONDS;
    // Steps are a quarter of a second, so multiples of a step have no rounding error.
    if steps >= 0.0 && steps.fract() == 0.0 && steps < 1e9 {
        Ok(steps as usize)
    } else {
        Err(ClipError::Seconds(seconds))
    }
}

/// Seconds of video that some steps last.
#[must_use]
pub const fn seconds_of(steps: usize) -> f64 {
    steps as f64 * STEP_VIDEO_SECONDS
}

impl Cut {
    /// A clip of some seconds, from `at` seconds on or from the middle (`None`).
    ///
    /// # Errors
    /// [`ClipError::Seconds`] unless both are whole numbers of steps, the length at least one.
    pub fn of_seconds(seconds: f64, at: Option<f64>) -> Result<Self, ClipError> {
        let steps = steps_of(seconds)?;
        if steps == 0 {
            return Err(ClipError::Seconds(seconds));
        }
        let start = at.map(steps_of).transpose()?.map_or(Start::Middle, Start::Step);
        Ok(Self { steps, start })
    }

    /// The steps to cut out of an event with this id and length.
    ///
    /// # Errors
    /// [`ClipError::TooShort`].
    pub fn window(&self, id: &str, available: usize) -> Result<Window, ClipError> {
        let first_step = match self.start {
            Start::Middle => available.saturating_sub(self.steps) / 2,
            Start::Step(step) => step,
        };
        let end = first_step.saturating_add(self.steps);
        if end > available {
            return Err(ClipError::TooShort {
                id: id.to_owned(),
                available: seconds_of(available),
                from: seconds_of(first_step),
                to: seconds_of(end),
            });
        }
        Ok(Window { first_step, steps: self.steps })
    }
}

impl Window {
    /// A whole event.
    #[must_use]
    pub const fn whole(steps: usize) -> Self {
        Self { first_step: 0, steps }
    }

    /// The frames of the clip's video: the state in which it begins, and every substep but the last, so that
    /// a clip of n steps has 5 n frames and lasts n quarters of a second exactly.
    pub fn frames<'a>(&self, recording: &'a Recording) -> impl Iterator<Item = State> + use<'a> {
        recording.frames().skip(self.first_step * SUBSTEPS).take(self.steps * SUBSTEPS)
    }
}

/// The label of an agent, and what became of its goal.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct ClippedAgent {
    /// Its goal.
    pub goal: Goal,
    /// Its attitude to the other.
    pub alpha: Attitude,
    /// The outcome of the whole event.
    pub event: GoalOutcome,
    /// The outcome, judged by the clip alone. Steps are counted from its beginning.
    pub clip: GoalOutcome,
    /// Length of its path in the clip (u).
    pub path: f32,
    /// Share of the clip's steps in which it touches the other agent or an object.
    pub contact: f32,
}

/// A clip and what it is of.
#[derive(Clone, PartialEq, Debug)]
pub struct Clip {
    /// The clip as an event of its own: rows only, for its beliefs and plans began before it. Row 0 is the
    /// state in which it begins.
    pub recording: Recording,
    /// Its place in the event.
    pub window: Window,
    /// The event's kind.
    pub kind: EventKind,
    /// The event's intended relation.
    pub relation: Relation,
    /// Both agents.
    pub agents: [ClippedAgent; AGENT_COUNT],
}

impl Clip {
    /// Cuts a clip out of an event and gives it an id.
    ///
    /// # Errors
    /// [`ClipError::TooShort`].
    pub fn of(recording: &Recording, cut: Cut, id: String) -> Result<Self, ClipError> {
        let window = cut.window(&recording.id, recording.trajectory.steps())?;
        let trajectory = rows(recording, window);
        let mut scene = recording.scene.clone();
        let start = trajectory.state(0).unwrap_or_else(|| State::new([Body::default(); MAX_ENTITIES]));
        for (agent, spec) in AgentId::ALL.into_iter().zip(&mut scene.agents) {
            spec.start = start.bodies[agent.index()];
        }
        for (k, object) in scene.objects.iter_mut().enumerate() {
            object.start = start.bodies[AGENT_COUNT + k];
        }
        let track = |trajectory: &Trajectory| Track {
            physics: recording.scene.physics(),
            states: trajectory.states(),
        };
        let event = track(&recording.trajectory);
        let clip = track(&trajectory);
        let agents = AgentId::ALL.map(|agent| {
            let spec = &recording.scene.agents[agent];
            let motion = MotionStatistics::of(&clip, agent, window.steps);
            ClippedAgent {
                goal: spec.goal,
                alpha: spec.attitude,
                event: GoalOutcome::of(&event, spec.goal),
                clip: GoalOutcome::of(&clip, spec.goal),
                path: motion.path,
                contact: motion.contact_share().unwrap_or(0.0),
            }
        });
        let of = if recording.simulation.is_some() { "state after" } else { "row of" };
        let recording = Recording {
            id,
            row_0: Some(format!("{of} step {} of {}", window.first_step, recording.id)),
            recorded_steps: Some(window.steps as u32),
            trajectory,
            recovered_actions: None,
            tracking: recording.tracking.clone().map(|tracking| Tracking {
                deviations: tracking.deviations.into_iter().map(|rows| window_of(rows, window)).collect(),
                ..tracking
            }),
            seed: None,
            simulation: None,
            relation_human: recording.relation_human,
            relation: recording.relation,
            controllers: recording.controllers,
            scene,
        };
        Ok(Self { window, kind: recording.scene.kind, relation: recording.relation, agents, recording })
    }
}

fn window_of(rows: Vec<Row>, window: Window) -> Vec<Row> {
    rows.into_iter().skip(window.first_step).take(window.steps + 1).collect()
}

/// The rows of a window. Row 0 of a simulated event is the state at the end of the step before, not a mean.
fn rows(recording: &Recording, window: Window) -> Trajectory {
    let exact = recording.frames().nth(window.first_step * SUBSTEPS);
    let cut = |entity: usize, rows: &Vec<Row>| -> Vec<Row> {
        let mut rows: Vec<Row> = window_of(rows.clone(), window);
        if let (Some(first), Some(state)) = (rows.first_mut(), &exact) {
            let Body { position: Vec2 { x, y }, velocity, angle, .. } = state.bodies[entity];
            *first = [x, y, velocity.x, velocity.y, angle];
        }
        rows
    };
    let trajectory = &recording.trajectory;
    Trajectory {
        agents: core::array::from_fn(|k| cut(k, &trajectory.agents[k])),
        objects: trajectory.objects.iter().enumerate().map(|(k, rows)| cut(AGENT_COUNT + k, rows)).collect(),
    }
}

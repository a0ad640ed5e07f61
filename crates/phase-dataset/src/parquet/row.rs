//! One event as the values of its columns.

use crate::manifest::EventEntry;
use phase_event::{Event, Recording, SimulationRecord, Step, pairs_in_contact, substep_row};
use phase_model::{
    AGENT_COUNT, AgentId, AgentSpec, Goal, ObjectId, State,
    words::{self, Names},
};

/// An event, with what the manifest states about its file.
pub(super) struct Row<'a> {
    pub(super) entry: &'a EventEntry,
    pub(super) recording: &'a Recording,
    pub(super) simulation: &'a SimulationRecord,
}

impl Row<'_> {
    pub(super) const fn event(&self) -> &Event {
        &self.simulation.event
    }

    fn entities(&self) -> usize {
        AGENT_COUNT + self.recording.scene.objects.len()
    }

    pub(super) fn of_agents<T>(&self, get: impl Fn(&AgentSpec) -> T) -> Vec<T> {
        self.recording.scene.agents.iter().map(get).collect()
    }

    /// The goals as the end of the sentence "it wants to …".
    pub(super) fn goal_words(&self) -> Vec<String> {
        let goals = AgentId::ALL.into_iter().zip(self.recording.scene.goals());
        goals.map(|(agent, goal)| Names::PAPER.plain(&words::wants_to(goal, agent))).collect()
    }

    pub(super) fn walls(&self) -> Vec<Vec<f32>> {
        let walls = self.recording.scene.layout.walls().into_iter();
        walls.map(|wall| vec![wall.a.x, wall.a.y, wall.b.x, wall.b.y]).collect()
    }

    /// Rows by step, then entity.
    pub(super) fn trajectory(&self) -> Vec<Vec<Vec<f32>>> {
        let trajectory = &self.recording.trajectory;
        let at =
            |t: usize| trajectory.entities().filter_map(|rows| rows.get(t)).map(|row| row.to_vec()).collect();
        (0..=trajectory.steps()).map(at).collect()
    }

    pub(super) fn of_steps<T>(&self, get: impl Fn(&Step, AgentId) -> T) -> Vec<Vec<T>> {
        let both = |step: &Step| AgentId::ALL.into_iter().map(|agent| get(step, agent)).collect();
        self.event().steps.iter().map(both).collect()
    }

    /// Bodies by frame, then entity.
    pub(super) fn substeps(&self) -> Vec<Vec<Vec<f32>>> {
        let entities = self.entities();
        let rows =
            |state: &State| state.bodies[..entities].iter().map(|body| substep_row(body).to_vec()).collect();
        self.event().frames().map(rows).collect()
    }

    /// By frame, the object that each agent holds.
    pub(super) fn held(&self) -> Vec<Vec<Option<i32>>> {
        let held = |state: &State| {
            AgentId::ALL
                .into_iter()
                .map(|agent| number(state.held_object(agent).map(ObjectId::index)))
                .collect()
        };
        self.event().frames().map(held).collect()
    }

    /// Pairs in contact by frame.
    pub(super) fn contacts(&self) -> Vec<Vec<Vec<i32>>> {
        let pairs = |state: &State| pairs_in_contact(state).into_iter();
        let of_frame =
            |state: &State| pairs(state).map(|pair| pair.map(|entity| entity as i32).to_vec()).collect();
        self.event().frames().map(of_frame).collect()
    }
}

/// The kind of a goal as in `phase-events/1`.
pub(super) const fn goal_kind(goal: Goal) -> &'static str {
    match goal {
        Goal::AgentOnLandmark { .. } => "agent_on_landmark",
        Goal::ObjectOnLandmark { .. } => "object_on_landmark",
        Goal::Touch { .. } => "touch",
    }
}

/// Whom the subject of a goal is to touch.
pub(super) fn goal_other(goal: Goal) -> Option<i32> {
    match goal {
        Goal::Touch { other, .. } => Some(other.number().into()),
        _ => None,
    }
}

/// A count, which is always small.
pub(super) fn number(index: Option<usize>) -> Option<i32> {
    index.and_then(|index| i32::try_from(index).ok())
}

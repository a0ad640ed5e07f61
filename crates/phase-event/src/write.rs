//! From recordings to JSON.

use crate::{
    COLUMNS, Controller, Event, EventWriteError, Recording, Recovered, Row, SUBSTEP_COLUMNS, SubstepRow,
    Thought, Tracking, Trajectory, line_formatter::LineFormatter, observed::ObservedEvent, substep_row,
    tracking::TrackingMembers, trajectory::row_of,
};
use phase_model::{
    AGENT_COUNT, Action, Body, Contacts, Entity, EventKind, Goal, Layout, MAX_ENTITIES, ObjectSpec, Relation,
    Scene, State, Vec2,
    arena::{self, STEP_VIDEO_SECONDS},
    scene_json::{AgentMembers, ObjectMembers},
};
use serde::Serialize;
use serde_json::Value;

/// The value of the field `format` of these files.
pub const FILE_FORMAT: &str = "phase-events/1";

/// The text of a `phase-events/1` file with these events, which [`from_json`](crate::from_json) reads back
/// bit for bit: one line for each field of an event, numbers in the shortest form that reads back to the same
/// bits.
///
/// # Errors
/// [`EventWriteError`] names the first event that cannot be written.
pub fn to_json(recordings: &[Recording]) -> Result<String, EventWriteError> {
    let events: Vec<String> = recordings.iter().map(Recording::to_json).collect::<Result<_, _>>()?;
    Ok(format!("{{\"format\":\"{FILE_FORMAT}\",\"events\":[\n{}\n]}}\n", events.join(",\n")))
}

/// The text of a `phase-events/1` file with events without labels, by name, which
/// [`parse_observed`](crate::parse_observed) reads back; with how they were measured, if that is known.
///
/// # Errors
/// [`EventWriteError`] names the first event that cannot be written.
pub fn observed_to_json(
    events: &[(&str, &ObservedEvent, Option<&Tracking>)],
) -> Result<String, EventWriteError> {
    let event = |(id, observed, tracking): &(&str, &ObservedEvent, Option<&Tracking>)| {
        lines(&ObservedMembers::of(id, observed, *tracking))
            .map_err(|source| EventWriteError::Json { event: (*id).into(), source })
    };
    let events: Vec<String> = events.iter().map(event).collect::<Result<_, _>>()?;
    Ok(format!("{{\"format\":\"{FILE_FORMAT}\",\"events\":[\n{}\n]}}\n", events.join(",\n")))
}

/// An event without labels.
#[derive(Serialize)]
struct ObservedMembers<'a> {
    id: &'a str,
    layout: Layout,
    walls: Vec<[Vec2; 2]>,
    landmarks: [Vec2; 4],
    agents: Vec<ObjectMembers>,
    objects: Vec<ObjectMembers>,
    step_seconds: f32,
    trajectory: OwnedTable,
    #[serde(skip_serializing_if = "Option::is_none")]
    tracking: Option<TrackingMembers<'a>>,
}

#[derive(Serialize)]
struct OwnedTable {
    columns: [&'static str; COLUMNS.len()],
    agents: Vec<Vec<Row>>,
    objects: Vec<Vec<Row>>,
}

impl<'a> ObservedMembers<'a> {
    fn of(id: &'a str, observed: &ObservedEvent, tracking: Option<&'a Tracking>) -> Self {
        let layout = observed.layout();
        let track = |entity: usize| observed.rows().iter().map(|row| row_of(&row[entity])).collect();
        let objects = AGENT_COUNT..AGENT_COUNT + observed.object_sizes().len();
        let size = |size| ObjectMembers::without_start(&ObjectSpec { size, start: Body::default() });
        Self {
            id,
            layout,
            walls: layout.walls().iter().map(|wall| [wall.a, wall.b]).collect(),
            landmarks: arena::LANDMARKS,
            agents: observed.agent_sizes().map(size).into(),
            objects: observed.object_sizes().iter().copied().map(size).collect(),
            step_seconds: STEP_VIDEO_SECONDS as f32,
            trajectory: OwnedTable {
                columns: COLUMNS,
                agents: (0..AGENT_COUNT).map(track).collect(),
                objects: objects.map(track).collect(),
            },
            tracking: tracking.map(TrackingMembers::of),
        }
    }
}

impl Recording {
    /// The event in its form as an element of a file's list `events`, one line for each field.
    ///
    /// # Errors
    /// [`EventWriteError`] if the event contains a number that is not finite.
    pub fn to_json(&self) -> Result<String, EventWriteError> {
        if !is_recording_finite(self) {
            return Err(EventWriteError::NotFinite(self.id.clone()));
        }
        lines(&EventMembers::of_recording(self))
            .map_err(|source| EventWriteError::Json { event: self.id.clone(), source })
    }
}

impl Event {
    /// The event in its form as an element of a file's list `events`, without the members that only a
    /// [`Recording`] has; one line for each field.
    ///
    /// # Errors
    /// If the event contains a number that is not finite.
    pub fn to_json(&self) -> serde_json::Result<String> {
        lines(self)
    }
}

fn lines(value: &impl Serialize) -> serde_json::Result<String> {
    let mut bytes = Vec::new();
    let mut serializer = serde_json::Serializer::with_formatter(&mut bytes, LineFormatter::default());
    value.serialize(&mut serializer)?;
    String::from_utf8(bytes).map_err(serde::ser::Error::custom)
}

/// The members of an event, in the order of files.
#[derive(Serialize)]
pub(crate) struct EventMembers<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    id: Option<&'a str>,
    layout: Layout,
    walls: Vec<[Vec2; 2]>,
    landmarks: [Vec2; arena::LANDMARKS.len()],
    agents: Vec<PlayedBy>,
    objects: Vec<ObjectMembers>,
    event: EventKind,
    relation: Relation,
    #[serde(skip_serializing_if = "Option::is_none")]
    relation_human: Option<Relation>,
    step_seconds: f32,
    #[serde(skip_serializing_if = "Option::is_none")]
    row_0: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    recorded_steps: Option<u32>,
    trajectory: Table<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    recovered_actions: Option<RecoveredMembers<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tracking: Option<TrackingMembers<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    #[serde(flatten)]
    simulation: Option<SimulationMembers<'a>>,
}

impl<'a> EventMembers<'a> {
    pub(crate) fn of_recording(recording: &'a Recording) -> Self {
        let simulation = recording.simulation.as_ref();
        Self {
            id: Some(&recording.id),
            relation: recording.relation,
            relation_human: recording.relation_human,
            row_0: recording.row_0.as_deref(),
            recorded_steps: recording.recorded_steps,
            recovered_actions: recording.recovered_actions.as_ref().map(RecoveredMembers::of),
            tracking: recording.tracking.as_ref().map(TrackingMembers::of),
            seed: simulation.map_or(recording.seed, |simulation| Some(simulation.event.seed)),
            agents: played(&recording.scene, recording.controllers),
            simulation: simulation.map(|simulation| SimulationMembers {
                generator: Some(&simulation.generator),
                settings: Some(&simulation.settings),
                ..SimulationMembers::of(&simulation.event)
            }),
            ..Self::of_scene(&recording.scene, &recording.trajectory)
        }
    }

    /// `trajectory` is that of the event.
    pub(crate) fn of_event(event: &'a Event, trajectory: &'a Trajectory) -> Self {
        let simulation = Some(SimulationMembers::of(event));
        Self { seed: Some(event.seed), simulation, ..Self::of_scene(&event.scene, trajectory) }
    }

    fn of_scene(scene: &Scene, trajectory: &'a Trajectory) -> Self {
        Self {
            id: None,
            layout: scene.layout,
            walls: scene.layout.walls().iter().map(|wall| [wall.a, wall.b]).collect(),
            landmarks: arena::LANDMARKS,
            agents: played(scene, [Controller::default(); AGENT_COUNT]),
            objects: scene.objects.iter().map(ObjectMembers::without_start).collect(),
            event: scene.kind,
            relation: scene.relation(),
            relation_human: None,
            step_seconds: STEP_VIDEO_SECONDS as f32,
            row_0: None,
            recorded_steps: None,
            trajectory: Table { columns: &COLUMNS, agents: &trajectory.agents, objects: &trajectory.objects },
            recovered_actions: None,
            tracking: None,
            seed: None,
            simulation: None,
        }
    }
}

/// An agent, and who moved it unless that was a mind.
#[derive(Serialize)]
struct PlayedBy {
    #[serde(flatten)]
    agent: AgentMembers,
    #[serde(skip_serializing_if = "Option::is_none")]
    controller: Option<Controller>,
}

fn played(scene: &Scene, controllers: [Controller; AGENT_COUNT]) -> Vec<PlayedBy> {
    let agents = scene.agents.iter().map(AgentMembers::without_start).zip(controllers);
    let played = agents.map(|(agent, controller)| PlayedBy {
        agent,
        controller: (controller != Controller::Mind).then_some(controller),
    });
    played.collect()
}

/// The additional members of a simulated event.
#[derive(Serialize)]
struct SimulationMembers<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    generator: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    settings: Option<&'a Value>,
    actions: Vec<[&'static str; AGENT_COUNT]>,
    subgoals: Vec<[String; AGENT_COUNT]>,
    values: Vec<[Option<f64>; AGENT_COUNT]>,
    substeps: Substeps,
    thoughts: Vec<[ThoughtMembers; AGENT_COUNT]>,
}

impl SimulationMembers<'_> {
    fn of(event: &Event) -> Self {
        let thoughts = || event.steps.iter().map(|step| step.thoughts.each_ref());
        let value = |thought: &Thought| thought.pursued().map(|proposed| proposed.value);
        Self {
            generator: None,
            settings: None,
            actions: event.steps.iter().map(|step| step.actions.map(Action::name)).collect(),
            subgoals: thoughts().map(|pair| pair.map(|thought| thought.subgoal.to_string())).collect(),
            values: thoughts().map(|pair| pair.map(value)).collect(),
            substeps: Substeps::of(event),
            thoughts: thoughts().map(|pair| pair.map(ThoughtMembers::of)).collect(),
        }
    }
}

pub(crate) fn is_recording_finite(recording: &Recording) -> bool {
    let rows = recording.trajectory.entities().flatten().flatten().all(|number| number.is_finite());
    rows && recording.simulation.as_ref().is_none_or(|simulation| is_event_finite(&simulation.event))
}

pub(crate) fn is_event_finite(event: &Event) -> bool {
    let physics = event.scene.physics();
    let mut grips = event.frames().flat_map(|state| state.grips).flatten();
    let thoughts = event.steps.iter().flat_map(|step| &step.thoughts);
    let mut values = thoughts.flat_map(|thought| {
        let subgoals = thought.subgoals.iter().map(|proposed| proposed.value);
        subgoals.chain(thought.actions.iter().map(|action| action.value))
    });
    event.frames().all(|state| state.is_finite(&physics))
        && grips.all(|grip| grip.relative_angle.is_finite())
        && values.all(f64::is_finite)
}

#[derive(Serialize)]
struct Table<'a> {
    columns: &'a [&'a str],
    agents: &'a [Vec<Row>; AGENT_COUNT],
    objects: &'a [Vec<Row>],
}

/// The members are in alphabetical order.
#[derive(Serialize)]
struct RecoveredMembers<'a> {
    note: Option<&'a str>,
    steps: Vec<[&'static str; AGENT_COUNT]>,
}

impl<'a> RecoveredMembers<'a> {
    fn of(recovered: &'a Recovered) -> Self {
        let steps = recovered.steps.iter().map(|pair| pair.map(Action::name)).collect();
        Self { note: recovered.note.as_deref(), steps }
    }
}

/// A subgoal's text, value and particles; an action's name, visits and value; an intent's α, goal and
/// particles; a probability.
#[derive(Serialize)]
struct ThoughtMembers {
    subgoals: Vec<(String, f64, usize)>,
    plan: Vec<String>,
    actions: Vec<(&'static str, u32, f64)>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    intents: Vec<(i8, Goal, usize)>,
    #[serde(skip_serializing_if = "Option::is_none")]
    suspicion: Option<f64>,
}

impl ThoughtMembers {
    fn of(thought: &Thought) -> Self {
        let proposed = thought.subgoals.iter();
        let searched = thought.actions.iter();
        let believed = thought.intents.iter();
        Self {
            subgoals: proposed.map(|it| (it.subgoal.to_string(), it.value, it.particles)).collect(),
            plan: thought.plan.iter().map(ToString::to_string).collect(),
            actions: searched.map(|it| (it.action.name(), it.visits, it.value)).collect(),
            intents: believed.map(|it| (it.intent.attitude.alpha(), it.intent.goal, it.particles)).collect(),
            suspicion: thought.suspicion,
        }
    }
}

/// Every frame of an event; grips and contacts only where they change.
#[derive(Serialize)]
struct Substeps {
    columns: [&'static str; SUBSTEP_COLUMNS.len()],
    agents: Vec<Vec<SubstepRow>>,
    objects: Vec<Vec<SubstepRow>>,
    grips: Vec<(usize, [Option<phase_model::Grip>; AGENT_COUNT])>,
    contacts: Vec<(usize, Vec<[usize; 2]>)>,
}

impl Substeps {
    fn of(event: &Event) -> Self {
        let track = |entity: &Entity| event.frames().map(|state| substep_row(state.body(*entity))).collect();
        let entities: Vec<Entity> = event.scene.physics().entities().collect();
        let (agents, objects) = entities.split_at(AGENT_COUNT);
        Self {
            columns: SUBSTEP_COLUMNS,
            agents: agents.iter().map(track).collect(),
            objects: objects.iter().map(track).collect(),
            grips: changes(event.frames().map(|state| state.grips)),
            contacts: changes(event.frames().map(pairs_in_contact)),
        }
    }
}

/// A list of `[frame, value]` with an entry wherever the value differs from the frame before.
fn changes<T: PartialEq>(values: impl Iterator<Item = T>) -> Vec<(usize, T)> {
    let mut changes: Vec<(usize, T)> = Vec::new();
    for (frame, value) in values.enumerate() {
        if changes.last().is_none_or(|(_, last)| *last != value) {
            changes.push((frame, value));
        }
    }
    changes
}

/// The pairs in contact, entities by their index.
#[must_use]
pub fn pairs_in_contact(state: &State) -> Vec<[usize; 2]> {
    let contacts: Contacts = state.contacts;
    let pairs = (0..MAX_ENTITIES).flat_map(|a| (a + 1..MAX_ENTITIES).map(move |b| [a, b]));
    pairs.filter(|pair| contacts.touching(Entity::ALL[pair[0]], Entity::ALL[pair[1]])).collect()
}

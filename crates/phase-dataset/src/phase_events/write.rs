//! From recordings to a file.

use super::{
    COLUMNS, Recording, Row, SUBSTEP_COLUMNS, Simulation,
    recording::{SubstepRow, substep_row},
};
use phase_agent::Thought;
use phase_model::{
    AGENT_COUNT, AgentSpec, Contacts, Entity, Goal, MAX_ENTITIES, ObjectSpec, State, arena,
    arena::{FRAMES_PER_SECOND, SUBSTEPS},
};
use serde::Serialize;
use serde_json::json;
use thiserror::Error;

/// The value of the field `format` of these files.
pub const FILE_FORMAT: &str = "phase-events/1";

/// A recording holds a number that JSON cannot express.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
#[error("event {0} holds a number that is not finite and cannot be written")]
pub struct NotFinite(pub String);

/// The text of a file with these events: one line for each field of an event, numbers in the shortest form
/// that reads back to the same bits.
///
/// # Errors
/// [`NotFinite`] names the first event with a number that is not finite.
pub fn to_json(recordings: &[Recording]) -> Result<String, NotFinite> {
    let events: Vec<String> = recordings.iter().map(event).collect::<Result<_, _>>()?;
    Ok(format!("{{\"format\":\"{FILE_FORMAT}\",\"events\":[\n{}\n]}}\n", events.join(",\n")))
}

/// The fields of an event, a line each.
#[derive(Default)]
struct Lines(Vec<String>);

impl Lines {
    fn add(&mut self, key: &str, value: &impl Serialize) {
        // Writing plain data of ours to a string cannot fail; a null would be caught by the reader.
        let text = serde_json::to_string(value).unwrap_or_else(|_| "null".into());
        self.0.push(format!("\"{key}\":{text}"));
    }
}

fn event(recording: &Recording) -> Result<String, NotFinite> {
    if !is_finite(recording) {
        return Err(NotFinite(recording.id.clone()));
    }
    let scene = &recording.scene;
    let mut lines = Lines::default();
    lines.add("id", &recording.id);
    lines.add("layout", &scene.layout);
    lines.add("walls", &scene.layout.walls().iter().map(|wall| [wall.a, wall.b]).collect::<Vec<_>>());
    lines.add("landmarks", &arena::LANDMARKS);
    lines.add("agents", &scene.agents.iter().map(AgentFields::of).collect::<Vec<_>>());
    lines.add("objects", &scene.objects.iter().map(ObjectFields::of).collect::<Vec<_>>());
    lines.add("event", &scene.kind);
    lines.add("relation", &recording.relation);
    if let Some(relation) = recording.relation_human {
        lines.add("relation_human", &relation);
    }
    lines.add("step_seconds", &(SUBSTEPS as f32 / FRAMES_PER_SECOND as f32));
    if let Some(row_0) = &recording.row_0 {
        lines.add("row_0", row_0);
    }
    if let Some(steps) = recording.recorded_steps {
        lines.add("recorded_steps", &steps);
    }
    let (agents, objects) = (&recording.trajectory.agents, &recording.trajectory.objects);
    lines.add("trajectory", &Table { columns: &COLUMNS, agents, objects });
    if let Some(recovered) = &recording.recovered_actions {
        let steps: Vec<_> = recovered.steps.iter().map(|pair| pair.map(|action| action.name())).collect();
        lines.add("recovered_actions", &json!({ "steps": steps, "note": recovered.note }));
    }
    if let Some(simulation) = &recording.simulation {
        add_simulation(&mut lines, simulation);
    }
    Ok(format!("{{{}}}", lines.0.join(",\n")))
}

fn add_simulation(lines: &mut Lines, simulation: &Simulation) {
    let event = &simulation.event;
    lines.add("seed", &event.seed);
    lines.add("generator", &simulation.generator);
    lines.add("settings", &simulation.settings);
    let actions: Vec<_> = event.steps.iter().map(|step| step.actions.map(|action| action.name())).collect();
    lines.add("actions", &actions);
    let each_thought = || event.steps.iter().map(|step| step.thoughts.each_ref());
    let subgoals: Vec<_> =
        each_thought().map(|pair| pair.map(|thought| thought.subgoal.to_string())).collect();
    lines.add("subgoals", &subgoals);
    lines.add(
        "values",
        &each_thought()
            .map(|pair| pair.map(|thought| thought.pursued().map(|proposed| proposed.value)))
            .collect::<Vec<_>>(),
    );
    lines.add("substeps", &Substeps::of(simulation));
    lines.add("thoughts", &each_thought().map(|pair| pair.map(ThoughtFields::of)).collect::<Vec<_>>());
}

fn is_finite(recording: &Recording) -> bool {
    let rows = recording.trajectory.entities().flatten().flatten().all(|number| number.is_finite());
    let physique = recording.scene.physique();
    rows && recording.simulation.as_ref().is_none_or(|simulation| {
        let event = &simulation.event;
        let grips = event.frames().flat_map(|state| state.grips).flatten();
        let thoughts = event.steps.iter().flat_map(|step| &step.thoughts);
        let mut values = thoughts.flat_map(|thought| {
            let subgoals = thought.subgoals.iter().map(|proposed| proposed.value);
            subgoals.chain(thought.actions.iter().map(|action| action.value))
        });
        event.frames().all(|state| state.is_finite(&physique))
            && grips.into_iter().all(|grip| grip.relative_angle.is_finite())
            && values.all(f64::is_finite)
    })
}

#[derive(Serialize)]
struct Table<'a> {
    columns: &'a [&'a str],
    agents: &'a [Vec<Row>; AGENT_COUNT],
    objects: &'a [Vec<Row>],
}

#[derive(Serialize)]
struct AgentFields {
    radius: f32,
    size_level: u8,
    max_force: f32,
    strength_level: u8,
    goal: Goal,
    alpha: i8,
}

impl AgentFields {
    fn of(agent: &AgentSpec) -> Self {
        Self {
            radius: agent.size.radius(),
            size_level: agent.size.level(),
            max_force: agent.strength.max_force(),
            strength_level: agent.strength.level(),
            goal: agent.goal,
            alpha: agent.attitude.alpha(),
        }
    }
}

#[derive(Serialize)]
struct ObjectFields {
    radius: f32,
    size_level: u8,
}

impl ObjectFields {
    fn of(object: &ObjectSpec) -> Self {
        Self { radius: object.size.radius(), size_level: object.size.level() }
    }
}

/// A subgoal's text, value and particles; an action's name, visits and value.
#[derive(Serialize)]
struct ThoughtFields {
    subgoals: Vec<(String, f64, usize)>,
    plan: Vec<String>,
    actions: Vec<(&'static str, u32, f64)>,
}

impl ThoughtFields {
    fn of(thought: &Thought) -> Self {
        let proposed = thought.subgoals.iter();
        let searched = thought.actions.iter();
        Self {
            subgoals: proposed.map(|it| (it.subgoal.to_string(), it.value, it.particles)).collect(),
            plan: thought.plan.iter().map(ToString::to_string).collect(),
            actions: searched.map(|it| (it.action.name(), it.visits, it.value)).collect(),
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
    fn of(simulation: &Simulation) -> Self {
        let event = &simulation.event;
        let track = |entity: &Entity| event.frames().map(|state| substep_row(state.body(*entity))).collect();
        let entities: Vec<Entity> = event.scene.physique().entities().collect();
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

/// What holds from which frame on, where it differs from the frame before.
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
pub(crate) fn pairs_in_contact(state: &State) -> Vec<[usize; 2]> {
    let contacts: Contacts = state.contacts;
    let pairs = (0..MAX_ENTITIES).flat_map(|a| (a + 1..MAX_ENTITIES).map(move |b| [a, b]));
    pairs.filter(|pair| contacts.touching(Entity::ALL[pair[0]], Entity::ALL[pair[1]])).collect()
}

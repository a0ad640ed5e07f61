//! From JSON to recordings.

use crate::{
    COLUMNS, Controller, Event, EventReadError, ObservedEvent, Recording, Recovered, Row, Trajectory,
    observed::{MAX_ROW_SPEED, is_possible},
    read_simulation::{actions_of, event_of, seed_of, simulation_of},
    tracking::tracking,
    trajectory::body_of,
    write::FILE_FORMAT,
};
use phase_model::{
    AGENT_COUNT, Relation, Scene, Vec2,
    arena::{self, STEP_VIDEO_SECONDS},
    json::{self, Field, FieldError, finite, shown},
    path::check_file_name,
    physics::MAX_ANGLE,
    scene_json::Starts,
};
use serde_json::Value;
use std::collections::BTreeSet;

/// The members that an event may have.
const MEMBERS: [&str; 23] = [
    "id",
    "layout",
    "walls",
    "landmarks",
    "agents",
    "objects",
    "event",
    "relation",
    "relation_human",
    "step_seconds",
    "row_0",
    "recorded_steps",
    "trajectory",
    "recovered_actions",
    "tracking",
    "seed",
    "generator",
    "settings",
    "actions",
    "subgoals",
    "values",
    "substeps",
    "thoughts",
];

/// Maximum number of letters of an id.
pub const LONGEST_ID: usize = 100;

/// Reads all events of a `phase-events/1` file and checks each.
///
/// Scenes must keep the rules of [`phase_model::validate`], trajectories of an event have one length, numbers
/// are finite, and ids differ in more than case. The result has at least one event, in the order of the file.
/// Suspicious but usable properties are no errors; [`Recording::warnings`] lists them.
///
/// # Errors
/// [`EventReadError`] names event, field and rule.
pub fn from_json(text: &str) -> Result<Vec<Recording>, EventReadError> {
    all_of(&json::parse_text(text)?, recording, |read| &read.id)
}

/// Reads layout, sizes and motion of all events from the bytes of a file of the form `phase-events/1`, with
/// the events' ids. Labels are not looked at and may be absent: `event`, `relation`, and `goal`, `alpha` and
/// `strength_level` of agents.
///
/// # Errors
/// [`EventReadError`] names event, field and rule.
pub fn parse_observed(bytes: &[u8]) -> Result<Vec<(String, ObservedEvent)>, EventReadError> {
    all_of(&json::parse(bytes)?, observed, |(id, _)| id)
}

/// Whether every event of a file has labels, right or wrong: `event`, and of each agent `goal`, `alpha` and
/// `strength_level`. So has a file that is none.
#[must_use]
pub fn is_labelled(bytes: &[u8]) -> bool {
    let Ok(document) = json::parse(bytes) else { return true };
    let events = document.get("events").and_then(Value::as_array);
    events.into_iter().flatten().all(|event| {
        let agents = event.get("agents").and_then(Value::as_array);
        let labelled = |agent: &Value| {
            !agent.is_object()
                || ["goal", "alpha", "strength_level"].iter().all(|label| agent.get(label).is_some())
        };
        !event.is_object() || event.get("event").is_some() && agents.into_iter().flatten().all(labelled)
    })
}

/// Reads events from the bytes of a file, which need not be valid UTF-8.
///
/// # Errors
/// [`EventReadError`] names event, field and rule.
pub fn parse(bytes: &[u8]) -> Result<Vec<Recording>, EventReadError> {
    all_of(&json::parse(bytes)?, recording, |read| &read.id)
}

/// The reading of an event, which is told its number as a name for one without a valid id.
type Reader<T> = fn(&Field<'_>, &dyn Fn() -> Option<String>) -> Result<T, EventReadError>;

fn all_of<T>(document: &Value, read: Reader<T>, name: fn(&T) -> &String) -> Result<Vec<T>, EventReadError> {
    json::check_format(document, FILE_FORMAT)?;
    let of_file = |problem| EventReadError::Field { event: None, problem };
    let file = Field::root(document);
    file.only(&["format", "events"]).map_err(of_file)?;
    let events = file.required("events").map_err(of_file)?;
    let events = events.array().map_err(of_file)?;
    if events.is_empty() {
        return Err(EventReadError::NoEvents);
    }
    let mut ids = BTreeSet::new();
    let mut all = Vec::with_capacity(events.len());
    for (k, value) in events.iter().enumerate() {
        let event = read(&Field::root(value), &|| Some(format!("number {k}")))?;
        let id = name(&event);
        // Some systems take names for one that differ in case only.
        if !ids.insert(id.to_ascii_lowercase()) {
            return Err(EventReadError::DuplicateId(id.clone()));
        }
        all.push(event);
    }
    Ok(all)
}

impl Recording {
    /// Reads one event in its form as an element of a file's list `events`.
    ///
    /// # Errors
    /// [`EventReadError`] names field and rule.
    pub fn from_json(text: &str) -> Result<Self, EventReadError> {
        Self::from_value(&json::parse_text(text)?)
    }

    /// Reads one event from JSON that is already parsed, in its form as an element of a file's list `events`.
    ///
    /// # Errors
    /// [`EventReadError`] names field and rule.
    pub fn from_value(value: &Value) -> Result<Self, EventReadError> {
        recording(&Field::root(value), &|| None)
    }
}

impl Event {
    /// Reads a simulated event in its form as an element of a file's list `events`. The additional members of
    /// a [`Recording`] (`id`, `generator`, `settings`, labels) are optional.
    ///
    /// # Errors
    /// [`EventReadError`] names field and rule.
    pub fn from_json(text: &str) -> Result<Self, EventReadError> {
        Self::from_value(&json::parse_text(text)?)
    }

    /// Reads a simulated event from JSON that is already parsed; see [`Event::from_json`] for its form.
    ///
    /// # Errors
    /// [`EventReadError`] names field and rule.
    pub fn from_value(value: &Value) -> Result<Self, EventReadError> {
        let event = Field::root(value);
        let in_event = |problem| EventReadError::Field { event: None, problem };
        let (mut scene, trajectory) = start_and_motion(&event, None)?;
        let substeps = event.required("substeps").map_err(in_event)?;
        event_of(&event, &substeps, &mut scene, &trajectory).map_err(in_event)
    }
}

/// `name` is used for an event without a valid `id`.
fn recording(event: &Field<'_>, name: &dyn Fn() -> Option<String>) -> Result<Recording, EventReadError> {
    let id = id_of(event).map_err(|problem| EventReadError::Field { event: name(), problem })?;
    let in_event = |problem| EventReadError::Field { event: Some(id.clone()), problem };
    let (mut scene, trajectory) = start_and_motion(event, Some(&id))?;
    let labels = labels(event, trajectory.steps()).map_err(in_event)?;
    let simulation = simulation_of(event, &mut scene, &trajectory).map_err(in_event)?;
    let seed = event.optional("seed").and_then(|seed| seed.as_ref().map(seed_of).transpose());
    let seed = seed.map_err(in_event)?.filter(|_| simulation.is_none());
    Ok(Recording {
        relation: labels.relation.unwrap_or_else(|| scene.relation()),
        relation_human: labels.relation_human,
        row_0: labels.row_0,
        recorded_steps: labels.recorded_steps,
        controllers: controllers(event).map_err(in_event)?,
        recovered_actions: labels.recovered_actions,
        tracking: tracking(event).map_err(in_event)?,
        id,
        scene,
        trajectory,
        seed,
        simulation,
    })
}

/// The part of an event that a viewer sees, and its id; see [`parse_observed`].
fn observed(
    event: &Field<'_>,
    name: &dyn Fn() -> Option<String>,
) -> Result<(String, ObservedEvent), EventReadError> {
    let id = id_of(event).map_err(|problem| EventReadError::Field { event: name(), problem })?;
    let in_event = |problem| EventReadError::Field { event: Some(id.clone()), problem };
    event.only(&MEMBERS).map_err(in_event)?;
    let (layout, agents, objects) = Scene::layout_and_sizes(event).map_err(in_event)?;
    let motion = trajectory(event, objects.len()).map_err(in_event)?;
    let rows = motion.states().iter().map(|state| state.bodies).collect();
    let seen = ObservedEvent::new(layout, agents, objects, rows).map_err(|error| {
        in_event(FieldError { field: "trajectory".into(), rule: format!("cannot be observed: {error}") })
    })?;
    let measured = tracking(event).map_err(in_event)?;
    let seen = match measured {
        Some(measured) => seen.with_tracking(&measured),
        None => seen,
    };
    Ok((id, seen))
}

/// The scene, which starts at the first row of the trajectory, and the trajectory.
fn start_and_motion(event: &Field<'_>, id: Option<&str>) -> Result<(Scene, Trajectory), EventReadError> {
    let name = || id.map(String::from);
    let in_event = |problem| EventReadError::Field { event: name(), problem };
    event.only(&MEMBERS).map_err(in_event)?;
    let mut scene = Scene::from_members(event, Starts::Elsewhere).map_err(in_event)?;
    let trajectory = trajectory(event, scene.objects.len()).map_err(in_event)?;
    for (agent, rows) in scene.agents.iter_mut().zip(&trajectory.agents) {
        agent.start = body_of(&rows[0]);
    }
    for (object, rows) in scene.objects.iter_mut().zip(&trajectory.objects) {
        object.start = body_of(&rows[0]);
    }
    match scene.validate().and_then(|()| scene.check_kind()) {
        Ok(()) => Ok((scene, trajectory)),
        Err(source) => Err(EventReadError::Scene { event: name(), source }),
    }
}

fn id_of(event: &Field<'_>) -> Result<String, FieldError> {
    let field = event.required("id")?;
    let id = field.text()?;
    check_id(id)
        .map(|()| id.into())
        .map_err(|rule| field.error(format!("{rule}, not {}", shown(field.value()))))
}

/// Checks the name of an event. It becomes a file name, so it must be valid on every system.
///
/// # Errors
/// The rule that it violates, which continues a sentence that begins with the name of the field.
pub fn check_id(id: &str) -> Result<(), String> {
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "-_.".contains(letter);
    let fits = (1..=LONGEST_ID).contains(&id.len()) && id.chars().all(plain);
    if !fits || id.starts_with(['.', '-']) {
        return Err(format!(
            "must be 1 to {LONGEST_ID} letters, digits, `-`, `_` and `.`, not beginning with `.` or `-`"
        ));
    }
    check_file_name(id).map_err(|rule| rule.to_string())
}

struct Labels {
    relation: Option<Relation>,
    relation_human: Option<Relation>,
    row_0: Option<String>,
    recorded_steps: Option<u32>,
    recovered_actions: Option<Recovered>,
}

fn labels(event: &Field<'_>, rows: usize) -> Result<Labels, FieldError> {
    const RELATIONS: [(&str, Relation); 3] = [
        ("friendly", Relation::Friendly),
        ("adversarial", Relation::Adversarial),
        ("neutral", Relation::Neutral),
    ];
    if let Some(field) = event.optional("step_seconds")? {
        let expected = STEP_VIDEO_SECONDS as f32;
        if (field.number()? - expected).abs() > 1e-4 {
            return Err(field.must_be(&expected.to_string()));
        }
    }
    let relation = |key| event.optional(key)?.map(|field| field.one_of(&RELATIONS)).transpose();
    let steps = event.optional("recorded_steps")?;
    Ok(Labels {
        relation: relation("relation")?,
        relation_human: relation("relation_human")?,
        row_0: event.optional("row_0")?.map(|field| field.text().map(String::from)).transpose()?,
        recorded_steps: steps.map(|field| field.whole(0, u32::MAX.into())).transpose()?.map(|n| n as u32),
        recovered_actions: event
            .optional("recovered_actions")?
            .map(|field| recovered(&field, rows))
            .transpose()?,
    })
}

/// The controllers of both agents: `agents[i].controller`. The scene has been read, so there are two agents.
fn controllers(event: &Field<'_>) -> Result<[Controller; AGENT_COUNT], FieldError> {
    const NAMES: [(&str, Controller); 2] = [("mind", Controller::Mind), ("human", Controller::Human)];
    let mut controllers = [Controller::default(); AGENT_COUNT];
    for (controller, agent) in controllers.iter_mut().zip(event.required("agents")?.items()?) {
        if let Some(field) = agent.optional("controller")? {
            *controller = field.one_of(&NAMES)?;
        }
    }
    Ok(controllers)
}

fn recovered(field: &Field<'_>, rows: usize) -> Result<Recovered, FieldError> {
    field.only(&["steps", "note"])?;
    let list = field.required("steps")?;
    let steps = actions_of(&list)?;
    if steps.len() > rows {
        let rule = format!("must hold at most the {rows} steps of `trajectory`, not {}", steps.len());
        return Err(list.error(rule));
    }
    Ok(Recovered {
        steps,
        note: field.optional("note")?.map(|note| note.text().map(String::from)).transpose()?,
    })
}

fn trajectory(event: &Field<'_>, object_count: usize) -> Result<Trajectory, FieldError> {
    let field = event.required("trajectory")?;
    field.only(&["columns", "agents", "objects"])?;
    columns(&field, &COLUMNS)?;
    let agents = tracks(&field.required("agents")?, AGENT_COUNT, "agents")?;
    let objects = tracks(&field.required("objects")?, object_count, "objects")?;
    let mut agents = agents.into_iter();
    let agents: [Vec<Row>; AGENT_COUNT] = core::array::from_fn(|_| agents.next().unwrap_or_default());
    let length = agents[0].len();
    let named = agents.iter().map(|rows| ("agents", rows)).enumerate();
    let named = named.chain(objects.iter().map(|rows| ("objects", rows)).enumerate());
    for (k, (group, rows)) in named {
        if rows.len() != length {
            let rows = rows.len();
            let rule =
                format!("has {rows} rows, but `trajectory.agents[0]` has {length}: all must have as many");
            return Err(FieldError { field: format!("trajectory.{group}[{k}]"), rule });
        }
    }
    Ok(Trajectory { agents, objects })
}

/// Checks the names of a table's columns.
pub(crate) fn columns(table: &Field<'_>, expected: &[&str]) -> Result<(), FieldError> {
    let field = table.required("columns")?;
    let found: Vec<Option<&str>> = field.array()?.iter().map(Value::as_str).collect();
    if found.iter().copied().eq(expected.iter().map(|name| Some(*name))) {
        Ok(())
    } else {
        Err(field.must_be(&format!("{expected:?}")))
    }
}

fn tracks(field: &Field<'_>, count: usize, group: &str) -> Result<Vec<Vec<Row>>, FieldError> {
    let tracks = field.items()?;
    if tracks.len() != count {
        let rule = format!("must hold {count} tracks, one for each of `{group}`, not {}", tracks.len());
        return Err(field.error(rule));
    }
    tracks.map(|track| rows(&track)).collect()
}

/// The rows of one entity: at least one, of finite numbers, inside the arena.
pub(crate) fn rows<const N: usize>(track: &Field<'_>) -> Result<Vec<[f32; N]>, FieldError> {
    let rows = track.array()?;
    if rows.is_empty() {
        return Err(track.error("must hold at least one row"));
    }
    let row = |(t, row): (usize, &Value)| {
        let in_row = |error: FieldError| FieldError { field: format!("{}[{t}]", error.field), ..error };
        let numbers = row.as_array().filter(|numbers| numbers.len() == N).ok_or_else(|| {
            let found = row.as_array().map_or_else(|| shown(row), |numbers| numbers.len().to_string());
            in_row(track.error(format!("must hold {N} numbers, not {found}")))
        })?;
        let mut result = [0.0; N];
        for (column, (result, number)) in result.iter_mut().zip(numbers).enumerate() {
            *result = finite(number).ok_or_else(|| {
                let rule = format!("must be a finite number, not {}", shown(number));
                let error = track.error(rule);
                FieldError { field: format!("{}[{t}][{column}]", error.field), ..error }
            })?;
        }
        let [x, y, vx, vy, angle] = [0, 1, 2, 3, 4].map(|column: usize| result[column]);
        if !is_possible(Vec2::new(vx, vy), angle) {
            let rule = format!(
                "must not be faster than {MAX_ROW_SPEED:.0} u/s, and its angle must be within {MAX_ANGLE} rad"
            );
            Err(in_row(track.error(rule)))
        } else if arena::contains(Vec2::new(x, y)) {
            Ok(result)
        } else {
            let rule = format!("must lie inside the arena (x 6 to 26, y 2 to 22), not at ({x}, {y})");
            Err(in_row(track.error(rule)))
        }
    };
    rows.iter().enumerate().map(row).collect()
}

//! A scene as the text of a `phase-events/1` file, laid out for people.

use crate::error::CliError;
use phase_event::{COLUMNS, FILE_FORMAT};
use phase_model::{AgentSpec, Body, ObjectSpec, Scene, Size, Strength, arena};
use serde::Serialize;
use serde_json::json;

/// The text of a file with one scene. `program` is the command that starts this program.
///
/// # Errors
/// [`CliError::Serialise`].
pub(super) fn file(id: &str, scene: &Scene, program: &str) -> Result<String, CliError> {
    let comment = list(&comments(program), "    ")?;
    let agents = list(&scene.agents.each_ref().map(agent), "    ")?;
    let objects = list(&scene.objects.iter().map(object).collect::<Vec<_>>(), "    ")?;
    let starts =
        |bodies: Vec<&Body>| list(&bodies.into_iter().map(|body| [row(body)]).collect::<Vec<_>>(), "      ");
    let agent_rows = starts(scene.agents.iter().map(|agent| &agent.start).collect())?;
    let object_rows = starts(scene.objects.iter().map(|object| &object.start).collect())?;
    let id = line(&id)?;
    let layout = line(&scene.layout)?;
    let kind = line(&scene.kind)?;
    let columns = line(&COLUMNS)?;
    Ok(format!(
        "{{\n\"format\": \"{FILE_FORMAT}\",\n\"events\": [\n  {{\n    \"_comment\": {comment},\n    \"id\": {id},\n    \
         \"event\": {kind},\n    \"layout\": {layout},\n    \"agents\": {agents},\n    \"objects\": {objects},\n    \
         \"trajectory\": {{\n      \"columns\": {columns},\n      \"agents\": {agent_rows},\n      \
         \"objects\": {object_rows}\n    }}\n  }}\n]\n}}\n"
    ))
}

/// Instructions for editing the scene.
fn comments(program: &str) -> Vec<String> {
    let sizes = Size::ALL.map(|size| format!("{} = {} u", size.level(), size.radius())).join(", ");
    let strengths =
        Strength::ALL.map(|strength| format!("{} = {} N", strength.level(), strength.max_force())).join(", ");
    let landmarks = arena::LANDMARKS.iter().enumerate();
    let landmarks: Vec<String> = landmarks.map(|(k, at)| format!("{k} at ({}, {})", at.x, at.y)).collect();
    vec![
        format!("A scene to start from: edit it, then {program} simulate --events FILE --out DIR."),
        "Members whose names begin with _ are ignored. docs/reference/formats/events.md describes every other member.".into(),
        "id: letters, digits, - and _; files of this event are named after it. Further events may follow in the list \
         events, each with an id of its own."
            .into(),
        "event: the kind: helping, hindering, chasing, competing, collaborating or independent. Change it with alpha and goals: a helping or \
         hindering event has one agent with alpha 1 or -1, the others none."
            .into(),
        "layout: base 0 to 21 is one of the paper's layouts of walls; flip null, or 0 to 3 for a reflection \
         (docs/images/layouts.png)."
            .into(),
        "agents: agent 0 is red, agent 1 green. alpha: 1 helps the other, -1 hinders the other, 0 has a goal of its own. A helping agent has \
         the other's goal, a hindering one the other's goal with the opposite sign."
            .into(),
        "knows: \"nothing\" for an agent that has to find out the other's goal, which all others know; level 0, 1 or 2 is how far it reasons \
         about the other's mind."
            .into(),
        "goal: {kind: agent_on_landmark, agent, landmark, sign}, {kind: object_on_landmark, object, landmark, sign} or \
         {kind: touch, agent, other, sign}; sign 1 to bring it about, -1 to prevent it."
            .into(),
        format!("size_level, the radius of a body: {sizes}. strength_level, the greatest force: {strengths}."),
        format!("Landmarks: {}.", landmarks.join(", ")),
        "objects: none to two, light blue and pink; an object that is too heavy for one agent needs both.".into(),
        "trajectory: one row for each body, its start: x and y in u, vx and vy in u/s, angle in radians. \
         vx and vy are per second of physics, of which a step lasts 1/12. Bodies should overlap neither each \
         other nor walls."
            .into(),
    ]
}

fn agent(agent: &AgentSpec) -> serde_json::Value {
    let mut members = json!({
        "size_level": agent.size.level(), "strength_level": agent.strength.level(),
        "alpha": agent.attitude.alpha(), "goal": agent.goal,
    });
    if let Some(level) = agent.awareness.knows.level() {
        members["knows"] = "nothing".into();
        members["level"] = u8::from(level).into();
    }
    members
}

fn object(object: &ObjectSpec) -> serde_json::Value {
    json!({ "size_level": object.size.level() })
}

/// A body in the order of [`COLUMNS`].
fn row(body: &Body) -> [f32; COLUMNS.len()] {
    [body.position.x, body.position.y, body.velocity.x, body.velocity.y, body.angle]
}

/// A list with each item on a separate line.
fn list(items: &[impl Serialize], indent: &str) -> Result<String, CliError> {
    if items.is_empty() {
        return Ok("[]".into());
    }
    let lines: Vec<String> = items.iter().map(line).collect::<Result<_, _>>()?;
    Ok(format!("[\n{indent}  {}\n{indent}]", lines.join(&format!(",\n{indent}  "))))
}

/// A value on one line.
fn line(value: &impl Serialize) -> Result<String, CliError> {
    serde_json::to_string(value).map_err(|source| CliError::Serialise { what: "a scene", source })
}

//! Scenes and files of events.

use crate::{packed, sentence};
use phase_event::{ObservedEvent, Recording};
use phase_model::{
    AGENT_COUNT, AgentId, Attitude, Entity, EventKind, Goal, LandmarkId, ObjectId, Scene, Sign, State,
    Strength, arena, layout::USED_BASES, words::Names,
};
use phase_sampler::{Variant, sample_named};
use phase_simple::Hypothesis;
use serde_json::{Value, json};

/// Reads and checks a scene.
///
/// # Errors
/// A sentence that names the field and the rule.
pub fn read(scene: &str) -> Result<Scene, String> {
    let scene = Scene::from_json(scene).map_err(sentence)?;
    scene.validate().map_err(sentence)?;
    Ok(scene)
}

/// A scene in its canonical form, and what a page shows of it: `scene`, `walls` ([[x, y], [x, y]], u),
/// `radii` (u), `landmarks` ([x, y], u), `relation`, `goals` in words, `kind` as goals and attitudes have it,
/// and `overlap`, what overlaps at the start, as a sentence: a recording may begin so, but nobody should make
/// such a scene.
///
/// # Errors
/// A sentence that names the field and the rule.
pub fn describe(scene: &str) -> Result<String, String> {
    let scene = read(scene)?;
    let physics = scene.physics();
    let goals = AgentId::ALL.map(|agent| Names::PAPER.wants(scene.goals()[agent], agent));
    let walls: Vec<_> = physics.walls.iter().map(|wall| [wall.a.to_array(), wall.b.to_array()]).collect();
    let canonical: Value = serde_json::from_str(&scene.to_json().map_err(sentence)?).map_err(sentence)?;
    let radii: Vec<f32> = physics.entities().map(|entity| physics.radius(entity)).collect();
    let landmarks = arena::LANDMARKS.map(|centre| centre.to_array());
    let description = json!({
        "scene": canonical, "walls": walls, "radii": radii, "landmarks": landmarks,
        "relation": scene.relation().name(), "goals": goals,
        "kind": EventKind::of(scene.goals(), scene.attitudes()).name(),
        "overlap": scene.validate_without_overlap().err().map(sentence),
    });
    Ok(description.to_string())
}

/// The words and choices that an editor offers: `kinds` with their `variants`, the numbers of the `layouts`
/// in use, and the `names` of the bodies.
#[must_use]
pub fn choices() -> String {
    let kinds: Vec<_> = EventKind::ALL
        .into_iter()
        .map(|kind| {
            let variants: Vec<_> = Variant::of(kind).iter().map(|variant| variant.name()).collect();
            json!({ "name": kind.name(), "variants": variants })
        })
        .collect();
    let names = Entity::ALL.map(|entity| Names::PAPER.entity(entity));
    json!({ "kinds": kinds, "layouts": USED_BASES, "names": names }).to_string()
}

/// The goals that an agent of a scene with so many objects can have: `goal`, as it stands in scenes, and
/// `words`.
#[must_use]
pub fn goals(agent: AgentId, objects: usize) -> String {
    let other = agent.other();
    let places = LandmarkId::ALL.into_iter().flat_map(|landmark| {
        let on = Sign::Positive;
        let agents = [agent, other].map(|agent| Goal::AgentOnLandmark { agent, landmark, sign: on });
        let objects = ObjectId::ALL.into_iter().take(objects);
        let objects = objects.map(move |object| Goal::ObjectOnLandmark { object, landmark, sign: on });
        agents.into_iter().chain(objects)
    });
    let chase = Goal::Touch { agent, other, sign: Sign::Positive };
    let flee = Goal::Touch { agent: other, other: agent, sign: Sign::Negative };
    let all = places.flat_map(|goal| [goal, goal.negated()]).chain([chase, flee]);
    let told: Vec<_> =
        all.map(|goal| json!({ "goal": goal, "words": Names::PAPER.wants(goal, agent) })).collect();
    Value::from(told).to_string()
}

/// Draws a scene of a kind, and of a variant if one is given; the same seed gives the same scene.
///
/// # Errors
/// A sentence for an unknown name, and if no scene was found.
pub fn sample(kind: &str, variant: Option<&str>, seed: u64) -> Result<String, String> {
    let scene = sample_named(Some(kind), variant, seed);
    scene.map_err(sentence)?.to_json().map_err(sentence)
}

/// The state in which a scene begins, packed.
///
/// # Errors
/// A sentence that names the field and the rule.
pub fn start(scene: &str) -> Result<Vec<f32>, String> {
    let mut numbers = Vec::new();
    packed::push(&read(scene)?.initial_state(), &mut numbers);
    Ok(numbers)
}

/// An event of a file, ready to be shown.
#[derive(Clone, Debug)]
pub struct PageEvent {
    /// Its name.
    pub id: String,
    /// Its scene, as JSON. Without labels, goals in it are made up so that it can be drawn.
    pub scene: String,
    /// Whether it has labels.
    pub labelled: bool,
    /// States to be shown one after the other, packed; see [`frames`].
    pub frames: Vec<f32>,
    /// The rows that an observer is shown, packed.
    pub rows: Vec<f32>,
}

/// The events of a file in the format `phase-events/1`, with labels or without.
///
/// # Errors
/// A sentence that names the field and the rule.
pub fn events(text: &str) -> Result<Vec<PageEvent>, String> {
    let packed = |states: &[State]| {
        let mut numbers = Vec::new();
        states.iter().for_each(|state| packed::push(state, &mut numbers));
        numbers
    };
    if !phase_event::is_labelled(text.as_bytes()) {
        let observed = phase_event::parse_observed(text.as_bytes()).map_err(sentence)?;
        let unlabelled = |(id, event): (String, ObservedEvent)| {
            let touch = |agent: AgentId| Goal::Touch { agent, other: agent.other(), sign: Sign::Positive };
            let goals = AgentId::ALL.map(touch);
            let strengths = [Strength::Fair; AGENT_COUNT];
            let scene = Hypothesis::new(goals, [Attitude::Neutral; AGENT_COUNT], strengths).scene(&event);
            let rows: Vec<State> = event.rows().iter().map(|row| State::new(*row)).collect();
            let scene = scene.to_json().map_err(sentence)?;
            Ok(PageEvent { id, scene, labelled: false, frames: packed(&event.frames()), rows: packed(&rows) })
        };
        return observed.into_iter().map(unlabelled).collect();
    }
    let labelled = |recording: Recording| {
        let scene = recording.scene.to_json().map_err(sentence)?;
        let rows = packed(&recording.trajectory.states());
        Ok(PageEvent { scene, labelled: true, frames: frames(&recording), rows, id: recording.id })
    };
    phase_event::from_json(text).map_err(sentence)?.into_iter().map(labelled).collect()
}

/// The frames of an event, packed: its substeps, or for a recording, which has none, each row five times.
#[must_use]
pub fn frames(recording: &Recording) -> Vec<f32> {
    let mut numbers = Vec::new();
    match &recording.simulation {
        Some(simulation) => simulation.event.frames().for_each(|state| packed::push(state, &mut numbers)),
        None => {
            let states: Vec<State> = recording.trajectory.states();
            for (row, state) in states.iter().enumerate() {
                let shown = if row == 0 { 1 } else { arena::SUBSTEPS };
                (0..shown).for_each(|_| packed::push(state, &mut numbers));
            }
        }
    }
    numbers
}

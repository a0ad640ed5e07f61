//! The outputs of the published simulator, read as this project's types.

use phase_model::{
    Action, AgentBody, AgentId, AgentSpec, Attitude, Body, Entity, EventKind, Goal, Grip, LandmarkId, Layout,
    ObjectId, ObjectSpec, PhysicsConfig, RoomId, Scene, Side, Sign, Size, State, Strength, Vec2,
};
use phase_perception::{Cell, CellSet};
use phase_published::Aim;
use serde_json::Value;
use std::path::Path;

/// A file of the reference material beside the project, or `None` (with a message) where there is none.
pub(crate) fn reference(file: &str) -> Option<Value> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared").join(file);
    if !path.is_file() {
        println!("skipped: there is no reference material beside the project");
        return None;
    }
    let text = std::fs::read_to_string(path).expect("a readable file");
    Some(serde_json::from_str(&text).expect("JSON"))
}

/// The cases of a file of outputs of the original.
pub(crate) fn cases(file: &str) -> Option<Vec<Value>> {
    let Value::Array(cases) = reference(&format!("reference/{file}"))?["cases"].take() else {
        panic!("no cases")
    };
    Some(cases)
}

pub(crate) fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

pub(crate) fn text(value: &Value) -> &str {
    value.as_str().expect("a text")
}

pub(crate) fn real(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

pub(crate) fn whole(value: &Value) -> usize {
    usize::try_from(value.as_u64().expect("a whole number")).expect("a small number")
}

/// Source and row of a case, for messages.
pub(crate) fn name(case: &Value) -> String {
    format!("{} t={}", text(&case["source"]), case["t"])
}

pub(crate) fn agent(number: usize) -> AgentId {
    AgentId::ALL[number]
}

pub(crate) fn object(number: usize) -> ObjectId {
    if number == 0 { ObjectId::ZERO } else { ObjectId::ONE }
}

pub(crate) fn entity(number: usize) -> Entity {
    if number < 2 { Entity::Agent(agent(number)) } else { Entity::Object(object(number - 2)) }
}

pub(crate) fn landmark(number: usize) -> LandmarkId {
    room(number).landmark()
}

pub(crate) fn room(number: usize) -> RoomId {
    RoomId::ALL[number]
}

/// A scene of the original's with goals and attitudes that the test chooses.
pub(crate) fn scene(it: &Value, goals: [Goal; 2], attitudes: [Attitude; 2]) -> Scene {
    let size = |k: usize| Size::from_level(whole(&it["sizes"][k]) as u8).expect("a size");
    let spec = |k: usize| AgentSpec {
        size: size(k),
        strength: Strength::from_level(whole(&it["strengths"][k]) as u8).expect("a strength"),
        goal: goals[k],
        attitude: attitudes[k],
        awareness: phase_model::Awareness::default(),
        start: Body::default(),
    };
    Scene {
        layout: layout(it),
        agents: [spec(0), spec(1)],
        objects: [2, 3].map(|k| ObjectSpec { size: size(k), start: Body::default() }).to_vec(),
        kind: EventKind::Independent,
    }
}

pub(crate) fn layout(scene: &Value) -> Layout {
    Layout::new(whole(&scene["base"]) as u8, None).expect("a layout")
}

pub(crate) fn physics(it: &Value) -> PhysicsConfig {
    let radius = |k: usize| Size::from_level(whole(&it["sizes"][k]) as u8).expect("a size").radius();
    let body = |k: usize| {
        let strength = Strength::from_level(whole(&it["strengths"][k]) as u8).expect("a strength");
        AgentBody { radius: radius(k), max_force: strength.max_force() }
    };
    PhysicsConfig {
        walls: layout(it).walls(),
        agents: [body(0), body(1)],
        object_radii: [radius(2), radius(3)],
        object_count: 2,
    }
}

/// A state from its bodies and grips; a grip's side is the nearest.
pub(crate) fn state(bodies: &Value, grips: &Value) -> State {
    let number = |body: &Value, k: usize| real(&body[k]) as f32;
    let bodies: Vec<Body> = list(bodies)
        .iter()
        .map(|it| Body {
            position: Vec2::new(number(it, 0), number(it, 1)),
            velocity: Vec2::new(number(it, 3), number(it, 4)),
            angle: number(it, 2),
            angular_velocity: number(it, 5),
        })
        .collect();
    let mut state = State::new([bodies[0], bodies[1], bodies[2], bodies[3]]);
    for holder in AgentId::ALL {
        if grips[holder.index()].is_null() {
            continue;
        }
        let object = object(whole(&grips[holder.index()]));
        let body = *state.body(Entity::Agent(holder));
        let towards =
            Vec2::from_angle(-body.angle).rotate(state.position(Entity::Object(object)) - body.position);
        let side = Side::ALL
            .into_iter()
            .max_by(|a, b| a.direction().dot(towards).total_cmp(&b.direction().dot(towards)))
            .expect("a side");
        let relative_angle = state.body(Entity::Object(object)).angle - body.angle;
        state.grips[holder] = Some(Grip { object, side, relative_angle });
    }
    state
}

pub(crate) fn cells(rows: &Value) -> CellSet {
    let shown = list(rows).iter().flat_map(|row| text(row).chars()).map(|sign| sign == '#');
    // Cells are numbered from the lower left.
    let shown: Vec<bool> = shown.collect();
    Cell::all()
        .filter(|cell| {
            let centre = cell.centre();
            let (column, row) = ((centre.x - 6.0) as usize, (22.0 - centre.y) as usize);
            shown[row * 20 + column]
        })
        .collect()
}

fn sign(value: &Value) -> Sign {
    if value.as_i64() == Some(-1) { Sign::Negative } else { Sign::Positive }
}

/// A subgoal of the original's.
pub(crate) fn aim(it: &Value) -> Aim {
    let kind = text(&it[0]);
    if kind == "stop" || kind == "noforce" {
        return Aim::Stop;
    }
    let (a, b, sign) = (whole(&it[1]), whole(&it[2]), sign(&it[3]));
    match kind {
        "LMA" => Aim::AgentToLandmark(agent(a), landmark(b), sign),
        "LMO" => Aim::ObjectToLandmark(object(a), landmark(b), sign),
        "TE" => Aim::Touch(agent(a), entity(b), sign),
        "RA" => Aim::AgentToRoom(agent(a), room(b), sign),
        "RO" => Aim::ObjectToRoom(object(a), room(b)),
        "GE" => Aim::Grab(agent(a), object(b - 2), sign),
        _ => panic!("unknown subgoal {it}"),
    }
}

/// A goal of the original's.
pub(crate) fn goal(it: &Value) -> Goal {
    let (a, b, sign) = (whole(&it[1]), whole(&it[2]), sign(&it[3]));
    match text(&it[0]) {
        "LMA" => Goal::AgentOnLandmark { agent: agent(a), landmark: landmark(b), sign },
        "LMO" => Goal::ObjectOnLandmark { object: object(a), landmark: landmark(b), sign },
        "TE" => Goal::Touch { agent: agent(a), other: agent(b), sign },
        _ => panic!("unknown goal {it}"),
    }
}

pub(crate) fn action(name: &Value) -> Action {
    let names = [
        "turnleft",
        "turnright",
        "up",
        "down",
        "left",
        "right",
        "upleft",
        "upright",
        "downleft",
        "downright",
        "stop",
        "noforce",
        "attach",
        "detach",
    ];
    let index = names.iter().position(|it| *it == text(name)).expect("an action");
    Action::ALL[index]
}

/// Cases that agree, and those that do not, of which the first few are printed.
#[derive(Default)]
pub(crate) struct Tally {
    pub(crate) equal: usize,
    pub(crate) different: usize,
}

impl Tally {
    pub(crate) fn add(&mut self, equal: bool, what: impl FnOnce() -> String) {
        const SHOWN: usize = 40;
        if equal {
            self.equal += 1;
        } else {
            self.different += 1;
            if self.different <= SHOWN {
                println!("  {}", what());
            }
        }
    }

    pub(crate) fn total(&self) -> usize {
        self.equal + self.different
    }
}

impl core::fmt::Display for Tally {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{} of {} equal", self.equal, self.total())
    }
}

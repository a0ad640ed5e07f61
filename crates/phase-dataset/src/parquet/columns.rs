//! The columns of the Parquet files, in their order.

use super::{
    column::{Column, Description, TypedColumn},
    row::{goal_kind, goal_other, number},
};
use phase_model::{Knowledge, LandmarkId, arena};

/// Documentation of every column, in the files' order.
#[must_use]
pub fn descriptions() -> Vec<Description> {
    all().iter().map(|column| column.description()).collect()
}

/// A list of columns, each with name, shape, type, unit, description, and how it is taken from an event.
macro_rules! columns {
    ($(($name:literal, $shape:literal, $kind:literal, $unit:literal, $what:literal, $get:expr)),* $(,)?) => {
        vec![$(Box::new(TypedColumn::new(
            Description { name: $name, shape: $shape, kind: $kind, unit: $unit, what: $what },
            $get,
        ))),*]
    };
}

/// All columns, empty.
pub(super) fn all() -> Vec<Box<dyn Column>> {
    [scene(), labels(), motion(), minds()].into_iter().flatten().collect()
}

fn scene() -> Vec<Box<dyn Column>> {
    columns![
        ("id", "", "string", "", "name of the event, different for every event", |row| row
            .recording
            .id
            .clone()),
        ("split", "", "string", "", "`train`, `validation` or `test`", |row| row
            .entry
            .split()
            .name()
            .to_owned()),
        ("seed", "", "uint64", "", "seed from which all chance in the event was derived", |row| row
            .event()
            .seed),
        ("video", "", "string", "", "path of the video in the dataset's folder", |row| row
            .entry
            .video
            .as_ref()
            .map_or_else(String::new, |video| video.path.to_string())),
        ("layout_base", "", "int32", "", "which walls, 0 to 21", |row| i32::from(
            row.recording.scene.layout.base()
        )),
        (
            "layout_flip",
            "",
            "int32",
            "",
            "how they are mirrored: up and down, left and right, two diagonals, 0 to 3; null for not at all",
            |row| { row.recording.scene.layout.flip().map(|flip| i32::from(u8::from(flip))) }
        ),
        (
            "walls",
            "[walls, 4]",
            "float32",
            "u",
            "inner walls after the mirroring as x0, y0, x1, y1; 6 to 26, 2 to 22; the arena's own four walls are left out",
            |row| row.walls()
        ),
        (
            "landmarks",
            "[4, 2]",
            "float32",
            "u",
            "centres x, y of the landmarks; the same in all events",
            |_| { arena::LANDMARKS.iter().map(|centre| vec![centre.x, centre.y]).collect::<Vec<_>>() }
        ),
        ("agent_size_level", "[2]", "int32", "", "0 to 3", |row| row
            .of_agents(|agent| i32::from(agent.size.level()))),
        (
            "agent_radius",
            "[2]",
            "float32",
            "u",
            "half the height of the body: 0.8, 1.2, 1.6 or 1.01",
            |row| row.of_agents(|agent| agent.size.radius())
        ),
        ("agent_strength_level", "[2]", "int32", "", "0 to 3", |row| row
            .of_agents(|agent| i32::from(agent.strength.level()))),
        ("agent_max_force", "[2]", "float32", "N", "greatest force: 150, 300, 450 or 600", |row| row
            .of_agents(|agent| agent.strength.max_force())),
        ("object_size_level", "[objects]", "int32", "", "0 to 3", |row| {
            row.recording
                .scene
                .objects
                .iter()
                .map(|object| i32::from(object.size.level()))
                .collect::<Vec<_>>()
        }),
        ("object_radius", "[objects]", "float32", "u", "0.8, 1.2, 1.6 or 1.01", |row| {
            row.recording.scene.objects.iter().map(|object| object.size.radius()).collect::<Vec<_>>()
        }),
    ]
}

fn labels() -> Vec<Box<dyn Column>> {
    columns![
        (
            "kind",
            "",
            "string",
            "",
            "`helping`, `hindering`, `chasing`, `competing`, `collaborating` or `independent`",
            |row| row.recording.scene.kind.name().to_owned()
        ),
        (
            "variant",
            "",
            "string",
            "",
            "how the kind of event comes about; empty where it is unknown",
            |row| row.entry.variant.map_or_else(String::new, |variant| variant.name().to_owned())
        ),
        (
            "set",
            "",
            "string",
            "",
            "events of one set differ in the stance of one agent alone; empty where there are no sets",
            |row| row.entry.set.as_ref().map_or_else(String::new, |place| place.set.clone())
        ),
        (
            "stance",
            "",
            "string",
            "",
            "in a set, what that agent wants with regard to the other (`help`, `hinder`, `indifferent`, `same` or \
             `rival`), or whether it knows what the other does (`unaware` or `told`)",
            |row| row.entry.set.as_ref().map_or_else(String::new, |place| place.stance.name().to_owned())
        ),
        (
            "manners",
            "[manners]",
            "string",
            "",
            "in what manner one helps or hinders the other or the two meet, by what is seen; may be empty",
            |row| row.entry.manners.iter().map(|manner| manner.name().to_owned()).collect::<Vec<_>>()
        ),
        ("relation", "", "string", "", "`friendly`, `adversarial` or `neutral`", |row| row
            .recording
            .relation
            .name()
            .to_owned()),
        ("alpha", "[2]", "int32", "", "social utility weight: 1 helps, -1 hinders, 0 neither", |row| row
            .of_agents(|agent| i32::from(agent.attitude.alpha()))),
        (
            "knows",
            "[2]",
            "string",
            "",
            "`goals`: it knows the other's goal and strength; `nothing`: it has to infer them",
            |row| row.of_agents(|agent| knows(agent.awareness.knows).to_owned())
        ),
        (
            "level",
            "[2]",
            "int32",
            "",
            "how far an agent that knows nothing reasons about the other's mind, 0 to 2; null for one that \
             knows",
            |row| row.of_agents(|agent| agent
                .awareness
                .knows
                .level()
                .map(|level| i32::from(u8::from(level))))
        ),
        (
            "sees",
            "[2]",
            "string",
            "",
            "of which objects it knows the place: `own`, those it sees; `start`, also where all were at the \
             start; `objects`, all",
            |row| row.of_agents(|agent| agent.awareness.sees.name().to_owned())
        ),
        ("waits", "[2]", "int32", "steps", "steps for which it watches before it acts", |row| row
            .of_agents(|agent| i32::from(agent.awareness.waits))),
        ("goal", "[2]", "string", "", "the goal in words, colours as in the video", |row| row.goal_words()),
        ("goal_kind", "[2]", "string", "", "`agent_on_landmark`, `object_on_landmark` or `touch`", |row| row
            .of_agents(|agent| goal_kind(agent.goal).to_owned())),
        ("goal_entity", "[2]", "int32", "", "whom the goal is about: agents 0, 1, objects 2, 3", |row| row
            .of_agents(|agent| agent.goal.subject().index() as i32)),
        ("goal_landmark", "[2]", "int32", "", "the landmark, 0 to 3; null for `touch`", |row| row
            .of_agents(|agent| number(agent.goal.landmark().map(LandmarkId::index)))),
        ("goal_other", "[2]", "int32", "", "the agent to touch, 0 or 1; null for the others", |row| row
            .of_agents(|agent| goal_other(agent.goal))),
        ("goal_sign", "[2]", "int32", "", "1: to bring about; -1: to avoid or undo", |row| row
            .of_agents(|agent| i32::from(agent.goal.sign().value()))),
        ("reached", "[2]", "bool", "", "whether the goal was reached", |row| row
            .entry
            .agents
            .iter()
            .map(|agent| agent.reached)
            .collect::<Vec<_>>()),
        (
            "steps_to_goal",
            "[2]",
            "int32",
            "steps",
            "steps until it was, 0 to `steps`; null for goals not reached or with sign -1",
            |row| { row.entry.agents.iter().map(|agent| number(agent.steps_to_goal)).collect::<Vec<_>>() }
        ),
    ]
}

fn motion() -> Vec<Box<dyn Column>> {
    columns![
        ("steps", "", "int32", "0.25 s", "length", |row| row.event().steps.len() as i32),
        (
            "trajectory",
            "[steps + 1, entities, 5]",
            "float32",
            "u, u/s, rad",
            "x (6 to 26), y (2 to 22), vx, vy, angle (unbounded) of agents 0, 1 and then the objects; row 0 is the start, row t the mean over the five substeps of step t",
            |row| row.trajectory()
        ),
        (
            "actions",
            "[steps, 2]",
            "string",
            "",
            "`turnleft`, `turnright`, `up`, `down`, `left`, `right`, `upleft`, `upright`, `downleft`, `downright`, `stop`, `noforce`, `attach` or `detach`",
            |row| { row.of_steps(|step, agent| step.actions[agent].name().to_owned()) }
        ),
        (
            "substeps",
            "[5 steps + 1, entities, 6]",
            "float32",
            "u, u/s, rad, rad/s",
            "the same and the angular velocity in every frame of the video: the start, then each substep of 1/60 s",
            |row| row.substeps()
        ),
        (
            "held",
            "[5 steps + 1, 2]",
            "int32",
            "",
            "the object that each agent holds in each frame, 0 or 1, or null",
            |row| row.held()
        ),
        (
            "contacts",
            "[5 steps + 1, pairs, 2]",
            "int32",
            "",
            "the pairs in contact in each frame: agents 0, 1, objects 2, 3",
            |row| row.contacts()
        ),
    ]
}

fn minds() -> Vec<Box<dyn Column>> {
    columns![
        (
            "subgoals",
            "[steps, 2]",
            "string",
            "",
            "the subgoal pursued, such as `Attach(agent 0, object 1)`, `not Touch(agent 0, agent 1)` or `Stay`",
            |row| { row.of_steps(|step, agent| step.thoughts[agent].subgoal.to_string()) }
        ),
        (
            "subgoal_values",
            "[steps, 2]",
            "float64",
            "",
            "its value V; null where no belief particle proposed it",
            |row| row.of_steps(|step, agent| step.thoughts[agent].pursued().map(|proposed| proposed.value))
        ),
        (
            "subgoal_shares",
            "[steps, 2]",
            "float32",
            "",
            "the share of belief particles that propose it, 0 to 1",
            |row| row.of_steps(|step, agent| step.thoughts[agent].share())
        ),
    ]
}

const fn knows(knowledge: Knowledge) -> &'static str {
    match knowledge {
        Knowledge::Goals => "goals",
        Knowledge::Nothing(_) => "nothing",
    }
}

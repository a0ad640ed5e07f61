//! From a scene to JSON.

use crate::{AgentSpec, Body, EventKind, Goal, Layout, ObjectSpec, Scene, Sight};
use serde::Serialize;

/// The members of a scene, in the order of files.
#[derive(Serialize)]
pub(super) struct SceneMembers {
    layout: Layout,
    agents: Vec<AgentMembers>,
    objects: Vec<ObjectMembers>,
    event: EventKind,
}

impl SceneMembers {
    pub(super) fn of(scene: &Scene) -> Self {
        let agent = |agent: &AgentSpec| {
            let start = Some(StartMembers::of(&agent.start));
            AgentMembers { start, ..AgentMembers::without_start(agent) }
        };
        let object = |object: &ObjectSpec| {
            let start = Some(StartMembers::of(&object.start));
            ObjectMembers { start, ..ObjectMembers::without_start(object) }
        };
        Self {
            layout: scene.layout,
            agents: scene.agents.iter().map(agent).collect(),
            objects: scene.objects.iter().map(object).collect(),
            event: scene.kind,
        }
    }
}

/// The members of an agent in files, in their order.
#[derive(Clone, Debug, Serialize)]
pub struct AgentMembers {
    radius: f32,
    size_level: u8,
    max_force: f32,
    strength_level: u8,
    goal: Goal,
    alpha: i8,
    #[serde(skip_serializing_if = "Option::is_none")]
    knows: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    level: Option<u8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sees: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    waits: Option<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    start: Option<StartMembers>,
}

impl AgentMembers {
    /// All members but `start`, for formats that store the starts elsewhere.
    #[must_use]
    pub fn without_start(agent: &AgentSpec) -> Self {
        let level = agent.awareness.knows.level();
        Self {
            radius: agent.size.radius(),
            size_level: agent.size.level(),
            max_force: agent.strength.max_force(),
            strength_level: agent.strength.level(),
            goal: agent.goal,
            alpha: agent.attitude.alpha(),
            knows: level.map(|_| "nothing"),
            level: level.map(u8::from),
            sees: Some(agent.awareness.sees).filter(|&sees| sees != Sight::Own).map(Sight::name),
            waits: (agent.awareness.waits > 0).then_some(agent.awareness.waits),
            start: None,
        }
    }
}

/// The members of an object in files, in their order.
#[derive(Clone, Debug, Serialize)]
pub struct ObjectMembers {
    radius: f32,
    size_level: u8,
    #[serde(skip_serializing_if = "Option::is_none")]
    start: Option<StartMembers>,
}

impl ObjectMembers {
    /// All members but `start`, for formats that store the starts elsewhere.
    #[must_use]
    pub const fn without_start(object: &ObjectSpec) -> Self {
        Self { radius: object.size.radius(), size_level: object.size.level(), start: None }
    }
}

#[derive(Clone, Debug, Serialize)]
struct StartMembers {
    x: f32,
    y: f32,
    vx: f32,
    vy: f32,
    angle: f32,
    angular_velocity: f32,
}

impl StartMembers {
    const fn of(start: &Body) -> Self {
        let Body { position, velocity, angle, angular_velocity } = *start;
        Self { x: position.x, y: position.y, vx: velocity.x, vy: velocity.y, angle, angular_velocity }
    }
}

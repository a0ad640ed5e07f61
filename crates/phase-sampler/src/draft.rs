//! Drawing the parts of a scene.

use phase_model::{
    AgentId, Attitude, Awareness, Body, Entity, EventKind, Goal, LandmarkId, Layout, MAX_OBJECTS, ObjectId,
    RoomId, Scene, Sign, Size, SlotId, Strength, Vec2, arena,
    scene::{AgentSpec, ObjectSpec},
};
use phase_navigation::Crossing;
use rand::{Rng, RngExt};
use serde::{Deserialize, Serialize};

/// Largest distance of a body at the start from its start point in each direction (u).
const START_JITTER: f32 = 0.6;
/// Width of the narrow doors (u).
const NARROW_DOOR_WIDTH: f32 = 2.5;
/// Strengths of agents that can move objects alone.
pub const SELF_SUFFICIENT: [Strength; 3] = [Strength::Fair, Strength::Strong, Strength::Mighty];
/// Sizes that do not fit through narrow doors.
pub const LARGE_SIZES: [Size; 3] = [Size::Large, Size::Huge, Size::Medium];

/// The number of objects of a scene.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Objects {
    /// Those that the goals are about, and in half of the scenes one more.
    #[default]
    Varied,
    /// Two, whatever the goals are about, so that their number reveals nothing.
    Two,
}

/// The places of bodies at the start.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Starts {
    /// Anywhere near the points at which bodies may start.
    #[default]
    Near,
    /// On these points, as in the published recordings. A body that a variant needs in another place, such as
    /// a door, stays there.
    Grid,
}

impl Starts {
    /// Both values, the default first.
    pub const ALL: [Self; 2] = [Self::Near, Self::Grid];

    /// The name used in files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Near => "near",
            Self::Grid => "grid",
        }
    }

    /// The place of a body that was drawn near a point.
    pub(crate) fn place(self, drawn: Vec2) -> Vec2 {
        let near = |point: &&Vec2| {
            let off = (drawn - **point).abs();
            off.x <= START_JITTER && off.y <= START_JITTER
        };
        match self {
            Self::Near => drawn,
            Self::Grid => arena::START_POINTS.iter().flatten().find(near).copied().unwrap_or(drawn),
        }
    }
}

/// Agents and objects, not yet in an arena.
#[derive(Clone, Debug)]
pub struct SceneDraft {
    /// Roles 0 and 1.
    pub agents: [AgentSpec; 2],
    /// The objects that goals are about.
    goal_objects: Vec<ObjectSpec>,
    /// The first of them has this number; the others follow.
    first_goal_object: usize,
}

impl SceneDraft {
    /// Agents and the objects that their goals are about, in the order of the goals. `None` if the goals are
    /// about more or other objects.
    #[must_use]
    pub fn about(goals: [Goal; 2], agents: [AgentSpec; 2], goal_objects: Vec<ObjectSpec>) -> Option<Self> {
        let numbers: Vec<usize> = goals.into_iter().filter_map(object_of).map(ObjectId::index).collect();
        let first_goal_object = numbers.iter().copied().min().unwrap_or(0);
        // An object that only blocks a door is not part of a goal.
        let count = numbers.iter().max().map_or(goal_objects.len(), |&last| last - first_goal_object + 1);
        (count == goal_objects.len()).then_some(Self { agents, goal_objects, first_goal_object })
    }

    /// The scene. Distractor objects come first where the goals are about a later object; otherwise one is
    /// added in half of the cases, or as many as are missing of two.
    pub fn into_scene(
        self,
        kind: EventKind,
        layout: Layout,
        (count, starts): (Objects, Starts),
        random: &mut dyn Rng,
    ) -> Scene {
        let stray = |random: &mut dyn Rng| object(any_size(random), any_room(random), random);
        let first = self.first_goal_object;
        let mut objects: Vec<ObjectSpec> = (0..first).map(|_| stray(random)).collect();
        objects.extend(self.goal_objects);
        match count {
            Objects::Varied => {
                let another = stray(random);
                if objects.len() < MAX_OBJECTS && random.random_bool(0.5) {
                    objects.push(another);
                }
            }
            Objects::Two => objects.resize_with(MAX_OBJECTS, || stray(random)),
        }
        let mut agents = self.agents;
        let bodies = agents.iter_mut().map(|agent| &mut agent.start);
        for body in bodies.chain(objects.iter_mut().map(|object| &mut object.start)) {
            body.position = starts.place(body.position);
        }
        Scene { layout, agents, objects, kind }
    }
}

/// One of several equally likely items. The slice must not be empty.
pub fn choose<T: Copy>(options: &[T], random: &mut dyn Rng) -> T {
    options[random.random_range(0..options.len())]
}

/// A room other than those given, if there is one.
pub fn other_room(taken: &[RoomId], random: &mut dyn Rng) -> Option<RoomId> {
    let free: Vec<RoomId> = RoomId::ALL.into_iter().filter(|room| !taken.contains(room)).collect();
    (!free.is_empty()).then(|| choose(&free, random))
}

/// Any of the four rooms.
pub fn any_room(random: &mut dyn Rng) -> RoomId {
    choose(&RoomId::ALL, random)
}

/// Any of the four sizes.
pub fn any_size(random: &mut dyn Rng) -> Size {
    choose(&Size::ALL, random)
}

/// A narrow door of a room, which only the smallest agents fit through, and the room beyond it.
pub fn narrow_door_of(layout: Layout, room: RoomId, random: &mut dyn Rng) -> Option<(SlotId, RoomId)> {
    let is_narrow = |door: &Crossing| door.opening.length() <= NARROW_DOOR_WIDTH;
    let doors: Vec<(SlotId, RoomId)> =
        Crossing::out_of(layout, room).filter(is_narrow).map(|door| (door.slot, door.to)).collect();
    (!doors.is_empty()).then(|| choose(&doors, random))
}

/// A body at rest near one of a room's start points, facing anywhere.
pub fn start_in(room: RoomId, random: &mut dyn Rng) -> Body {
    let point = choose(&arena::START_POINTS[room], random);
    let jitter = Vec2::new(
        random.random_range(-START_JITTER..START_JITTER),
        random.random_range(-START_JITTER..START_JITTER),
    );
    Body::at_rest(point + jitter, any_angle(random))
}

/// A direction (rad).
pub fn any_angle(random: &mut dyn Rng) -> f32 {
    random.random_range(-core::f32::consts::PI..core::f32::consts::PI)
}

/// A neutral agent.
pub fn agent(size: Size, strength: Strength, goal: Goal, room: RoomId, random: &mut dyn Rng) -> AgentSpec {
    AgentSpec {
        size,
        strength,
        goal,
        attitude: Attitude::Neutral,
        awareness: Awareness::default(),
        start: start_in(room, random),
    }
}

/// This agent with the attitude of helping.
#[must_use]
pub const fn helping(agent: AgentSpec) -> AgentSpec {
    AgentSpec { attitude: Attitude::Help, ..agent }
}

/// This agent with the attitude of hindering.
#[must_use]
pub const fn hindering(agent: AgentSpec) -> AgentSpec {
    AgentSpec { attitude: Attitude::Hinder, ..agent }
}

/// An object.
pub fn object(size: Size, room: RoomId, random: &mut dyn Rng) -> ObjectSpec {
    let mut start = start_in(room, random);
    start.angle = 0.0;
    ObjectSpec { size, start }
}

/// The goal of being on a landmark.
#[must_use]
pub const fn agent_on(agent: AgentId, landmark: LandmarkId) -> Goal {
    Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive }
}

/// The goal that an object is on a landmark.
#[must_use]
pub const fn object_on(object: ObjectId, landmark: LandmarkId) -> Goal {
    Goal::ObjectOnLandmark { object, landmark, sign: Sign::Positive }
}

/// The object that a goal is about.
#[must_use]
pub const fn object_of(goal: Goal) -> Option<ObjectId> {
    match goal.subject() {
        Entity::Object(object) => Some(object),
        Entity::Agent(_) => None,
    }
}

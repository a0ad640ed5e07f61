//! Drawing the parts of a scene.

use phase_model::{
    Attitude, Body, Goal, Layout, Sign, Size, Strength, Vec2, arena,
    layout::{Room, SLOT_ROOMS},
    scene::{AgentSpec, ObjectSpec},
};
use rand::{Rng, RngExt};

/// How far a body may start from its start point in each direction (u).
const JITTER: f32 = 0.6;
/// Width of the narrow doors (u).
const NARROW: f32 = 2.5;

/// One of several equally likely things. The slice must not be empty.
pub fn choose<T: Copy>(options: &[T], random: &mut impl Rng) -> T {
    options[random.random_range(0..options.len())]
}

/// A room other than those given, if there is one.
pub fn other_room(taken: &[Room], random: &mut impl Rng) -> Option<Room> {
    let free: Vec<Room> = (0..4).filter(|room| !taken.contains(room)).collect();
    (!free.is_empty()).then(|| choose(&free, random))
}

/// One of the paper's 90 layouts.
pub fn layout(random: &mut impl Rng) -> Layout {
    let all: Vec<Layout> = Layout::all_used().collect();
    choose(&all, random)
}

/// The doors (slots) of a layout that are narrow: only the smallest agents fit.
#[must_use]
pub fn narrow_doors(layout: Layout) -> Vec<usize> {
    (0..4).filter(|&slot| layout.opening(slot).is_some_and(|opening| opening.length() <= NARROW)).collect()
}

/// The two rooms at a slot in random order.
pub fn sides(slot: usize, random: &mut impl Rng) -> (Room, Room) {
    let (a, b) = SLOT_ROOMS[slot];
    if random.random_bool(0.5) { (a, b) } else { (b, a) }
}

/// A body at rest near one of a room's start points, facing anywhere.
pub fn start_in(room: Room, random: &mut impl Rng) -> Body {
    let point = choose(&arena::START_POINTS[room], random);
    let jitter = Vec2::new(random.random_range(-JITTER..JITTER), random.random_range(-JITTER..JITTER));
    let angle = random.random_range(-core::f32::consts::PI..core::f32::consts::PI);
    Body::at_rest(point + jitter, angle)
}

/// A neutral agent.
pub fn agent(size: Size, strength: Strength, goal: Goal, room: Room, random: &mut impl Rng) -> AgentSpec {
    AgentSpec { size, strength, goal, attitude: Attitude::Neutral, start: start_in(room, random) }
}

/// An object.
pub fn object(size: Size, room: Room, random: &mut impl Rng) -> ObjectSpec {
    let mut start = start_in(room, random);
    start.angle = 0.0;
    ObjectSpec { size, start }
}

/// The goal of being on a landmark.
#[must_use]
pub const fn agent_on(agent: u8, landmark: Room) -> Goal {
    Goal::AgentOnLandmark { agent, landmark: landmark as u8, sign: Sign::Positive }
}

/// The goal of an object's being on a landmark.
#[must_use]
pub const fn object_on(object: u8, landmark: Room) -> Goal {
    Goal::ObjectOnLandmark { object, landmark: landmark as u8, sign: Sign::Positive }
}

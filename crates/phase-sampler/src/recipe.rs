//! A recipe for each kind of event.

use crate::{
    draft::{self, agent, agent_on, choose, object, object_on},
    feasibility,
};
use phase_model::{
    Attitude, EventKind, Goal, Scene, Sign, Size, Strength,
    layout::{Room, SLOT_DIRECTIONS},
    scene::{AgentSpec, ObjectSpec},
};
use rand::{Rng, RngExt};
use thiserror::Error;

/// Draws before a kind is given up; in practice a few dozen suffice.
const MAX_DRAWS: usize = 20_000;
/// Strengths of agents that can move objects alone.
const CAPABLE: [Strength; 3] = [Strength::Fair, Strength::Strong, Strength::Mighty];
/// Sizes that do not fit through narrow doors.
const BIG: [Size; 3] = [Size::Large, Size::Huge, Size::Medium];
/// Distance of a blocking object's centre from a door's line, beyond its radius (u).
const BLOCKING_GAP: f32 = 0.3;

/// No scene of the kind turned up.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
#[error("no {} scene was found in {MAX_DRAWS} draws", .0.name())]
pub struct SampleError(pub EventKind);

/// Draws a scene of a kind. No body overlaps another or a wall, no goal holds at the start, and what the kind
/// asks of the agents is within their means.
///
/// # Errors
/// [`SampleError`] if the draws run out, which would be a fault of the recipe.
pub fn sample(kind: EventKind, random: &mut impl Rng) -> Result<Scene, SampleError> {
    for _ in 0..MAX_DRAWS {
        let draft = match kind {
            EventKind::Helping => helping(random),
            EventKind::Hindering => hindering(random),
            EventKind::Chasing => chasing(random),
            EventKind::Competing => competing(random),
            EventKind::Collaborating => collaborating(random),
            EventKind::Independent => independent(random),
        };
        if let Some(scene) = draft
            && scene.validate_apart().is_ok()
            && is_open(&scene)
            && makes_sense(&scene)
        {
            return Ok(scene);
        }
    }
    Err(SampleError(kind))
}

/// Whether nothing that somebody wants holds at the start.
fn is_open(scene: &Scene) -> bool {
    scene.goals().iter().all(|&goal| {
        let positive = if goal.sign() == Sign::Positive { goal } else { goal.negated() };
        !feasibility::solved(scene, positive)
    })
}

/// Whether the agents can do what the kind asks of them.
fn makes_sense(scene: &Scene) -> bool {
    let [first, second] = scene.goals();
    match scene.kind {
        EventKind::Helping => {
            let alone = feasibility::cost(scene, second, [false, true]);
            let both = feasibility::cost(scene, second, [true, true]);
            both < feasibility::IMPOSSIBLE && alone > both * 1.5
        }
        EventKind::Hindering => feasibility::alone(scene, 1, second),
        EventKind::Chasing => feasibility::alone(scene, 0, first),
        EventKind::Competing | EventKind::Independent => {
            feasibility::alone(scene, 0, first) && feasibility::alone(scene, 1, second)
        }
        EventKind::Collaborating => feasibility::together(scene, first),
    }
}

/// A scene from its parts; a second object, which nobody wants, lies about in half of the cases.
fn scene(
    kind: EventKind,
    layout: phase_model::Layout,
    agents: [AgentSpec; 2],
    mut objects: Vec<ObjectSpec>,
    random: &mut impl Rng,
) -> Option<Scene> {
    if objects.len() < 2 && random.random_bool(0.5) {
        objects.push(object(choose(&Size::ALL, random), random.random_range(0..4), random));
    }
    Some(Scene { layout, agents, objects, kind })
}

fn any_room(random: &mut impl Rng) -> Room {
    random.random_range(0..4)
}

fn helping(random: &mut impl Rng) -> Option<Scene> {
    match random.random_range(0..3) {
        0 => lifting(random),
        1 => fetching(random),
        _ => clearing(random),
    }
}

/// The helpee is too weak for the object it wants moved.
fn lifting(random: &mut impl Rng) -> Option<Scene> {
    let layout = draft::layout(random);
    let room = any_room(random);
    let landmark = draft::other_room(&[room], random)?;
    let goal = object_on(0, landmark);
    let mut helper =
        agent(choose(&Size::ALL, random), choose(&CAPABLE, random), goal, any_room(random), random);
    helper.attitude = Attitude::Help;
    let helpee = agent(choose(&Size::ALL, random), Strength::Weak, goal, room, random);
    let objects = vec![object(choose(&Size::ALL, random), room, random)];
    scene(EventKind::Helping, layout, [helper, helpee], objects, random)
}

/// The helpee is too big for the door behind which its object lies.
fn fetching(random: &mut impl Rng) -> Option<Scene> {
    let layout = draft::layout(random);
    let doors = draft::narrow_doors(layout);
    if doors.is_empty() {
        return None;
    }
    let (inside, outside) = draft::sides(choose(&doors, random), random);
    let goal = object_on(0, outside);
    let mut helper = agent(choose(&Size::ALL, random), choose(&CAPABLE, random), goal, inside, random);
    helper.attitude = Attitude::Help;
    let helpee = agent(choose(&BIG, random), choose(&CAPABLE, random), goal, outside, random);
    let objects = vec![object(Size::Small, inside, random)];
    scene(EventKind::Helping, layout, [helper, helpee], objects, random)
}

/// A big object stands before the door that the helpee has to go through.
fn clearing(random: &mut impl Rng) -> Option<Scene> {
    let layout = draft::layout(random);
    let doors = draft::narrow_doors(layout);
    if doors.is_empty() {
        return None;
    }
    let slot = choose(&doors, random);
    let (here, beyond) = draft::sides(slot, random);
    let goal = agent_on(1, beyond);
    let mut helper = agent(choose(&Size::ALL, random), Strength::Mighty, goal, beyond, random);
    helper.attitude = Attitude::Help;
    let helpee = agent(Size::Small, choose(&[Strength::Weak, Strength::Fair], random), goal, here, random);
    let mut blocker = object(Size::Huge, beyond, random);
    let middle = layout.opening(slot)?.middle();
    let across = SLOT_DIRECTIONS[slot].perp();
    let towards = across * across.dot(phase_model::arena::LANDMARKS[beyond] - middle).signum();
    blocker.start.position = middle + towards * (Size::Huge.radius() + BLOCKING_GAP);
    scene(EventKind::Helping, layout, [helper, helpee], vec![blocker], random)
}

fn hindering(random: &mut impl Rng) -> Option<Scene> {
    let layout = draft::layout(random);
    let room = any_room(random);
    let landmark = draft::other_room(&[room], random)?;
    let about_object = random.random_bool(0.5);
    let goal = if about_object { object_on(0, landmark) } else { agent_on(1, landmark) };
    let mut hinderer =
        agent(choose(&Size::ALL, random), choose(&CAPABLE, random), goal.negated(), any_room(random), random);
    hinderer.attitude = Attitude::Hinder;
    let victim = agent(choose(&Size::ALL, random), choose(&CAPABLE, random), goal, room, random);
    let place = draft::other_room(&[landmark], random)?;
    let objects =
        if about_object { vec![object(choose(&Size::ALL, random), place, random)] } else { Vec::new() };
    scene(EventKind::Hindering, layout, [hinderer, victim], objects, random)
}

fn chasing(random: &mut impl Rng) -> Option<Scene> {
    let layout = draft::layout(random);
    let room = any_room(random);
    let other = draft::other_room(&[room], random)?;
    let chase = Goal::Touch { agent: 0, other: 1, sign: Sign::Positive };
    let chaser = agent(choose(&Size::ALL, random), choose(&CAPABLE, random), chase, room, random);
    let fleer = agent(choose(&Size::ALL, random), choose(&CAPABLE, random), chase.negated(), other, random);
    scene(EventKind::Chasing, layout, [chaser, fleer], Vec::new(), random)
}

fn competing(random: &mut impl Rng) -> Option<Scene> {
    let layout = draft::layout(random);
    let room = any_room(random);
    let first = draft::other_room(&[room], random)?;
    let second = draft::other_room(&[room, first], random)?;
    let agents = [object_on(0, first), object_on(0, second)].map(|goal| {
        agent(choose(&Size::ALL, random), choose(&CAPABLE, random), goal, any_room(random), random)
    });
    let objects = vec![object(choose(&Size::ALL, random), room, random)];
    scene(EventKind::Competing, layout, agents, objects, random)
}

fn collaborating(random: &mut impl Rng) -> Option<Scene> {
    let layout = draft::layout(random);
    let room = any_room(random);
    let landmark = draft::other_room(&[room], random)?;
    let goal = object_on(0, landmark);
    // Equal strengths, as the published scripts draw them; two of the weakest cannot move anything together.
    let strength = choose(&CAPABLE, random);
    let agents =
        [(), ()].map(|()| agent(choose(&Size::ALL, random), strength, goal, any_room(random), random));
    let objects = vec![object(choose(&Size::ALL, random), room, random)];
    scene(EventKind::Collaborating, layout, agents, objects, random)
}

fn independent(random: &mut impl Rng) -> Option<Scene> {
    let layout = draft::layout(random);
    let mut objects = Vec::new();
    let mut wanted: Vec<Room> = Vec::new();
    let mut agents = Vec::new();
    for who in 0..2_u8 {
        let landmark = draft::other_room(&wanted, random)?;
        wanted.push(landmark);
        let (goal, strengths) = if random.random_bool(0.5) {
            let room = draft::other_room(&[landmark], random)?;
            objects.push(object(choose(&Size::ALL, random), room, random));
            (object_on(objects.len() as u8 - 1, landmark), &CAPABLE[..])
        } else {
            (agent_on(who, landmark), &Strength::ALL[..])
        };
        let room = any_room(random);
        agents.push(agent(choose(&Size::ALL, random), choose(strengths, random), goal, room, random));
    }
    let agents = <[AgentSpec; 2]>::try_from(agents).ok()?;
    scene(EventKind::Independent, layout, agents, objects, random)
}

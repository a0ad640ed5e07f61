//! An agent's observation as a vector.
//!
//! The agent comes first, then the other, then the objects. Everything that is not observed is 0. The last
//! parts say what both agents know of the scene: bodies, doors, both goals, and the agent's own attitude (the
//! paper: "we assume agents know each other's goals").

use crate::error::raise;
use phase_model::{
    AGENT_COUNT, AgentId, Body, BodySet, Contacts, Entity, Goal, Grip, LandmarkId, MAX_ENTITIES, ObjectId,
    PhysicsConfig, Scene, Side, SlotId, State, Vec2, arena,
};
use phase_perception::{Cell, CellSet, Observation, cells::CELL_COUNT};
use pyo3::PyResult;

/// A part of the vector: its name and its shape, in order.
const PARTS: [(&str, &[usize]); 13] = [
    // Of each entity: present, observed, touched, x, y, cos(angle), sin(angle), angle, vx, vy, angular
    // velocity.
    ("entities", &[MAX_ENTITIES, ENTITY_NUMBERS]),
    // Of each agent: object 0 held, object 1 held, by head, tail, right, left, the object's angle minus the
    // agent's.
    ("grips", &[AGENT_COUNT, GRIP_NUMBERS]),
    // Of each pair of entities, in the order of `PAIRS`: whether they are in contact.
    ("contacts", &[PAIRS.len()]),
    // Of each cell of the arena, row by row from the bottom left: whether it is in the field of view.
    ("visible", &[20, 20]),
    // Radius of each entity (u); 0 for an absent object.
    ("radii", &[MAX_ENTITIES]),
    // Maximum force of each agent (N / 100).
    ("forces", &[AGENT_COUNT]),
    // Of each of the four inner walls: where its door begins and ends, from the centre (u); 0, 0 without a
    // door.
    ("doors", &[4, 2]),
    ("attitude", &[1]),
    // Of the agent's goal: its kind, its subject, its landmark (one of each is 1), its sign.
    ("own_goal", &[GOAL_NUMBERS]),
    ("other_goal", &[GOAL_NUMBERS]),
    // Whether either goal holds, as far as the agent observes its subject.
    ("holds", &[AGENT_COUNT]),
    // The position of each landmark (u): always the same, for learners.
    ("landmarks", &[4, 2]),
    // Number of the agent.
    ("agent", &[1]),
];

const ENTITY_NUMBERS: usize = 11;
const GRIP_NUMBERS: usize = 7;
const GOAL_NUMBERS: usize = 12;
/// Maximum forces are divided by this (N).
const FORCE_UNIT: f32 = 100.0;
/// All pairs of entities, in the agent's order.
const PAIRS: [(usize, usize); 6] = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];

/// Numbers in an observation.
pub(crate) const SIZE: usize = {
    let mut sum = 0;
    let mut part = 0;
    while part < PARTS.len() {
        sum += length(part);
        part += 1;
    }
    sum
};

/// Numbers in a part.
const fn length(part: usize) -> usize {
    let shape = PARTS[part].1;
    let mut product = 1;
    let mut k = 0;
    while k < shape.len() {
        product *= shape[k];
        k += 1;
    }
    product
}

/// Numbers in the parts that change, before those that describe the scene.
const MOVING: usize = length(0) + length(1) + length(2) + length(3);

/// Name and shape of each part, in order.
pub(crate) fn parts() -> Vec<(&'static str, Vec<usize>)> {
    PARTS.iter().map(|(name, shape)| (*name, shape.to_vec())).collect()
}

/// Writes observations of one scene.
#[derive(Clone, Debug)]
pub(crate) struct Encoder {
    physics: PhysicsConfig,
    goals: [Goal; AGENT_COUNT],
    /// The numbers that do not change, for each agent.
    scene: [Vec<f32>; AGENT_COUNT],
}

impl Encoder {
    pub(crate) fn new(scene: &Scene) -> Self {
        let physics = scene.physics();
        let of = |agent| scene_numbers(scene, &physics, agent);
        Self { scene: AgentId::ALL.map(of), goals: scene.goals(), physics }
    }

    /// Writes what an agent observes into a vector of [`SIZE`] numbers.
    pub(crate) fn write(&self, observation: &Observation, out: &mut [f32]) {
        let agent = observation.agent;
        let order = order(agent);
        out.fill(0.0);
        let (entities, rest) = out.split_at_mut(length(0));
        for (numbers, entity) in entities.chunks_exact_mut(ENTITY_NUMBERS).zip(order) {
            let present = self.physics.radius(entity) > 0.0;
            numbers[0] = f32::from(u8::from(present));
            numbers[2] = f32::from(u8::from(observation.touched.contains(entity)));
            let Some(body) = observation.body(entity).filter(|_| present) else { continue };
            let Body { position, angle, velocity, angular_velocity } = *body;
            let sine = libm::sinf(angle);
            let cosine = libm::cosf(angle);
            numbers[1] = 1.0;
            numbers[3..].copy_from_slice(&[
                position.x,
                position.y,
                cosine,
                sine,
                angle,
                velocity.x,
                velocity.y,
                angular_velocity,
            ]);
        }
        let (grips, rest) = rest.split_at_mut(length(1));
        for (numbers, holder) in grips.chunks_exact_mut(GRIP_NUMBERS).zip([agent, agent.other()]) {
            if let Some(Some(grip)) = observation.grip(holder) {
                numbers[usize::from(grip.object)] = 1.0;
                numbers[2 + Side::ALL.iter().position(|&side| side == grip.side).unwrap_or_default()] = 1.0;
                numbers[6] = grip.relative_angle;
            }
        }
        let (contacts, rest) = rest.split_at_mut(length(2));
        for (number, (a, b)) in contacts.iter_mut().zip(PAIRS) {
            *number = f32::from(u8::from(observation.contacts().touching(order[a], order[b])));
        }
        let (visible, rest) = rest.split_at_mut(CELL_COUNT);
        for cell in observation.visible.iter() {
            visible[cell.index()] = 1.0;
        }
        rest.copy_from_slice(&self.scene[agent]);
        let holds = length(4) + length(5) + length(6) + length(7) + length(8) + length(9);
        let known = State { grips: [None; AGENT_COUNT], ..known_state(observation) };
        for (number, whose) in rest[holds..].iter_mut().zip([agent, agent.other()]) {
            let goal = self.goals[whose];
            let seen = involved(goal).all(|entity| observation.observed.contains(entity));
            let holds = seen && phase_predicates::achieved(&self.physics, &known, goal);
            *number = f32::from(u8::from(holds));
        }
    }
}

/// The entities whose places decide whether a goal holds.
fn involved(goal: Goal) -> impl Iterator<Item = Entity> {
    let target = match goal {
        Goal::Touch { other, .. } => Some(Entity::Agent(other)),
        Goal::AgentOnLandmark { .. } | Goal::ObjectOnLandmark { .. } => None,
    };
    [Some(goal.subject()), target].into_iter().flatten()
}

/// The state as far as it is observed: other bodies are at the origin.
fn known_state(observation: &Observation) -> State {
    let mut state = State::new([Body::default(); MAX_ENTITIES]);
    for entity in observation.observed.iter() {
        if let Some(body) = observation.body(entity) {
            *state.body_mut(entity) = *body;
        }
    }
    state.contacts = observation.contacts();
    state
}

/// Reads the observation of an agent from a vector, as [`Encoder::write`] wrote it.
///
/// # Errors
/// `PhaseError` for a number that is not finite, and for an observation of another agent.
pub(crate) fn read(agent: AgentId, numbers: &[f32]) -> PyResult<Observation> {
    if numbers.len() != SIZE {
        return Err(raise(format!("an observation has {SIZE} numbers, not {}", numbers.len())));
    }
    if let Some(k) = numbers.iter().position(|number| !number.is_finite()) {
        return Err(raise(format!("an observation has finite numbers; number {k} is {}", numbers[k])));
    }
    let whose = numbers[SIZE - 1];
    if whose != f32::from(agent.number()) {
        return Err(raise(format!("the observation is of agent {whose}, not of agent {}", agent.number())));
    }
    let order = order(agent);
    let (moving, _) = numbers.split_at(MOVING);
    let (entities, rest) = moving.split_at(length(0));
    let mut known = State::new([Body::default(); MAX_ENTITIES]);
    let mut observed = BodySet::EMPTY;
    let mut touched = BodySet::EMPTY;
    for (numbers, entity) in entities.chunks_exact(ENTITY_NUMBERS).zip(order) {
        if numbers[2] > 0.5 {
            touched.insert(entity);
        }
        if numbers[1] > 0.5 {
            observed.insert(entity);
            *known.body_mut(entity) = Body {
                position: Vec2::new(numbers[3], numbers[4]),
                angle: numbers[7],
                velocity: Vec2::new(numbers[8], numbers[9]),
                angular_velocity: numbers[10],
            };
        }
    }
    if !observed.contains(Entity::Agent(agent)) {
        return Err(raise("an agent always observes itself: entity 0 of its observation must be observed"));
    }
    let (grips, rest) = rest.split_at(length(1));
    for (numbers, holder) in grips.chunks_exact(GRIP_NUMBERS).zip([agent, agent.other()]) {
        let object = ObjectId::ALL.into_iter().find(|&object| numbers[usize::from(object)] > 0.5);
        let side = Side::ALL.into_iter().zip(&numbers[2..6]).find(|(_, number)| **number > 0.5);
        if let (Some(object), Some((side, _))) = (object, side) {
            known.grips[holder] = Some(Grip { object, side, relative_angle: numbers[6] });
        }
    }
    let (contacts, visible) = rest.split_at(length(2));
    known.contacts = Contacts::NONE;
    for (number, (a, b)) in contacts.iter().zip(PAIRS) {
        if *number > 0.5 {
            known.contacts.insert(order[a], order[b]);
        }
    }
    let mut cells = CellSet::EMPTY;
    for (cell, number) in Cell::all().zip(visible) {
        if *number > 0.5 {
            cells.insert(cell);
        }
    }
    Ok(Observation::from_parts(agent, cells, observed, touched, &known))
}

/// The entities in the order in which an agent's observation has them.
const fn order(agent: AgentId) -> [Entity; MAX_ENTITIES] {
    let [first, second] = ObjectId::ALL;
    [Entity::Agent(agent), Entity::Agent(agent.other()), Entity::Object(first), Entity::Object(second)]
}

/// The parts that describe the scene.
fn scene_numbers(scene: &Scene, physics: &PhysicsConfig, agent: AgentId) -> Vec<f32> {
    let mut numbers = Vec::with_capacity(SIZE - MOVING);
    numbers.extend(order(agent).map(|entity| physics.radius(entity)));
    numbers.extend([agent, agent.other()].map(|agent| physics.agents[agent].max_force / FORCE_UNIT));
    for slot in SlotId::ALL {
        let door = scene.layout.opening(slot);
        numbers.extend(door.map_or([0.0; 2], |door| [door.a, door.b].map(|end| end.distance(arena::CENTRE))));
    }
    numbers.push(f32::from(scene.agents[agent].attitude.alpha()));
    numbers.extend(goal_numbers(scene.goals()[agent], agent));
    numbers.extend(goal_numbers(scene.goals()[agent.other()], agent));
    numbers.extend([0.0; AGENT_COUNT]);
    numbers.extend(LandmarkId::ALL.into_iter().flat_map(|landmark| arena::LANDMARKS[landmark].to_array()));
    numbers.push(f32::from(agent.number()));
    numbers
}

/// A goal, for an agent: its kind (agent on landmark, object on landmark, touch), its subject in the agent's
/// order, its landmark, its sign.
fn goal_numbers(goal: Goal, agent: AgentId) -> [f32; GOAL_NUMBERS] {
    let mut numbers = [0.0; GOAL_NUMBERS];
    let kind = match goal {
        Goal::AgentOnLandmark { .. } => 0,
        Goal::ObjectOnLandmark { .. } => 1,
        Goal::Touch { .. } => 2,
    };
    numbers[kind] = 1.0;
    let subject = order(agent).iter().position(|&entity| entity == goal.subject());
    numbers[3 + subject.unwrap_or_default()] = 1.0;
    if let Some(landmark) = goal.landmark() {
        numbers[7 + usize::from(landmark)] = 1.0;
    }
    numbers[11] = f32::from(i8::from(goal.sign()));
    numbers
}

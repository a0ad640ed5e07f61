//! From observations to vectors.

use super::{
    CONTACTS, ENTITIES, ENTITY_NUMBERS, GOAL_NUMBERS, GRIP_NUMBERS, GRIPS, HOLDS, MOVING, PAIRS, SIZE,
    VISIBLE, order, range,
};
use phase_model::{
    AGENT_COUNT, AgentId, Body, Entity, Goal, LandmarkId, MAX_ENTITIES, PhysicsConfig, Scene, Side, SlotId,
    State, arena,
};
use phase_perception::Observation;

/// Maximum forces are divided by this (N).
const FORCE_UNIT: f32 = 100.0;

/// Writes the observations that agents make in one scene as vectors.
///
/// The numbers that do not change during an event are computed once, when the writer is made.
#[derive(Clone, Debug)]
pub struct VectorWriter {
    physics: PhysicsConfig,
    goals: [Goal; AGENT_COUNT],
    /// The numbers after [`MOVING`] for each agent, without those that say whether goals hold.
    scene: [Vec<f32>; AGENT_COUNT],
}

impl VectorWriter {
    /// A writer for the observations of both agents of a scene.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let physics = scene.physics();
        let numbers = AgentId::ALL.map(|agent| scene_numbers(scene, &physics, agent));
        Self { scene: numbers, goals: scene.goals(), physics }
    }

    /// Writes an observation, made in the writer's scene by either agent, into a slice of [`SIZE`] numbers.
    ///
    /// All numbers are overwritten.
    ///
    /// # Panics
    /// If the slice has another length.
    pub fn write(&self, observation: &Observation, out: &mut [f32]) {
        out.fill(0.0);
        out[MOVING..].copy_from_slice(&self.scene[observation.agent]);
        self.write_entities(observation, &mut out[range(ENTITIES)]);
        write_grips(observation, &mut out[range(GRIPS)]);
        write_contacts(observation, &mut out[range(CONTACTS)]);
        for cell in observation.visible.iter() {
            out[range(VISIBLE)][cell.index()] = 1.0;
        }
        self.write_holds(observation, &mut out[range(HOLDS)]);
    }

    fn write_entities(&self, observation: &Observation, out: &mut [f32]) {
        for (numbers, entity) in out.chunks_exact_mut(ENTITY_NUMBERS).zip(order(observation.agent)) {
            let present = self.physics.radius(entity) > 0.0;
            numbers[0] = number_of(present);
            numbers[2] = number_of(observation.touched.contains(entity));
            let Some(body) = observation.body(entity).filter(|_| present) else { continue };
            let Body { position, angle, velocity, angular_velocity } = *body;
            numbers[1] = 1.0;
            numbers[3..].copy_from_slice(&[
                position.x,
                position.y,
                libm::cosf(angle),
                libm::sinf(angle),
                angle,
                velocity.x,
                velocity.y,
                angular_velocity,
            ]);
        }
    }

    fn write_holds(&self, observation: &Observation, out: &mut [f32]) {
        let known = known_state(observation);
        for (number, whose) in out.iter_mut().zip([observation.agent, observation.agent.other()]) {
            let goal = self.goals[whose];
            let seen = involved(goal).all(|entity| observation.observed.contains(entity));
            *number = number_of(seen && phase_predicates::achieved(&self.physics, &known, goal));
        }
    }
}

fn write_grips(observation: &Observation, out: &mut [f32]) {
    let holders = [observation.agent, observation.agent.other()];
    for (numbers, holder) in out.chunks_exact_mut(GRIP_NUMBERS).zip(holders) {
        if let Some(Some(grip)) = observation.grip(holder) {
            numbers[usize::from(grip.object)] = 1.0;
            numbers[2 + Side::ALL.iter().position(|&side| side == grip.side).unwrap_or_default()] = 1.0;
            numbers[6] = grip.relative_angle;
        }
    }
}

fn write_contacts(observation: &Observation, out: &mut [f32]) {
    let order = order(observation.agent);
    let contacts = observation.contacts();
    for (number, (a, b)) in out.iter_mut().zip(PAIRS) {
        *number = number_of(contacts.touching(order[a], order[b]));
    }
}

fn number_of(truth: bool) -> f32 {
    f32::from(u8::from(truth))
}

/// The entities whose places decide whether a goal holds.
fn involved(goal: Goal) -> impl Iterator<Item = Entity> {
    let target = match goal {
        Goal::Touch { other, .. } => Some(Entity::Agent(other)),
        Goal::AgentOnLandmark { .. } | Goal::ObjectOnLandmark { .. } => None,
    };
    [Some(goal.subject()), target].into_iter().flatten()
}

/// The state as far as it is observed, without grips: other bodies are at the origin.
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

/// The parts that describe the scene; those that say whether goals hold are 0.
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

/// A goal in an agent's vector: its kind (agent on landmark, object on landmark, touch), its subject in the
/// agent's order, its landmark, its sign.
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

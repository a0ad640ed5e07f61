//! The belief itself: particles, memory, and their update.

use crate::{
    consistency::contradicted, contest::Contest, memory::CellMemory, predict::predict,
    resampling::PoseSampler,
};
use phase_model::{
    Action, AgentId, Body, BodySet, Contacts, Dynamics, Entity, MAX_ENTITIES, PhysicsConfig, State,
    geometry::Outline,
};
use phase_perception::{Cell, CellSet, Observation, footprint::covered};
use rand::Rng;

/// The paper's number of particles, K.
pub const PARTICLE_COUNT: usize = 50;

/// One agent's particle belief: K complete states of the world, each consistent with its observation.
#[derive(Clone, PartialEq, Debug)]
pub struct Belief {
    agent: AgentId,
    particles: Vec<State>,
    memory: CellMemory,
    contest: Contest,
    resampled: usize,
    unresolved: usize,
}

impl Belief {
    /// The belief of the observing agent after its first observation. Observed entities are as observed; the
    /// others are uniform over all positions where they would overlap neither walls nor the boundary nor
    /// another body and would not have been seen. (The paper's main text has possible states uniform, its
    /// appendix headings 0; headings are uniform here.) All bodies that are not observed are at rest and hold
    /// nothing.
    #[must_use]
    pub fn new(
        physics: &PhysicsConfig,
        observation: &Observation,
        particle_count: usize,
        rng: &mut impl Rng,
    ) -> Self {
        let blank = State::new([Body::default(); MAX_ENTITIES]);
        let mut belief = Self {
            agent: observation.agent,
            particles: vec![blank; particle_count],
            memory: CellMemory::new(),
            contest: Contest::default(),
            resampled: 0,
            unresolved: 0,
        };
        belief.memory.record_seen(&seen_or_covered(physics, observation));
        belief.contest.follow(observation);
        let mut sampler = PoseSampler::new(physics, &belief.memory);
        let unknown: BodySet =
            physics.entities().filter(|&entity| !observation.observed.contains(entity)).collect();
        for particle in &mut belief.particles {
            overwrite(particle, observation);
            belief.unresolved += resample(particle, unknown, &mut sampler, rng);
            belief.resampled += unknown.iter().count();
        }
        belief
    }

    /// One step from t to t + 1: predicts every particle under the action the agent took at t, overwrites it
    /// with the agent's observation at t + 1, and resamples the bodies that contradict it.
    pub fn update(
        &mut self,
        dynamics: &impl Dynamics,
        physics: &PhysicsConfig,
        own_action: Action,
        observation: &Observation,
        rng: &mut impl Rng,
    ) {
        self.memory.record_seen(&seen_or_covered(physics, observation));
        self.contest.follow(observation);
        (self.resampled, self.unresolved) = (0, 0);
        let mut sampler = PoseSampler::new(physics, &self.memory);
        let observed = observation.observed;
        predict(dynamics, physics, &mut self.particles, self.agent, own_action, observed);
        for particle in &mut self.particles {
            let contradicted_by_touch = contradicted_by_touch(physics, particle, self.agent, observed);
            overwrite(particle, observation);
            let impossible =
                contradicted(physics, particle, observed, &observation.visible).union(contradicted_by_touch);
            if !impossible.is_empty() {
                self.unresolved += resample(particle, impossible, &mut sampler, rng);
                self.resampled += impossible.iter().count();
            }
        }
    }

    /// Puts for each particle one of them in its place, by its index, as resampling by weights of the
    /// particles does.
    ///
    /// # Panics
    /// If an index is not that of a particle.
    pub fn resample(&mut self, indices: &[usize]) {
        self.particles = indices.iter().map(|&k| self.particles[k]).collect();
    }

    /// The agent whose belief it is.
    #[must_use]
    pub fn agent(&self) -> AgentId {
        self.agent
    }

    /// The possible states, all equally likely.
    #[must_use]
    pub fn particles(&self) -> &[State] {
        &self.particles
    }

    /// The agent's memory of a contest for an object.
    #[must_use]
    pub const fn contest(&self) -> Contest {
        self.contest
    }

    /// The step at which the agent last saw each cell. A cell that a known body covers entirely counts as
    /// seen, since nothing else can be there.
    #[must_use]
    pub fn memory(&self) -> &CellMemory {
        &self.memory
    }

    /// Cells known to contain nothing unknown at present.
    pub fn seen_now(&self) -> impl Iterator<Item = Cell> {
        Cell::all().filter(|&cell| self.memory.age(cell) == Some(0))
    }

    /// Cells that the agent has never seen.
    pub fn never_seen(&self) -> impl Iterator<Item = Cell> {
        Cell::all().filter(|&cell| self.memory.age(cell).is_none())
    }

    /// Number of bodies, over all particles, that were resampled in the last step.
    #[must_use]
    pub fn resampled(&self) -> usize {
        self.resampled
    }

    /// Number of these for which no feasible place was found, neither in 200 draws nor among 3600 places all
    /// over the arena. Such a body lies in view, or in a body, or in a wall, in this order of preference; the
    /// next step tries again.
    #[must_use]
    pub fn unresolved(&self) -> usize {
        self.unresolved
    }
}

/// Entities that the prediction puts in the agent's grip although no touch is observed, which is a
/// contradiction. Predicted contacts are not precise enough for the same conclusion.
fn contradicted_by_touch(
    physics: &PhysicsConfig,
    particle: &State,
    agent: AgentId,
    observed: BodySet,
) -> BodySet {
    let in_hand = particle.held_object(agent).map(Entity::Object);
    physics.entities().filter(|&entity| !observed.contains(entity) && Some(entity) == in_hand).collect()
}

/// Cells in which the agent knows that there is no unobserved body.
fn seen_or_covered(physics: &PhysicsConfig, observation: &Observation) -> CellSet {
    let mut cells = observation.visible;
    for entity in observation.observed.iter() {
        if let Some(body) = observation.body(entity) {
            covered(&Outline::of(physics, entity, body)).iter().for_each(|cell| cells.insert(cell));
        }
    }
    cells
}

/// Overwrites a particle with the observation, and drops what contradicts it: an unobserved agent's grip of
/// an observed object, and contacts between observed and unobserved bodies.
pub fn overwrite(particle: &mut State, observation: &Observation) {
    let observed = observation.observed;
    for entity in observed.iter() {
        if let Some(body) = observation.body(entity) {
            *particle.body_mut(entity) = *body;
        }
    }
    for agent in AgentId::ALL {
        let known = observation.grip(agent);
        let imagined = particle.grips[agent].filter(|grip| !observed.contains(Entity::Object(grip.object)));
        particle.grips[agent] = known.unwrap_or(imagined);
    }
    particle.contacts = contacts(|a, b| match (observed.contains(a), observed.contains(b)) {
        (true, true) => observation.contacts().touching(a, b),
        (false, false) => particle.contacts.touching(a, b),
        _ => false,
    });
}

/// Gives some entities new places, in which they neither hold nor touch anything. Returns for how many no
/// place was found.
fn resample(
    particle: &mut State,
    which: BodySet,
    sampler: &mut PoseSampler<'_>,
    rng: &mut impl Rng,
) -> usize {
    for agent in AgentId::ALL {
        particle.grips[agent] = particle.grips[agent].filter(|grip| {
            !which.contains(Entity::Agent(agent)) && !which.contains(Entity::Object(grip.object))
        });
    }
    let before = particle.contacts;
    particle.contacts = contacts(|a, b| !which.contains(a) && !which.contains(b) && before.touching(a, b));
    sampler.resample(particle, which, rng)
}

/// The contacts between the pairs that satisfy a condition.
fn contacts(touching: impl Fn(Entity, Entity) -> bool) -> Contacts {
    let mut contacts = Contacts::NONE;
    for b in Entity::ALL {
        for a in Entity::ALL.into_iter().take(b.index()) {
            if touching(a, b) {
                contacts.insert(a, b);
            }
        }
    }
    contacts
}

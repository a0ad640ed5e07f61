//! What an agent knows of a state from seeing and feeling.

use crate::{
    cells::{Cell, CellSet},
    eye::Eye,
};
use phase_model::{AGENT_COUNT, Body, Contacts, Entity, EntitySet, Grip, Physique, State};

/// One agent's observation o of one state. What it does not observe cannot be read from it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Observation {
    /// Who observes, 0 or 1.
    pub agent: usize,
    /// Cells in the field of view.
    pub visible: CellSet,
    /// Entities whose state is known: the observer, what it sees, what touches it, and what touches those.
    pub observed: EntitySet,
    /// Entities that touch the observer.
    pub touched: EntitySet,
    state: State,
}

impl Observation {
    /// The body of an observed entity.
    #[must_use]
    pub fn body(&self, entity: Entity) -> Option<&Body> {
        self.observed.contains(entity).then(|| self.state.body(entity))
    }

    /// What an agent (0 or 1) holds, if that agent is observed.
    #[must_use]
    pub fn grip(&self, agent: usize) -> Option<Option<Grip>> {
        self.observed.contains(Entity::agent(agent)).then(|| self.state.grips[agent])
    }

    /// Contacts between observed entities.
    #[must_use]
    pub fn contacts(&self) -> Contacts {
        let mut contacts = Contacts::NONE;
        for a in self.observed.iter() {
            for b in self.observed.iter().filter(|&b| self.state.contacts.touching(a, b)) {
                contacts.insert(a, b);
            }
        }
        contacts
    }

    /// Whether two observed entities touch; `None` if either is not observed.
    #[must_use]
    pub fn touching(&self, a: Entity, b: Entity) -> Option<bool> {
        (self.observed.contains(a) && self.observed.contains(b)).then(|| self.state.touching(a, b))
    }
}

/// Everything an agent (0 or 1) observes of a state.
#[must_use]
pub fn observe(physique: &Physique, state: &State, agent: usize) -> Observation {
    let eye = Eye::new(physique, state, agent);
    Observation {
        agent,
        visible: Cell::all().filter(|&cell| eye.sees_cell(cell)).collect(),
        observed: observed_by(&eye, physique, state, agent),
        touched: touched_by(physique, state, agent),
        state: *state,
    }
}

/// The entities an agent observes: as [`observe`] says, but without working out the whole field of view.
#[must_use]
pub fn observed_set(physique: &Physique, state: &State, agent: usize) -> EntitySet {
    observed_by(&Eye::new(physique, state, agent), physique, state, agent)
}

fn observed_by(eye: &Eye<'_>, physique: &Physique, state: &State, agent: usize) -> EntitySet {
    let me = Entity::agent(agent);
    let mut observed = touched_by(physique, state, agent);
    observed.insert(me);
    for entity in physique.entities() {
        if !observed.contains(entity) && eye.sees(entity) {
            observed.insert(entity);
        }
    }
    // Whatever touches an observed entity is observed too, and so on; a chain has at most three links.
    for _ in 1..physique.entity_count().max(AGENT_COUNT) {
        for entity in physique.entities() {
            if observed.iter().any(|other| state.touching(entity, other)) {
                observed.insert(entity);
            }
        }
    }
    observed
}

fn touched_by(physique: &Physique, state: &State, agent: usize) -> EntitySet {
    let me = Entity::agent(agent);
    physique.entities().filter(|&entity| entity != me && state.touching(me, entity)).collect()
}

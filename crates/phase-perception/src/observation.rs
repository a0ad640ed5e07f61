//! The observation of one agent in one state: what it sees, what it feels, and what touches that.

use crate::{
    cells::{Cell, CellSet},
    viewpoint::{Viewpoint, field_of_view},
};
use phase_model::{
    AGENT_COUNT, AgentId, Body, BodySet, Contacts, Entity, Grip, MAX_ENTITIES, PhysicsConfig, State,
};

/// Everything an agent observes of a state, oᵢ of the paper.
#[must_use]
pub fn observe(physics: &PhysicsConfig, state: &State, agent: AgentId) -> Observation {
    let visible = field_of_view(physics, state, agent);
    Observation::of(physics, state, agent, visible, observed_set(physics, state, agent))
}

/// Everything that an agent observes of a state if it is also told where all objects are, and who touches
/// them.
#[must_use]
pub fn observe_told(physics: &PhysicsConfig, state: &State, agent: AgentId) -> Observation {
    let visible = field_of_view(physics, state, agent);
    let objects = physics.entities().filter(|entity| matches!(entity, Entity::Object(_))).collect();
    let observed = contact_closure(physics, state, observed_set(physics, state, agent).union(objects));
    Observation::of(physics, state, agent, visible, observed)
}

/// The entities that an agent observes, itself included: the coarse observation for simulated states. Equal
/// to [`Observation::observed`] of [`observe`], but tests only the cells that bodies lie on.
#[must_use]
pub fn observed_set(physics: &PhysicsConfig, state: &State, agent: AgentId) -> BodySet {
    let mut observed = contact_closure(physics, state, [Entity::Agent(agent)].into_iter().collect());
    let mut viewpoint = None;
    for entity in physics.entities() {
        if !observed.contains(entity)
            && viewpoint.get_or_insert_with(|| Viewpoint::new(physics, state, agent)).sees(entity)
        {
            observed.insert(entity);
            observed = contact_closure(physics, state, observed);
        }
    }
    observed
}

/// The entities that each agent observes in each of some states.
#[must_use]
pub fn observed_sets(physics: &PhysicsConfig, states: &[State]) -> Vec<[BodySet; AGENT_COUNT]> {
    let of = |state: &State| AgentId::ALL.map(|agent| observed_set(physics, state, agent));
    states.iter().map(of).collect()
}

/// An agent's observation at one moment. It contains nothing unobserved, so two observations are equal if the
/// agent cannot distinguish them.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Observation {
    /// The observing agent.
    pub agent: AgentId,
    /// The cells whose centre the agent sees.
    pub visible: CellSet,
    /// The entities whose bodies, grips and contacts are known exactly; the agent itself is one of them.
    pub observed: BodySet,
    /// The entities that the agent feels: those in contact with it or attached to it.
    pub touched: BodySet,
    /// The observed part of the state; the remainder is blank.
    known: State,
}

impl Observation {
    /// The observation that an agent makes of a state if these cells are visible to it and these entities
    /// observed.
    #[must_use]
    pub fn of(
        physics: &PhysicsConfig,
        state: &State,
        agent: AgentId,
        visible: CellSet,
        observed: BodySet,
    ) -> Self {
        let own = Entity::Agent(agent);
        let touched = physics.entities().filter(|&entity| state.touching(own, entity)).collect();
        Self { agent, visible, observed, touched, known: observed_part(state, observed) }
    }

    /// An observation from its parts: `known` holds the bodies, grips and contacts of the entities observed;
    /// whatever else it holds is ignored.
    #[must_use]
    pub fn from_parts(
        agent: AgentId,
        visible: CellSet,
        observed: BodySet,
        touched: BodySet,
        known: &State,
    ) -> Self {
        Self { touched, known: observed_part(known, observed), agent, visible, observed }
    }

    /// The true body of an entity, or `None` if it is not observed.
    #[must_use]
    pub fn body(&self, entity: Entity) -> Option<&Body> {
        self.observed.contains(entity).then(|| self.known.body(entity))
    }

    /// The object that an agent holds, or the outer `None` if the agent is not observed. The object held by
    /// an observed agent is observed, too.
    #[must_use]
    pub fn grip(&self, agent: AgentId) -> Option<Option<Grip>> {
        self.observed.contains(Entity::Agent(agent)).then(|| self.known.grips[agent])
    }

    /// The contacts between observed entities. An unobserved entity touches no observed one.
    #[must_use]
    pub fn contacts(&self) -> Contacts {
        self.known.contacts
    }

    /// Whether two entities touch, by contact or by one holding the other, or `None` if neither is observed.
    #[must_use]
    pub fn touching(&self, a: Entity, b: Entity) -> Option<bool> {
        (self.observed.contains(a) || self.observed.contains(b)).then(|| self.known.touching(a, b))
    }

    /// Whether the agent sees the centre of a cell.
    #[must_use]
    pub fn sees_cell(&self, cell: Cell) -> bool {
        self.visible.contains(cell)
    }
}

/// The part of a state that is about these entities.
fn observed_part(state: &State, observed: BodySet) -> State {
    let mut known = State::new([Body::default(); MAX_ENTITIES]);
    for entity in observed.iter() {
        *known.body_mut(entity) = *state.body(entity);
        if let Entity::Agent(holder) = entity {
            known.grips[usize::from(holder)] = state.grips[usize::from(holder)];
        }
        for other in observed.iter().filter(|&other| state.contacts.touching(entity, other)) {
            known.contacts.insert(entity, other);
        }
    }
    known
}

/// The transitive closure of a set of entities under touch.
fn contact_closure(physics: &PhysicsConfig, state: &State, mut set: BodySet) -> BodySet {
    loop {
        let touching = |entity: Entity| set.iter().any(|known| state.touching(known, entity));
        let larger = physics.entities().filter(|&entity| touching(entity)).collect::<BodySet>().union(set);
        if larger == set {
            return set;
        }
        set = larger;
    }
}

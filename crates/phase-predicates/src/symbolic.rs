//! A physical state as the set of predicates that are true in it.

use crate::evaluate;
use phase_model::{AgentId, Entity, LandmarkId, ObjectId, PhysicsConfig, Predicate, PredicateTarget, State};
use serde::{Deserialize, Serialize};

/// The truth value of every predicate of a scene, one bit each; all those not in it are negated.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default, Serialize, Deserialize)]
pub struct SymbolicState(u64);

impl SymbolicState {
    /// Evaluates every predicate in a physical state.
    #[must_use]
    pub fn of(physics: &PhysicsConfig, state: &State) -> Self {
        let mut symbolic = Self::default();
        for predicate in Self::predicates() {
            if evaluate::holds(physics, state, predicate) {
                symbolic.set(predicate, true);
            }
        }
        symbolic
    }

    /// Whether a predicate is true.
    #[must_use]
    pub const fn holds(self, predicate: Predicate) -> bool {
        self.0 & (1 << bit(predicate)) != 0
    }

    /// Makes a predicate true or false.
    pub const fn set(&mut self, predicate: Predicate, holds: bool) {
        if holds {
            self.0 |= 1 << bit(predicate);
        } else {
            self.0 &= !(1 << bit(predicate));
        }
    }

    /// The predicates that are true.
    pub fn iter(self) -> impl Iterator<Item = Predicate> {
        Self::predicates().filter(move |&predicate| self.holds(predicate))
    }

    /// All predicates, for the maximum number of entities.
    pub fn predicates() -> impl Iterator<Item = Predicate> {
        let entities = || Entity::ALL.into_iter();
        let landmarks = || LandmarkId::ALL.into_iter();
        let agents = || AgentId::ALL.into_iter();
        let on = entities().flat_map(move |e| landmarks().map(move |l| Predicate::On(e, l)));
        let near = entities()
            .flat_map(move |e| landmarks().map(move |l| Predicate::Close(e, PredicateTarget::Landmark(l))));
        let touch = agents().flat_map(move |a| {
            entities().filter(move |&e| e != Entity::Agent(a)).map(move |e| Predicate::Touch(a, e))
        });
        let attach = agents().flat_map(|a| ObjectId::ALL.into_iter().map(move |o| Predicate::Attach(a, o)));
        let close = entities().flat_map(move |a| {
            entities().filter(move |&b| a < b).map(move |b| Predicate::Close(a, PredicateTarget::Entity(b)))
        });
        on.chain(near).chain(touch).chain(attach).chain(close)
    }
}

/// The bit of each predicate; Close is symmetric, Touch of two agents is not stored twice.
const fn bit(predicate: Predicate) -> usize {
    match predicate {
        Predicate::On(entity, landmark) => entity.index() * 4 + landmark.index(),
        Predicate::Close(entity, PredicateTarget::Landmark(landmark)) => {
            16 + entity.index() * 4 + landmark.index()
        }
        Predicate::Touch(agent, entity) => 32 + agent.index() * 4 + entity.index(),
        Predicate::Attach(agent, object) => 40 + agent.index() * 2 + object.index(),
        Predicate::Close(a, PredicateTarget::Entity(b)) => {
            let a = a.index();
            let b = b.index();
            44 + if a < b { a * 4 + b } else { b * 4 + a }
        }
    }
}

//! A physical state as the set of predicates that are true in it.

use crate::evaluate;
use phase_model::{AGENT_COUNT, Entity, Physique, Place, Predicate, State, arena};
use serde::{Deserialize, Serialize};

/// The truth value of every predicate of a scene, one bit each; all those not in it are negated.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default, Serialize, Deserialize)]
pub struct SymbolicState(u64);

impl SymbolicState {
    /// Evaluates every predicate in a physical state.
    #[must_use]
    pub fn of(physique: &Physique, state: &State) -> Self {
        let mut symbolic = Self::default();
        for predicate in Self::predicates() {
            if evaluate::holds(physique, state, predicate) {
                symbolic.set(predicate, true);
            }
        }
        symbolic
    }

    /// Whether a predicate is true.
    #[must_use]
    pub const fn holds(self, predicate: Predicate) -> bool {
        match bit(predicate) {
            Some(bit) => self.0 & (1 << bit) != 0,
            None => false,
        }
    }

    /// Makes a predicate true or false; does nothing for arguments that no scene has.
    pub const fn set(&mut self, predicate: Predicate, holds: bool) {
        if let Some(bit) = bit(predicate) {
            if holds {
                self.0 |= 1 << bit;
            } else {
                self.0 &= !(1 << bit);
            }
        }
    }

    /// The predicates that are true.
    pub fn iter(self) -> impl Iterator<Item = Predicate> {
        Self::predicates().filter(move |&predicate| self.holds(predicate))
    }

    /// Every predicate there is, for the greatest number of entities.
    pub fn predicates() -> impl Iterator<Item = Predicate> {
        let entities = || (0..phase_model::MAX_ENTITIES).map(Entity::from_index);
        let landmarks = || 0..arena::LANDMARKS.len() as u8;
        let agents = || 0..AGENT_COUNT as u8;
        let on = entities().flat_map(move |e| landmarks().map(move |l| Predicate::On(e, l)));
        let near =
            entities().flat_map(move |e| landmarks().map(move |l| Predicate::Close(e, Place::Landmark(l))));
        let touch = agents().flat_map(move |a| {
            entities().filter(move |&e| e != Entity::Agent(a)).map(move |e| Predicate::Touch(a, e))
        });
        let attach = agents().flat_map(|a| (0..2).map(move |o| Predicate::Attach(a, o)));
        let close = entities().flat_map(move |a| {
            entities().filter(move |&b| a < b).map(move |b| Predicate::Close(a, Place::Entity(b)))
        });
        on.chain(near).chain(touch).chain(attach).chain(close)
    }
}

/// Each predicate's own bit; Close is symmetric, Touch of two agents is not stored twice.
const fn bit(predicate: Predicate) -> Option<usize> {
    let bit = match predicate {
        Predicate::On(entity, landmark) if landmark < 4 => entity.index() * 4 + landmark as usize,
        Predicate::Close(entity, Place::Landmark(landmark)) if landmark < 4 => {
            16 + entity.index() * 4 + landmark as usize
        }
        Predicate::Touch(agent, entity) if agent < 2 => 32 + agent as usize * 4 + entity.index(),
        Predicate::Attach(agent, object) if agent < 2 && object < 2 => {
            40 + agent as usize * 2 + object as usize
        }
        Predicate::Close(a, Place::Entity(b)) if a.index() < 4 && b.index() < 4 => {
            let (a, b) = (a.index(), b.index());
            44 + if a < b { a * 4 + b } else { b * 4 + a }
        }
        _ => return None,
    };
    if bit < 64 { Some(bit) } else { None }
}

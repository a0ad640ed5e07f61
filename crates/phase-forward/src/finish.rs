//! Writing the result of a step into the state.

use crate::{
    key::{KeySet, PAIRS, bit, pair_key},
    reach,
    world::World,
};
use phase_model::{AGENT_COUNT, Contacts, Entity, State};

impl World<'_> {
    /// Writes bodies, grips and contacts into a state. Only pairs among the candidates can touch.
    pub(crate) fn finish(&mut self, state: &mut State, candidates: KeySet) {
        self.write(state);
        state.contacts = Contacts::NONE;
        let near = reach::pairs_near(self, self.model.everyone())
            & candidates
            & !(self.excluded_pairs | self.released);
        let touching = self.touching(near);
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            if touching & bit(pair_key(pair)) != 0 {
                state.contacts.insert(Entity::ALL[a], Entity::ALL[b]);
            }
        }
    }
}

/// Agents do not continue turning from one step to the next.
pub(crate) fn stop_turning(state: &mut State) {
    for body in &mut state.bodies[..AGENT_COUNT] {
        body.angular_velocity = 0.0;
    }
}

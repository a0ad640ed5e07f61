//! Collision filtering of pairs that are held or were released recently.

use crate::{
    constants::H,
    key::{PAIRS, bit, pair_key, pair_of},
    world::World,
};
use phase_model::{AGENT_COUNT, AgentId, Entity, State, Vec2};

/// How far from the place where it was let go of an object is clear of its holder (u).
const CLEARANCE: f32 = 0.1;
/// How many substeps' way at the speed of that moment it has to go beyond that.
const CLEARANCE_SUBSTEPS: f32 = 4.0;

impl World<'_> {
    /// Sets apart the pairs that may not touch: what is held, what is let go of in this step, and what looks
    /// as if it had been let go of just before. Objects held at an agent's flank lie 0.1 r deep in it and
    /// stay out of contact, once let go of, until they have moved; a state does not say so, but an object
    /// that deep at exactly that place, that does not come nearer and did not touch, can be nothing else.
    pub(crate) fn exclude_pairs(&mut self, state: &State, released: [Option<usize>; AGENT_COUNT]) {
        /// Speed of approach at which it has not just been let go of (u/s).
        const APPROACH: f32 = 1.0;
        for (holder, released) in AgentId::ALL.into_iter().zip(released) {
            let agent = holder.index();
            if let Some(held) = self.held(agent) {
                self.excluded_pairs |= bit(pair_key(pair_of(agent, held)));
            }
            if let Some(held) = released {
                self.released |= bit(pair_key(pair_of(agent, held)));
            }
            for object in AGENT_COUNT..self.model.count {
                let (motion, held) = (&self.motions[agent], &self.motions[object]);
                let reach = self.model.shapes[agent].radius + self.model.shapes[object].radius;
                let between = held.centre - motion.place(Vec2::new(0.0, self.model.shapes[agent].origin));
                if between.length_squared() > (reach + CLEARANCE) * (reach + CLEARANCE)
                    || state.contacts.touching(Entity::Agent(holder), Entity::ALL[object])
                {
                    continue;
                }
                let place = motion.right * (reach * between.dot(motion.right).signum());
                let approach = (motion.velocity - held.velocity).dot(between.normalize_or_zero());
                if place.distance_squared(between) < CLEARANCE * CLEARANCE && approach < APPROACH {
                    self.released |= bit(pair_key(pair_of(agent, object)));
                }
            }
        }
        if self.released != 0 {
            self.excluded_pairs |= self.released;
            for body in 0..self.model.count {
                let motion = &self.motions[body];
                self.let_go_at[body] = motion.centre;
                self.release_distance[body] = CLEARANCE + CLEARANCE_SUBSTEPS * H * motion.velocity.length();
            }
        }
    }

    /// Restores collisions of released pairs once one of the two has moved clear.
    pub(crate) fn restore_pairs(&mut self) {
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            let moved = |body: usize| {
                (self.motions[body].centre - self.let_go_at[body]).abs().max_element()
                    > self.release_distance[body]
            };
            if self.released & bit(pair_key(pair)) != 0 && (moved(a) || moved(b)) {
                self.released &= !bit(pair_key(pair));
                self.excluded_pairs &= !bit(pair_key(pair));
            }
        }
    }
}

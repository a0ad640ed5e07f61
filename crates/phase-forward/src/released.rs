//! Collision filtering of pairs that are held or were released recently.

use crate::{
    key::{PAIRS, bit, pair_key, pair_of},
    world::World,
};
use phase_model::{
    AGENT_COUNT, AgentId, Entity, State, Vec2,
    physics::{RELEASE_CLEARANCE, release_distance},
};

/// Speed of approach above which an object was not just released (u/s).
const APPROACH: f32 = 1.0;

impl World<'_> {
    /// Excludes contacts of held objects, and limits those of objects that are released in this step or
    /// appear to have been released just before to overlaps beyond [`RELEASED_OVERLAP`]. Objects held at an
    /// agent's flank penetrate it by 0.1 r and are not pushed out after their release until they have moved;
    /// a state does not contain this information, but an object at that depth in exactly that place, which
    /// does not approach and did not touch, can have no other cause.
    ///
    /// [`RELEASED_OVERLAP`]: phase_model::physics::RELEASED_OVERLAP
    pub(crate) fn exclude_pairs(&mut self, state: &State, released: [Option<usize>; AGENT_COUNT]) {
        for (holder, released) in AgentId::ALL.into_iter().zip(released) {
            let agent = holder.index();
            if let Some(held) = self.held(agent) {
                self.excluded_pairs |= bit(pair_key(pair_of(agent, held)));
            }
            if let Some(held) = released {
                self.released |= bit(pair_key(pair_of(agent, held)));
            }
            for object in AGENT_COUNT..self.model.count {
                let motion = &self.motions[agent];
                let held = &self.motions[object];
                let reach = self.model.shapes[agent].radius + self.model.shapes[object].radius;
                let between = held.centre - motion.place(Vec2::new(0.0, self.model.shapes[agent].origin));
                if between.length_squared() > (reach + RELEASE_CLEARANCE) * (reach + RELEASE_CLEARANCE)
                    || state.contacts.touching(Entity::Agent(holder), Entity::ALL[object])
                {
                    continue;
                }
                let place = motion.right * (reach * between.dot(motion.right).signum());
                let approach = (motion.velocity - held.velocity).dot(between.normalize_or_zero());
                if place.distance_squared(between) < RELEASE_CLEARANCE * RELEASE_CLEARANCE
                    && approach < APPROACH
                {
                    self.released |= bit(pair_key(pair_of(agent, object)));
                }
            }
        }
        if self.released != 0 {
            for body in 0..self.model.count {
                let motion = &self.motions[body];
                self.let_go_at[body] = motion.centre;
                self.release_distance[body] = release_distance(motion.velocity.length());
            }
        }
    }

    /// Ends the tolerance of released pairs once one of the two has moved clear.
    pub(crate) fn restore_pairs(&mut self) {
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            let moved = |body: usize| {
                (self.motions[body].centre - self.let_go_at[body]).abs().max_element()
                    > self.release_distance[body]
            };
            if self.released & bit(pair_key(pair)) != 0 && (moved(a) || moved(b)) {
                self.released &= !bit(pair_key(pair));
            }
        }
    }
}

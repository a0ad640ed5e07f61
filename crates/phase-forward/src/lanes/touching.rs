//! The contacts of a substep in each lane.

use super::{
    contact::{Contacts, Trace},
    outline::WallLanes,
    reach::BodyLanes,
    real::{LaneSet, Real},
    worlds::Worlds,
};
use crate::{
    body::STATIC,
    key::{PAIRS, pair_key, wall_key},
    touching::MAX_CONTACTS,
};
use arrayvec::ArrayVec;

/// The contacts of a substep, newest first.
pub(crate) type ContactList = ArrayVec<Contacts, { 2 * MAX_CONTACTS }>;

/// What is kept of them for the next substep.
pub(crate) type TraceList = ArrayVec<Trace, { 2 * MAX_CONTACTS }>;

impl Worlds<'_> {
    /// Finds the touching pairs of shapes among the given ones that resist it, newest first. The outlines of the bodies must be
    /// up to date. Lanes with more contacts than the scalar kernel solves fail.
    pub(crate) fn find_contacts(
        &mut self,
        list: &mut ContactList,
        pairs: &[LaneSet; PAIRS.len()],
        walls: &[WallLanes; 4],
    ) {
        let shapes = &self.model.shapes;
        let mut crowded = 0;
        list.clear();
        if self.model.collisions {
            for (pair, (a, b)) in PAIRS.into_iter().enumerate().rev() {
                if pairs[pair] == 0 {
                    continue;
                }
                let manifolds = self.collide_pair(pair, pairs[pair]);
                if manifolds.live != 0 {
                    let tolerated = self.tolerated_overlap(pair);
                    list.push(Contacts::new(pair_key(pair), (a, b), manifolds, shapes, tolerated));
                }
            }
        }
        for wall in (0..self.model.wall_count).rev() {
            for body in (0..self.model.count).rev() {
                let set = walls[body][wall];
                if set == 0 {
                    continue;
                }
                let manifolds = self.collide_wall(wall, body, set);
                if manifolds.live == 0 {
                    continue;
                }
                let key = wall_key(wall, body);
                let contacts = Contacts::new(key, (STATIC, body), manifolds, shapes, Real::ZERO);
                if list.try_push(contacts).is_err() {
                    crowded |= manifolds.live;
                }
            }
        }
        if list.len() > MAX_CONTACTS {
            for lane in super::real::each(self.used) {
                if list.iter().filter(|contact| contact.live() & 1 << lane != 0).count() > MAX_CONTACTS {
                    crowded |= 1 << lane;
                }
            }
        }
        self.failed |= crowded;
    }

    /// For each body, the reachable walls whose box overlaps its own, in the given lanes.
    pub(crate) fn walls_of(&self, active: &BodyLanes) -> [WallLanes; 4] {
        core::array::from_fn(|body| {
            if active[body] == 0 || body >= self.model.count {
                [0; crate::wall::MAX_WALLS]
            } else {
                super::reach::walls_touched(self, body, active[body])
            }
        })
    }
}

//! The narrow phase: which shapes touch at the present poses.

use crate::{
    body::STATIC,
    collide,
    contact::Contact,
    key::{KeySet, PAIRS, bit, bodies_of, descending, pair_key},
    manifold::Manifold,
    polygon::Polygon,
    wall::MAX_WALLS,
    world::World,
};
use phase_model::{AGENT_COUNT, physics::RELEASED_OVERLAP};

impl World<'_> {
    /// Finds the touching pairs of shapes in a set that resist it, newest first. The outlines of the bodies
    /// must be up to date.
    pub(crate) fn contacts(&self, candidates: KeySet) -> impl Iterator<Item = Contact> {
        descending(self.model.resisting(candidates)).filter_map(|key| {
            let (bodies, manifold) = self.collide(key, &self.outlines.polygons);
            (manifold.count > 0)
                .then(|| Contact::new(key as u8, bodies, manifold).tolerating(self.tolerated_overlap(key)))
        })
    }

    /// The contact of a pair of shapes.
    pub(crate) fn collide(&self, key: usize, polygons: &[Polygon; 2]) -> ((usize, usize), Manifold) {
        let motions = &self.motions;
        let shapes = &self.model.shapes;
        if key < pair_key(0) {
            let wall = &self.model.walls[key / 4];
            let body = key % 4;
            let manifold = if body < AGENT_COUNT {
                collide::wall_agent(wall, &motions[body], &polygons[body])
            } else {
                collide::wall_disc(wall, &motions[body], shapes[STATIC].skin + shapes[body].skin)
            };
            return ((STATIC, body), manifold);
        }
        let (a, b) = PAIRS[key - 4 * MAX_WALLS];
        let skins = shapes[a].skin + shapes[b].skin;
        let manifold = if b < AGENT_COUNT {
            collide::agents((&motions[a], &polygons[a]), (&motions[b], &polygons[b]))
        } else if a < AGENT_COUNT {
            let skins = skins - self.tolerated_overlap(key);
            collide::agent_disc(&shapes[a], &motions[a], &motions[b], skins)
        } else {
            collide::discs(&motions[a], &motions[b], skins)
        };
        ((a, b), manifold)
    }

    /// The overlap of a pair of shapes that their contact does not resist (u).
    fn tolerated_overlap(&self, key: usize) -> f32 {
        if self.released & bit(key) == 0 { 0.0 } else { RELEASED_OVERLAP }
    }

    /// The pairs of bodies that touch at their present poses, among the given keys.
    pub(crate) fn touching(&mut self, candidates: KeySet) -> KeySet {
        let pairs = candidates >> pair_key(0) << pair_key(0);
        if pairs == 0 {
            return 0;
        }
        self.outline(bodies_of(pairs));
        descending(pairs)
            .filter(|&key| self.collide(key, &self.outlines.polygons).1.count > 0)
            .fold(0, |set, key| set | bit(key))
    }
}

//! The state that a replay carries from step to step in addition to bodies: impulses, and broad-phase pairs.

use crate::{
    body::{BodyMotion, Shape},
    constants::SKIN,
    key::{KEYS, KeySet, PAIRS, bit, descending, pair_key, pair_of, wall_key},
    polygon::Polygon,
    touching::{CachedContacts, ContactSet},
    world::{Impulses, World},
};
use phase_model::{AGENT_COUNT, Vec2, arena::SUBSTEPS};

/// Margin around a body when its box is updated (u).
pub(crate) const MARGIN: f32 = 0.1;
/// Substeps after a release in which a pair may overlap without limit, as in the original: three steps.
const UNLIMITED_SUBSTEPS: u8 = 3 * SUBSTEPS as u8;
/// Share of its last displacement that a body is expected to repeat, in updated boxes.
const AABB_MULTIPLIER: f32 = 2.0;

/// The cache of a replay: the last impulses of contacts, grips and ground friction, and the original's broad
/// phase. There, a pair of shapes becomes a contact candidate once their enlarged boxes overlap, and a box is
/// updated only when its body has left it. This decides which of several contacts is solved first, and why an
/// object released inside an agent's outline does not touch it before one of them has moved. Three steps
/// after the release, and unlike the original, such a pair may overlap by
/// [`phase_model::physics::RELEASED_OVERLAP`] only.
#[derive(Clone, Copy, Debug)]
pub struct SolverCache {
    pub(crate) impulses: Impulses,
    /// The contacts of the last substep.
    pub(crate) traces: CachedContacts,
    /// The time at which each pair became a contact candidate; 0 for pairs that never were.
    pub(crate) since: [u32; KEYS],
    pub(crate) now: u32,
    pub(crate) active_pairs: KeySet,
    /// Pairs that were released and are not contact candidates again.
    pub(crate) released: KeySet,
    /// For each pair, the substeps since its release.
    pub(crate) released_for: [u8; PAIRS.len()],
    pub(crate) boxes: [(Vec2, Vec2); 4],
    moved: u8,
    pub(crate) latest_grip: usize,
}

impl SolverCache {
    pub(crate) fn new(world: &World<'_>) -> Self {
        let mut solver_cache = Self {
            impulses: Impulses::NONE,
            traces: CachedContacts::NONE,
            since: [0; KEYS],
            now: 1,
            active_pairs: 0,
            released: 0,
            released_for: [0; PAIRS.len()],
            boxes: [(Vec2::ZERO, Vec2::ZERO); 4],
            moved: 0,
            latest_grip: 1,
        };
        for body in 0..world.model.count {
            let (min, max) = bounds(&world.model.shapes[body], &world.motions[body]);
            solver_cache.boxes[body] = (min - MARGIN, max + MARGIN);
            solver_cache.moved |= 1 << body;
        }
        solver_cache.find_new_pairs(world);
        solver_cache
    }

    /// Pairs that are contact candidates.
    pub(crate) fn active_pairs(&self) -> KeySet {
        self.active_pairs
    }

    /// Records that an agent has released a body.
    pub(crate) fn release(&mut self, agent: usize, held: usize) {
        let pair = pair_of(agent, held);
        self.released |= bit(pair_key(pair));
        self.released_for[pair] = 0;
    }

    /// Counts a substep, and returns the pairs whose release was so long ago that their overlap is limited,
    /// although they are not contact candidates again.
    pub(crate) fn limited_pairs(&mut self) -> KeySet {
        let mut limited = 0;
        for (pair, substeps) in self.released_for.iter_mut().enumerate() {
            *substeps = substeps.saturating_add(1);
            if *substeps > UNLIMITED_SUBSTEPS {
                limited |= self.released & bit(pair_key(pair));
            }
        }
        limited
    }

    /// Hands over what a step begins with, and returns the contacts of the substep before it.
    pub(crate) fn enter(&self, world: &mut World<'_>) -> ContactSet {
        world.impulses = self.impulses;
        world.latest_grip = self.latest_grip;
        ContactSet { traces: self.traces, ..ContactSet::NONE }
    }

    /// Takes back what a step ends with.
    pub(crate) fn leave(&mut self, world: &World<'_>, touching: &ContactSet) {
        self.impulses = world.impulses;
        self.latest_grip = world.latest_grip;
        self.traces = touching.traces;
    }

    /// Removes pairs that are held together or whose boxes no longer overlap.
    pub(crate) fn drop_stale(&mut self, world: &World<'_>) {
        let held = held_pairs(world);
        self.released &= !held;
        for key in descending(self.active_pairs) {
            if held & bit(key) != 0 || !self.boxes_overlap(world, key) {
                self.active_pairs &= !bit(key);
            }
        }
    }

    /// Sorts the contacts found from newest to oldest.
    pub(crate) fn sort_newest_first(&self, touching: &mut ContactSet) {
        touching
            .current_mut()
            .sort_by_key(|contact| core::cmp::Reverse(self.since[usize::from(contact.key)]));
    }

    /// Updates the boxes of bodies that have left theirs, and finds the new contact candidates.
    pub(crate) fn update_boxes(&mut self, world: &World<'_>) {
        for body in 0..world.model.count {
            let (centre, angle, right) = world.starts[body];
            let before = BodyMotion { centre, angle, right, ..world.motions[body] };
            self.refit_box(&world.model.shapes[body], body, &before, &world.motions[body]);
        }
        self.find_new_pairs(world);
    }

    /// [`SolverCache::update_boxes`] for one body, after an impact.
    pub(crate) fn update_box(&mut self, world: &World<'_>, body: usize) {
        let now = world.motions[body];
        self.refit_box(&world.model.shapes[body], body, &now, &now);
    }

    /// Adds all pairs that overlap the updated boxes to the contact candidates.
    pub(crate) fn find_new_pairs(&mut self, world: &World<'_>) {
        if self.moved == 0 {
            return;
        }
        let held = held_pairs(world);
        for key in 0..KEYS {
            let moved = if key < pair_key(0) {
                key / 4 < world.model.wall_count && self.moved & 1 << (key % 4) != 0
            } else {
                let (a, b) = PAIRS[key - pair_key(0)];
                b < world.model.count && self.moved & (1 << a | 1 << b) != 0
            };
            if moved && (self.active_pairs | held) & bit(key) == 0 && self.boxes_overlap(world, key) {
                self.active_pairs |= bit(key);
                self.released &= !bit(key);
                self.since[key] = self.now;
                self.now += 1;
            }
        }
        self.moved = 0;
    }

    fn refit_box(&mut self, shape: &Shape, body: usize, before: &BodyMotion, after: &BodyMotion) {
        let start = bounds(shape, before);
        let end = bounds(shape, after);
        let min = start.0.min(end.0);
        let max = start.1.max(end.1);
        let (old_min, old_max) = self.boxes[body];
        if old_min.cmple(min).all() && old_max.cmpge(max).all() {
            return;
        }
        let origin = |motion: &BodyMotion| motion.place(Vec2::new(0.0, shape.origin));
        let ahead = (origin(after) - origin(before)) * AABB_MULTIPLIER;
        self.boxes[body] = (min - MARGIN + ahead.min(Vec2::ZERO), max + MARGIN + ahead.max(Vec2::ZERO));
        self.moved |= 1 << body;
    }

    fn boxes_overlap(&self, world: &World<'_>, key: usize) -> bool {
        let ((min_a, max_a), (min_b, max_b)) = if key < pair_key(0) {
            let wall = &world.model.walls[key / 4];
            debug_assert!(wall_key(key / 4, key % 4) == key);
            ((wall.min - MARGIN, wall.max + MARGIN), self.boxes[key % 4])
        } else {
            let (a, b) = PAIRS[key - pair_key(0)];
            (self.boxes[a], self.boxes[b])
        };
        min_a.cmple(max_b).all() && min_b.cmple(max_a).all()
    }
}

/// The pairs of agents and what they hold.
fn held_pairs(world: &World<'_>) -> KeySet {
    (0..AGENT_COUNT)
        .filter_map(|agent| Some(bit(pair_key(pair_of(agent, world.held(agent)?)))))
        .fold(0, |set, key| set | key)
}

/// The box around a body, skin included (u).
fn bounds(shape: &Shape, motion: &BodyMotion) -> (Vec2, Vec2) {
    if shape.origin > 0.0 {
        let (min, max) = Polygon::new(shape, motion).bounds();
        (min - SKIN, max + SKIN)
    } else {
        (motion.centre - shape.radius, motion.centre + shape.radius)
    }
}

//! What worlds carry from step to step in addition to their states, in each lane; see [`crate::solver_cache`].

use super::{
    contact::{Contacts, Trace},
    outline::{Boxes, Polygons, WallLanes},
    reach::BodyLanes,
    real::{LANES, LaneSet, Vector, at_most, each, get, lanes, less, mask, set, splat},
    touching::{ContactList, TraceList},
    worlds::{Place, Start, Worlds},
};
use crate::{
    SolverCache,
    body::Shape,
    constants::SKIN,
    key::{KEYS, KeySet, PAIRS, bit, descending, pair_key, pair_of, wall_key},
    solver_cache::{AABB_MULTIPLIER, MARGIN, UNLIMITED_SUBSTEPS},
    touching::CachedContacts,
    wall::MAX_WALLS,
};
use phase_model::{AGENT_COUNT, Vec2, arena::SUBSTEPS};

/// The broad phase of each lane, and the contacts of its last substep.
pub(crate) struct Memory {
    /// For each body and wall, and for each pair of bodies, the lanes in which they are contact candidates.
    pub(crate) walls: [WallLanes; 4],
    pub(crate) pairs: [LaneSet; PAIRS.len()],
    /// For each pair, the lanes in which it was released and is not a contact candidate again.
    released: [LaneSet; PAIRS.len()],
    /// For each pair, the substeps from its release to the start of this step.
    released_for: [[u8; LANES]; PAIRS.len()],
    /// When each pair of shapes became a contact candidate.
    since: [[u32; LANES]; KEYS],
    now: [u32; LANES],
    /// Pairs of shapes that became contact candidates in this step.
    added: [KeySet; LANES],
    boxes: [Boxes; 4],
    /// For each body, the lanes in which its box was updated: since candidates were last looked for, and since they were last
    /// dropped.
    to_find: [LaneSet; 4],
    to_drop: [LaneSet; 4],
    /// For each body, the lanes in which its box contains it where it is.
    pub(crate) boxed: [LaneSet; 4],
    /// For each body, the lanes in which it was found inside the arena, on its side of all walls, at the end of the last substep.
    pub(crate) inside: [LaneSet; 4],
    /// For each pair, the lanes in which one holds the other.
    held: [LaneSet; PAIRS.len()],
    pub(crate) traces: TraceList,
}

impl Memory {
    /// Takes over caches, and hands to the worlds what the solver begins with.
    pub(crate) fn new(worlds: &mut Worlds<'_>, starts: &[&Start], caches: &[SolverCache]) -> Self {
        let used = worlds.used;
        let mut memory = Self {
            walls: [[0; MAX_WALLS]; 4],
            pairs: [0; PAIRS.len()],
            released: [0; PAIRS.len()],
            released_for: [[0; LANES]; PAIRS.len()],
            since: [[0; LANES]; KEYS],
            now: [0; LANES],
            added: [0; LANES],
            boxes: [(Vector::ZERO, Vector::ZERO); 4],
            to_find: [0; 4],
            to_drop: [used; 4],
            boxed: [0; 4],
            inside: [0; 4],
            held: [0; PAIRS.len()],
            traces: TraceList::new(),
        };
        for agent in 0..AGENT_COUNT {
            if let Some(held) = worlds.held[agent] {
                memory.held[pair_of(agent, held)] = used;
            }
        }
        for lane in 0..LANES {
            let start = starts[lane.min(starts.len() - 1)];
            let cache = &caches[start.index];
            for body in 0..4 {
                let (min, max) = cache.boxes[body];
                memory.boxes[body].0.set(lane, min);
                memory.boxes[body].1.set(lane, max);
                worlds.ground[body].set(lane, cache.impulses.ground[body]);
            }
            for agent in 0..AGENT_COUNT {
                let (impulse, twist) =
                    if start.grabbed[agent] { (Vec2::ZERO, 0.0) } else { cache.impulses.grasps[agent] };
                worlds.grasps[agent].0.set(lane, impulse);
                set(&mut worlds.grasps[agent].1, lane, twist);
            }
            memory.now[lane] = cache.now;
            if used & 1 << lane != 0 {
                memory.take(lane, cache, start);
            }
        }
        memory
    }

    /// Takes over the contact candidates and contacts of one lane.
    fn take(&mut self, lane: usize, cache: &SolverCache, start: &Start) {
        for key in descending(cache.active_pairs | cache.released) {
            self.since[key][lane] = cache.since[key];
        }
        for key in descending(cache.active_pairs) {
            let lanes = match key.checked_sub(pair_key(0)) {
                Some(pair) => &mut self.pairs[pair],
                None => &mut self.walls[key % 4][key / 4],
            };
            *lanes |= 1 << lane;
        }
        for pair in 0..PAIRS.len() {
            self.released[pair] |= u8::from(cache.released & bit(pair_key(pair)) != 0) << lane;
            self.released_for[pair][lane] = cache.released_for[pair];
        }
        for (agent, released) in start.released.iter().enumerate() {
            if let Some(held) = *released {
                let pair = pair_of(agent, held);
                self.since[pair_key(pair)][lane] = cache.since[pair_key(pair)];
                self.released[pair] |= 1 << lane;
                self.released_for[pair][lane] = 0;
            }
        }
        for kept in cache.traces.kept() {
            let place = self.traces.iter().position(|trace| trace.key == kept.key);
            let place = place.unwrap_or_else(|| {
                self.traces.push(Trace::none(kept.key));
                self.traces.len() - 1
            });
            self.traces[place].set(lane, kept);
        }
    }

    /// Removes pairs that are held together or whose boxes no longer overlap.
    pub(crate) fn drop_stale(&mut self, worlds: &Worlds<'_>) {
        let model = worlds.model;
        for body in 0..model.count {
            let updated = self.to_drop[body];
            for wall in 0..model.wall_count {
                let looked_at = self.walls[body][wall] & updated;
                if looked_at != 0 {
                    let overlap = self.overlaps_wall(worlds, wall, body);
                    self.walls[body][wall] &= !looked_at | overlap;
                }
            }
        }
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            self.released[pair] &= !self.held[pair];
            self.pairs[pair] &= !self.held[pair];
            let looked_at = self.pairs[pair] & (self.to_drop[a] | self.to_drop[b]);
            if looked_at != 0 {
                self.pairs[pair] &= !looked_at | self.overlap(a, b);
            }
        }
        self.to_drop = [0; 4];
    }

    /// For each pair, the lanes in which it was released so long ago that its overlap is limited, although it is not a contact
    /// candidate again, in a substep (0 to 4).
    pub(crate) fn limited_pairs(&self, substep: usize) -> [LaneSet; PAIRS.len()] {
        let mut limited = self.released;
        for (limited, released_for) in limited.iter_mut().zip(&self.released_for) {
            for lane in each(*limited) {
                let passed = usize::from(released_for[lane]) + substep + 1;
                if passed <= usize::from(UNLIMITED_SUBSTEPS) {
                    *limited &= !(1 << lane);
                }
            }
        }
        limited
    }

    /// Sorts contacts from newest to oldest. Returns the lanes in which this is not possible, since another lane has them in
    /// another order.
    pub(crate) fn sort_newest_first(&self, contacts: &mut ContactList) -> LaneSet {
        let mut failed = 0;
        if contacts.len() < 2 {
            return failed;
        }
        let age = |contact: &Contacts| {
            let first = contact.live().trailing_zeros() as usize;
            self.since[usize::from(contact.key)][first]
        };
        // They are few, large, and nearly always in order.
        for place in 1..contacts.len() {
            let mut place = place;
            while place > 0 && age(&contacts[place - 1]) < age(&contacts[place]) {
                contacts.swap(place - 1, place);
                place -= 1;
            }
        }
        for (index, newer) in contacts.iter().enumerate() {
            for older in &contacts[index + 1..] {
                let (a, b) = (usize::from(newer.key), usize::from(older.key));
                for lane in each(newer.live() & older.live()) {
                    // Of those that are equally old the one with the higher key comes first.
                    let right = (self.since[a][lane], a) > (self.since[b][lane], b);
                    failed |= u8::from(!right) << lane;
                }
            }
        }
        failed
    }

    /// Updates the boxes that bodies have left in this substep, and finds the new contact candidates. Takes the lanes in which each
    /// of them has moved.
    pub(crate) fn update_boxes(&mut self, worlds: &mut Worlds<'_>, moved: &BodyLanes) {
        for body in 0..worlds.model.count {
            let unknown = moved[body] | worlds.used & !self.boxed[body];
            if unknown == 0 {
                continue;
            }
            let motion = &worlds.motions[body];
            let after = Place { centre: motion.centre, angle: motion.angle, right: motion.right };
            self.refit_box(worlds, body, unknown, worlds.starts[body], after);
            self.boxed[body] = worlds.used;
        }
        self.find_new_pairs(worlds);
    }

    /// The same for one body, after an impact in some lanes.
    pub(crate) fn update_box(&mut self, worlds: &mut Worlds<'_>, body: usize, set: LaneSet) {
        let motion = &worlds.motions[body];
        let place = Place { centre: motion.centre, angle: motion.angle, right: motion.right };
        self.refit_box(worlds, body, set, place, place);
    }

    fn refit_box(&mut self, worlds: &mut Worlds<'_>, body: usize, set: LaneSet, before: Place, after: Place) {
        let shape = &worlds.model.shapes[body];
        let (start, end) = (bounds(shape, &before), bounds(shape, &after));
        let (min, max) = (start.0.smaller(end.0), start.1.larger(end.1));
        let (old_min, old_max) = self.boxes[body];
        let inside = at_most(old_min.x, min.x)
            & at_most(old_min.y, min.y)
            & at_most(max.x, old_max.x)
            & at_most(max.y, old_max.y);
        let left = set & !lanes(inside);
        if left == 0 {
            return;
        }
        // What is no number is compared in another way by the scalar kernel.
        let sum = min.x + min.y + max.x + max.y;
        worlds.failed |= left & !lanes(less(sum.abs(), splat(f32::INFINITY)));
        let origin =
            |place: &Place| place.centre + place.right.rotate(Vector::splat(Vec2::new(0.0, shape.origin)));
        let ahead = (origin(&after) - origin(&before)) * splat(AABB_MULTIPLIER);
        let margin = Vector::splat(Vec2::splat(MARGIN));
        let chosen = mask(left);
        self.boxes[body].0.put(chosen, min - margin + ahead.smaller(Vector::ZERO));
        self.boxes[body].1.put(chosen, max + margin + ahead.larger(Vector::ZERO));
        self.to_find[body] |= left;
        self.to_drop[body] |= left;
    }

    /// Adds all pairs that overlap the updated boxes to the contact candidates.
    pub(crate) fn find_new_pairs(&mut self, worlds: &Worlds<'_>) {
        let moved = self.to_find;
        if moved == [0; 4] {
            return;
        }
        let model = worlds.model;
        for wall in 0..model.wall_count {
            for body in 0..model.count {
                let mut new = moved[body] & !self.walls[body][wall];
                if new != 0 {
                    new &= self.overlaps_wall(worlds, wall, body);
                    self.walls[body][wall] |= new;
                    self.record(wall_key(wall, body), new);
                }
            }
        }
        for (pair, (a, b)) in PAIRS.into_iter().enumerate() {
            let mut new = (moved[a] | moved[b]) & !(self.pairs[pair] | self.held[pair]);
            if new != 0 && b < model.count {
                new &= self.overlap(a, b);
                self.pairs[pair] |= new;
                self.released[pair] &= !new;
                self.record(pair_key(pair), new);
            }
        }
        self.to_find = [0; 4];
    }

    /// Records that a pair of shapes has become a contact candidate in some lanes.
    #[inline]
    fn record(&mut self, key: usize, new: LaneSet) {
        for lane in each(new) {
            self.since[key][lane] = self.now[lane];
            self.now[lane] += 1;
            self.added[lane] |= bit(key);
        }
    }

    /// The lanes in which the boxes of a wall and a body overlap.
    #[inline]
    fn overlaps_wall(&self, worlds: &Worlds<'_>, wall: usize, body: usize) -> LaneSet {
        let wall = &worlds.model.walls[wall];
        let (min, max) = (Vector::splat(wall.min - MARGIN), Vector::splat(wall.max + MARGIN));
        overlap(&(min, max), &self.boxes[body])
    }

    /// The lanes in which the boxes of two bodies overlap.
    #[inline]
    fn overlap(&self, a: usize, b: usize) -> LaneSet {
        overlap(&self.boxes[a], &self.boxes[b])
    }

    /// Writes what a step ends with into the caches of the lanes that have not failed.
    pub(crate) fn write(&self, worlds: &Worlds<'_>, starts: &[&Start], caches: &mut [SolverCache]) {
        for lane in each(worlds.used & !worlds.failed) {
            let cache = &mut caches[starts[lane].index];
            let has = |set: LaneSet| KeySet::from(set >> lane & 1);
            (cache.active_pairs, cache.released) = (0, 0);
            for body in 0..worlds.model.count {
                for wall in 0..worlds.model.wall_count {
                    cache.active_pairs |= has(self.walls[body][wall]) << wall_key(wall, body);
                }
                cache.boxes[body] = (self.boxes[body].0.get(lane), self.boxes[body].1.get(lane));
            }
            for pair in 0..PAIRS.len() {
                cache.active_pairs |= has(self.pairs[pair]) << pair_key(pair);
                cache.released |= has(self.released[pair]) << pair_key(pair);
                cache.released_for[pair] = self.released_for[pair][lane].saturating_add(SUBSTEPS as u8);
            }
            for key in descending(self.added[lane]) {
                cache.since[key] = self.since[key][lane];
            }
            cache.now = self.now[lane];
            cache.latest_grip = worlds.latest_grip;
            for body in 0..4 {
                cache.impulses.ground[body] = worlds.ground[body].get(lane);
            }
            for agent in 0..AGENT_COUNT {
                let (impulse, twist) = &worlds.grasps[agent];
                cache.impulses.grasps[agent] = (impulse.get(lane), get(twist, lane));
            }
            cache.traces = CachedContacts::NONE;
            for trace in &self.traces {
                if let Some(kept) = trace.get(lane) {
                    cache.traces.push(kept);
                }
            }
        }
    }
}

/// Restores the impulses of contacts from the substep before.
pub(crate) fn warm_start(contacts: &mut [Contacts], traces: &[Trace]) {
    for contact in contacts {
        if let Some(trace) = traces.iter().find(|trace| trace.key == contact.key) {
            contact.warm_start(trace);
        }
    }
}

/// The box around a body, skin included (u).
#[inline]
fn bounds(shape: &Shape, place: &Place) -> Boxes {
    if shape.origin > 0.0 {
        let (min, max) = Polygons::new(shape, place.centre, place.right).bounds();
        let skin = Vector::splat(Vec2::splat(SKIN));
        (min - skin, max + skin)
    } else {
        let radius = Vector::splat(Vec2::splat(shape.radius));
        (place.centre - radius, place.centre + radius)
    }
}

#[inline]
fn overlap((min_a, max_a): &Boxes, (min_b, max_b): &Boxes) -> LaneSet {
    lanes(
        at_most(min_a.x, max_b.x)
            & at_most(min_a.y, max_b.y)
            & at_most(min_b.x, max_a.x)
            & at_most(min_b.y, max_a.y),
    )
}

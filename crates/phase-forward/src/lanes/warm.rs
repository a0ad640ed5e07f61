//! Steps with caches in each lane; see [`crate::Forward::step_warm_with`].

use super::{
    Batch,
    contact::Contacts,
    memory::{Memory, warm_start},
    reach::{self, BodyLanes},
    real::{LaneSet, differ, each, lanes, splat},
    touching::ContactList,
    worlds::{Start, Worlds},
};
use crate::{Exertion, SolverCache, constants::H, finish::stop_turning, model::Model};
use phase_model::{State, arena::SUBSTEPS};

/// States with their caches, what is done in each of them, and a place for the states after each substep.
pub(crate) struct WarmBatch<'a> {
    pub(crate) states: &'a mut [State],
    pub(crate) caches: &'a mut [SolverCache],
    pub(crate) exertions: &'a [Exertion],
    pub(crate) substeps: &'a mut [[State; SUBSTEPS]],
}

/// The same with the step of the scalar kernel.
pub(crate) struct WithAlone<'b, 'a, A> {
    pub(crate) batch: &'b mut WarmBatch<'a>,
    pub(crate) alone: A,
}

impl<A> Batch for WithAlone<'_, '_, A>
where
    A: Fn(&mut State, &mut SolverCache, &Exertion) -> [State; SUBSTEPS],
{
    fn len(&self) -> usize {
        self.batch.states.len()
    }

    fn start(&self, model: &Model, index: usize) -> Start {
        let WarmBatch { states, caches, exertions, .. } = &*self.batch;
        Start::new(model, index, &states[index], caches[index].latest_grip, exertions[index])
    }

    fn together(&mut self, model: &Model, starts: &[&Start]) -> LaneSet {
        step(model, starts, self.batch)
    }

    fn alone(&mut self, index: usize) {
        let WarmBatch { states, caches, exertions, substeps } = &mut *self.batch;
        substeps[index] = (self.alone)(&mut states[index], &mut caches[index], &exertions[index]);
    }
}

/// One step of worlds with equal signatures. Returns the lanes that were not stepped, because something rare has happened in them.
fn step(model: &Model, starts: &[&Start], batch: &mut WarmBatch<'_>) -> LaneSet {
    let WarmBatch { states, caches, substeps, .. } = batch;
    let mut worlds = Worlds::new(model, starts, states);
    let worlds = &mut worlds;
    let memory = &mut Memory::new(worlds, starts, caches);
    let mut contacts = ContactList::new();
    for start in starts {
        substeps[start.index] = [states[start.index]; SUBSTEPS];
    }
    for substep in 0..SUBSTEPS {
        worlds.substep_warm(memory, &mut contacts, substep);
        let touching = worlds.touching(&memory.pairs);
        worlds.write(starts, &touching, substeps, |substeps| &mut substeps[substep]);
    }
    memory.write(worlds, starts, caches);
    for lane in each(worlds.used & !worlds.failed) {
        let index = starts[lane].index;
        stop_turning(&mut substeps[index][SUBSTEPS - 1]);
        states[index] = substeps[index][SUBSTEPS - 1];
    }
    worlds.failed
}

impl Worlds<'_> {
    /// For each body, the lanes in which it is not where it was at the start of the substep.
    fn moved(&self) -> BodyLanes {
        core::array::from_fn(|body| {
            if body >= self.model.count {
                return 0;
            }
            let (motion, start) = (&self.motions[body], &self.starts[body]);
            let moved = differ(motion.centre.x, start.centre.x)
                | differ(motion.centre.y, start.centre.y)
                | differ(motion.angle, start.angle)
                | differ(motion.right.x, start.right.x)
                | differ(motion.right.y, start.right.y);
            self.used & lanes(moved)
        })
    }

    /// One substep of all bodies.
    fn substep_warm(&mut self, memory: &mut Memory, contacts: &mut ContactList, substep: usize) {
        let everyone = core::array::from_fn(|body| if body < self.model.count { self.used } else { 0 });
        memory.drop_stale(self);
        for body in 0..self.model.count {
            self.outline(body, self.used);
        }
        self.released = memory.limited_pairs(substep);
        let mut pairs = memory.pairs;
        for (pair, released) in pairs.iter_mut().zip(&self.released) {
            *pair |= released;
        }
        self.find_contacts(contacts, &pairs, &memory.walls);
        self.failed |= memory.sort_newest_first(contacts);
        warm_start(contacts, &memory.traces);
        self.solve(&everyone, contacts);
        memory.traces.clear();
        memory.traces.extend(contacts.iter().map(Contacts::trace));
        let moved = self.moved();
        memory.update_boxes(self, &moved);
        for body in 0..self.model.count {
            let swept = reach::walls_swept(self, body, moved[body]);
            let mut candidates = swept;
            for (swept, candidates) in candidates.iter_mut().zip(&memory.walls[body]) {
                *swept &= candidates;
            }
            let hit = self.impacts_on(body, self.used, &candidates, &splat(H));
            if hit != 0 {
                memory.update_box(self, body, hit);
            }
            // A body that has not moved since it was found inside is inside.
            let inside = memory.inside[body] & !moved[body];
            let outside = self.contain(body, self.used & !inside, &swept);
            memory.inside[body] = self.used & !outside;
            memory.boxed[body] &= !outside;
            self.outlines.moved(body, moved[body]);
        }
        memory.find_new_pairs(self);
    }
}

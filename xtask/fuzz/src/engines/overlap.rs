//! Depth of overlaps of bodies.

use super::{Kind, Scenes, Substep};
use crate::scenes::{Doing, Overlap, Start, deepest_overlap};
use phase_model::{Entity, PhysicsConfig, State, geometry::FARTHEST_CORNER, physics::RELEASED_OVERLAP};

/// Overlaps that are not looked at (u).
const LEAST: f32 = 0.02;
/// Share of a radius above which an overlap counts as deep.
const DEEP: f32 = 0.1;
/// Steps of a scene.
const STEPS: usize = 40;

/// Overlaps in scenes in which anything is done.
#[derive(Clone, Copy, PartialEq, Default, Debug)]
pub struct Overlaps {
    /// Substeps.
    pub substeps: usize,
    /// Those with an overlap deeper than a tenth of the smaller radius.
    pub deep: usize,
    /// Those of them without a held object and deeper than a released object may be.
    pub deep_and_free: usize,
    /// The deepest (u), without held objects.
    pub deepest: f32,
    /// By how much an overlap without held objects exceeds the way of both bodies in the substep, or what a
    /// released object may, at most (u).
    pub beyond: f32,
    /// Substeps that an overlap counted in `deep_and_free` lasts at most.
    pub longest: usize,
}

/// Measures overlaps in scenes `seeds`.
#[must_use]
pub fn overlaps(kind: Kind, begins: Start, seeds: core::ops::Range<u64>) -> Overlaps {
    let mut found = Overlaps::default();
    let mut lasts = 0;
    Scenes { kind, begins, doing: Doing::Anything, steps: STEPS, seeds }.run(|substep| {
        let Substep { physics, step, is_first, before, after } = substep;
        if is_first {
            lasts = 0;
        }
        // The first step separates what overlaps at the start.
        if step > 0 {
            found.substeps += 1;
            lasts = found.look(physics, before, after, lasts);
        }
    });
    found
}

impl Overlaps {
    /// Returns how many substeps the present overlap has lasted, from how many it had.
    fn look(&mut self, physics: &PhysicsConfig, before: &State, after: &State, lasted: usize) -> usize {
        let Some(overlap) = deepest_overlap(physics, after, LEAST) else { return 0 };
        let deep = overlap.share > DEEP;
        self.deep += usize::from(deep);
        if [before, after].iter().any(|state| state.grips.iter().any(Option::is_some)) {
            return 0;
        }
        self.deepest = self.deepest.max(overlap.depth);
        self.beyond = self.beyond.max(overlap_beyond(physics, before, after, &overlap));
        if deep && overlap.depth > RELEASED_OVERLAP + LEAST {
            self.deep_and_free += 1;
            self.longest = self.longest.max(lasted + 1);
            lasted + 1
        } else {
            0
        }
    }
}

/// By how much an overlap exceeds the way of both bodies in a substep and [`RELEASED_OVERLAP`] (u).
#[must_use]
pub fn overlap_beyond(physics: &PhysicsConfig, before: &State, after: &State, overlap: &Overlap) -> f32 {
    let way = |entity: Entity| {
        let [was, is] = [before, after].map(|state| state.body(entity));
        was.position.distance(is.position)
            + FARTHEST_CORNER * physics.radius(entity) * (is.angle - was.angle).abs()
    };
    let way: f32 = overlap.pair.into_iter().map(way).sum();
    overlap.depth - way.max(RELEASED_OVERLAP)
}

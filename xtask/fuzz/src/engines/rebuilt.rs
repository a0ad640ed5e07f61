//! Worlds that are rebuilt from their own states.

use super::{Quantiles, apart, quantiles};
use crate::scenes::{Doing, Start, actions, physique, start};
use phase_model::random::{Purpose, stream};
use phase_world::World;

/// Steps of a scene.
const STEPS: usize = 40;

/// Lasting worlds beside others, after one step each.
#[derive(Clone, PartialEq, Default, Debug)]
pub struct Rebuilt {
    /// Steps compared.
    pub steps: usize,
    /// Steps after which a world rebuilt from the state alone differed in any bit.
    pub differ: usize,
    /// Those of them in which no object had been released before.
    pub differ_unreleased: usize,
    /// Distance between the bodies then (u): median, nine in ten, 99 in 100, all, where nothing had been
    /// released.
    pub apart: Quantiles,
    /// Greatest distance where something had been released (u).
    pub most_released: f32,
    /// Steps after which a copy of the world differed.
    pub copies_differ: usize,
}

/// Compares one step of lasting worlds with one of worlds rebuilt before it, in scenes `seeds`.
#[must_use]
pub fn rebuilt(seeds: core::ops::Range<u64>) -> Rebuilt {
    let mut found = Rebuilt::default();
    let mut distances = Vec::new();
    for seed in seeds {
        let mut random = stream(seed, Purpose::Scene, 0);
        let physics = physique(&mut random);
        let Some(state) = start(&physics, Start::Apart, &mut random) else { continue };
        let mut world = World::new(&physics, &state);
        let mut released = false;
        for actions in actions(Doing::Anything, STEPS, &mut random) {
            let mut copy = world.clone();
            let before = world.state();
            let mut again = World::new(&physics, &before);
            let after = world.step(actions);
            let other = again.step(actions);
            found.steps += 1;
            found.copies_differ += usize::from(copy.step(actions) != after);
            if other != after {
                let distance = apart(&physics, &after[4], &other[4]);
                found.differ += 1;
                if released {
                    found.most_released = found.most_released.max(distance);
                } else {
                    found.differ_unreleased += 1;
                    distances.push(distance);
                }
            }
            released |=
                before.grips.iter().zip(&after[4].grips).any(|(was, is)| was.is_some() && is.is_none());
        }
    }
    found.apart = quantiles(&distances);
    found
}

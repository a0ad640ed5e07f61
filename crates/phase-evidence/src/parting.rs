//! Place and time at which two events part that begin alike.

use crate::Track;
use phase_model::{Entity, Vec2};

/// A difference of place that a viewer sees (u): half the radius of a small agent.
pub const VISIBLE: f32 = 0.5;

/// Difference of two events with equal bodies.
#[derive(Clone, PartialEq, Debug)]
pub struct Parting {
    /// The first step after which any place differs at all; `None` if the motion is the same.
    pub first: Option<usize>,
    /// The first visible difference, if there is one.
    pub seen: Option<Difference>,
    /// The first step after which each entity's places differ visibly, in the order of entities.
    pub entities: Vec<Option<usize>>,
    /// The largest difference of place of any entity (u).
    pub farthest: f32,
}

/// One entity in two places.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Difference {
    /// After which step.
    pub step: usize,
    /// The entity whose places differ most then.
    pub entity: Entity,
    /// Its places in the one and in the other event (u).
    pub places: [Vec2; 2],
}

impl Parting {
    /// Compares two events up to the end of the shorter one.
    #[must_use]
    pub fn of(one: &Track, other: &Track) -> Self {
        let steps = one.states.len().min(other.states.len());
        let entities: Vec<Entity> = one.physics.entities().collect();
        let apart = |entity: Entity, t: usize| {
            one.states[t].position(entity).distance(other.states[t].position(entity))
        };
        let since = |entity: Entity| (0..steps).find(|&t| apart(entity, t) > VISIBLE);
        let any = |t: &usize| entities.iter().any(|&entity| apart(entity, *t) > 0.0);
        let by_entity: Vec<Option<usize>> = entities.iter().map(|&entity| since(entity)).collect();
        let seen = by_entity.iter().flatten().min().and_then(|&step| {
            let most = |a: &Entity, b: &Entity| apart(*a, step).total_cmp(&apart(*b, step));
            let entity = entities.iter().copied().max_by(most)?;
            let places = [one, other].map(|track| track.states[step].position(entity));
            Some(Difference { step, entity, places })
        });
        let all = entities.iter().flat_map(|&entity| (0..steps).map(move |t| apart(entity, t)));
        Self { first: (0..steps).find(any), seen, entities: by_entity, farthest: all.fold(0.0, f32::max) }
    }
}

//! Sampling a place for a body that is not observed.

use crate::{
    consistency::is_clear_of_walls,
    memory::CellMemory,
    weights::{Reservoir, Weights},
};
use core::f32::consts::PI;
use phase_model::{
    Body, BodySet, Entity, MAX_ENTITIES, PhysicsConfig, State, Vec2, arena, geometry::Outline,
};
use phase_perception::Cell;
use rand::{Rng, RngExt};

/// Draws of a place for one body before all places are enumerated.
const MAX_REJECTIONS: usize = 200;
/// Joint draws of all bodies of a particle, before those that overlap are drawn one after the other.
const MAX_JOINT_REJECTIONS: usize = 8;
/// Places tried in a cell, along each side, when all cells are enumerated.
const GRID_POSES_PER_SIDE: usize = 3;

/// Samples places in one step of a belief, for all its particles.
pub(crate) struct PoseSampler<'a> {
    physics: &'a PhysicsConfig,
    memory: &'a CellMemory,
    agents: Option<Weights>,
    objects: Option<Weights>,
}

impl<'a> PoseSampler<'a> {
    pub(crate) fn new(physics: &'a PhysicsConfig, memory: &'a CellMemory) -> Self {
        Self { physics, memory, agents: None, objects: None }
    }

    /// Gives some entities of a particle new bodies at rest, which overlap neither walls, nor the other
    /// bodies, nor one another. All are drawn jointly and rejected jointly, so that the order does not
    /// matter. Returns how many could not be placed.
    pub(crate) fn resample(&mut self, particle: &mut State, which: BodySet, rng: &mut impl Rng) -> usize {
        let mut outlines = [None; MAX_ENTITIES];
        for entity in self.physics.entities().filter(|&entity| !which.contains(entity)) {
            outlines[entity.index()] = Some(Outline::of(self.physics, entity, particle.body(entity)));
        }
        for _ in 0..MAX_JOINT_REJECTIONS {
            match self.sample_jointly(particle, which, outlines, rng) {
                Some(true) => return 0,
                Some(false) => {}
                None => break,
            }
        }
        let mut unresolved = 0;
        for entity in which.iter() {
            let body = match self.draw(entity, &outlines, rng) {
                Some(body) => body,
                None => {
                    let (body, found) = self.enumerate_grid(entity, particle.body(entity), &outlines, rng);
                    unresolved += usize::from(!found);
                    body
                }
            };
            *particle.body_mut(entity) = body;
            outlines[entity.index()] = Some(Outline::of(self.physics, entity, &body));
        }
        unresolved
    }

    /// Draws each entity clear of the outlines given; false if two overlap, `None` if no place was found for
    /// one.
    fn sample_jointly(
        &mut self,
        particle: &mut State,
        which: BodySet,
        mut outlines: [Option<Outline>; MAX_ENTITIES],
        rng: &mut impl Rng,
    ) -> Option<bool> {
        let fixed = outlines;
        for entity in which.iter() {
            let body = self.draw(entity, &fixed, rng)?;
            let outline = Outline::of(self.physics, entity, &body);
            if overlaps_any(&outline, &outlines) {
                return Some(false);
            }
            outlines[entity.index()] = Some(outline);
            *particle.body_mut(entity) = body;
        }
        Some(true)
    }

    /// A random place for one entity, or `None` after too many rejections.
    fn draw(
        &mut self,
        entity: Entity,
        outlines: &[Option<Outline>; MAX_ENTITIES],
        rng: &mut impl Rng,
    ) -> Option<Body> {
        let physics = self.physics;
        let weights = self.weights(entity);
        for _ in 0..MAX_REJECTIONS {
            let cell = weights.draw(rng)?;
            let position = cell.min() + Vec2::new(rng.random(), rng.random());
            let body = Body::at_rest(position, random_angle(entity, rng));
            let outline = Outline::of(physics, entity, &body);
            let threshold = weights.of(cell) * rng.random::<f32>();
            if is_clear_of_walls(physics, &outline)
                && !overlaps_any(&outline, outlines)
                && weights.min_weight(&outline) > threshold
            {
                return Some(body);
            }
        }
        None
    }

    /// Enumerates a grid of poses and samples a feasible one in proportion to its weight. If none is
    /// feasible, returns false with one that is at least clear of walls and bodies, else of walls, else the
    /// previous pose.
    fn enumerate_grid(
        &mut self,
        entity: Entity,
        last: &Body,
        outlines: &[Option<Outline>; MAX_ENTITIES],
        rng: &mut impl Rng,
    ) -> (Body, bool) {
        let physics = self.physics;
        let weights = self.weights(entity);
        let mut possible = Reservoir::default();
        for cell in Cell::all().filter(|&cell| weights.of(cell) > 0.0) {
            for body in grid_poses(cell, entity, rng) {
                let outline = Outline::of(physics, entity, &body);
                if is_clear_of_walls(physics, &outline) && !overlaps_any(&outline, outlines) {
                    possible.offer(body, weights.min_weight(&outline), rng);
                }
            }
        }
        if let Some(body) = possible.kept {
            return (body, true);
        }
        let mut clear = Reservoir::default();
        let mut inside = Reservoir::default();
        for cell in Cell::all() {
            for body in grid_poses(cell, entity, rng) {
                let outline = Outline::of(physics, entity, &body);
                if is_clear_of_walls(physics, &outline) {
                    inside.offer(body, 1.0, rng);
                    if !overlaps_any(&outline, outlines) {
                        clear.offer(body, 1.0, rng);
                    }
                }
            }
        }
        let rest = Some(Body::at_rest(last.position, last.angle)).filter(Body::is_finite);
        (clear.kept.or(inside.kept).or(rest).unwrap_or(Body::at_rest(arena::CENTRE, 0.0)), false)
    }

    /// The weights of all cells for one kind of entity, computed on first use.
    fn weights(&mut self, entity: Entity) -> &Weights {
        let weights = match entity {
            Entity::Agent(_) => &mut self.agents,
            Entity::Object(_) => &mut self.objects,
        };
        weights.get_or_insert_with(|| Weights::new(self.memory, entity))
    }
}

/// A regular grid of positions in a cell, with random headings.
fn grid_poses(
    cell: Cell,
    entity: Entity,
    rng: &mut impl Rng,
) -> [Body; GRID_POSES_PER_SIDE * GRID_POSES_PER_SIDE] {
    core::array::from_fn(|place| {
        let column = place % GRID_POSES_PER_SIDE;
        let row = place / GRID_POSES_PER_SIDE;
        let offset = (Vec2::new(column as f32, row as f32) + 0.5) / GRID_POSES_PER_SIDE as f32;
        Body::at_rest(cell.min() + offset, random_angle(entity, rng))
    })
}

/// An agent's heading may be any; an object looks the same at any angle.
fn random_angle(entity: Entity, rng: &mut impl Rng) -> f32 {
    match entity {
        Entity::Agent(_) => PI * (2.0 * rng.random::<f32>() - 1.0),
        Entity::Object(_) => 0.0,
    }
}

fn overlaps_any(outline: &Outline, others: &[Option<Outline>; MAX_ENTITIES]) -> bool {
    others.iter().flatten().any(|other| outline.overlaps(other))
}

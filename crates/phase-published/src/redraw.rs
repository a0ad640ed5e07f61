//! The bodies of a particle that contradict an observation, and the places that they are put at instead.

use crate::{perimeter::Perimeter, senses::scaled};
use core::f32::consts::FRAC_PI_4;
use phase_model::{AgentId, Body, BodySet, Entity, Flip, PhysicsConfig, State, Vec2, geometry::Outline};
use phase_perception::{Cell, CellSet, Observation};
use rand::{Rng, RngExt};

/// Factor by which observed bodies are enlarged: unseen ones keep that clear of them.
const CLEARANCE_SCALE: f32 = 1.1;
/// Cells tried for a body without overlaps, and again for one that may overlap.
const CELL_DRAWS: usize = 10;
/// Headings tried at each cell.
const HEADINGS: usize = 8;

/// Everything that decides about unseen bodies.
pub(crate) struct Redraw<'a> {
    pub(crate) physics: &'a PhysicsConfig,
    /// The layout's reflection: the original saw the world as it was before.
    pub(crate) flip: Option<Flip>,
    /// Every cell ever seen.
    pub(crate) seen: &'a CellSet,
    pub(crate) observation: &'a Observation,
}

impl Redraw<'_> {
    /// Redraws the bodies of a particle that contradict the observation.
    pub(crate) fn apply(&self, particle: &mut State, random: &mut impl Rng) {
        let unseen = self.physics.entities().filter(|&entity| !self.observation.observed.contains(entity));
        let contradicted: BodySet =
            unseen.filter(|&entity| !self.consistent(particle, entity, particle.body(entity))).collect();
        if contradicted.is_empty() {
            return;
        }
        for agent in AgentId::ALL {
            particle.grips[agent] = particle.grips[agent].filter(|grip| {
                !contradicted.contains(Entity::Agent(agent))
                    && !contradicted.contains(Entity::Object(grip.object))
            });
        }
        let mut masked = *self.seen;
        let kept =
            |&entity: &Entity| !self.observation.observed.contains(entity) && !contradicted.contains(entity);
        for entity in self.physics.entities().filter(kept) {
            Perimeter::of(self.physics, entity, particle.body(entity))
                .cells
                .into_iter()
                .for_each(|cell| masked.insert(cell));
        }
        let mut free: Vec<Cell> = Cell::all().filter(|&cell| !masked.contains(cell)).collect();
        if free.is_empty() {
            // The original fails here. Whatever is not in view now may have been entered since.
            free = Cell::all().filter(|&cell| !self.observation.visible.contains(cell)).collect();
        }
        let mut waiting = contradicted;
        for entity in contradicted.iter() {
            waiting.remove(entity);
            if let Some(body) = self.place(particle, entity, waiting, &free, random) {
                *particle.body_mut(entity) = body;
            }
        }
    }

    /// A new pose for a body: consistent and clear of all bodies but those still waiting for theirs; else
    /// consistent; else the last one tried. `None` without cells to choose from.
    fn place(
        &self,
        particle: &State,
        entity: Entity,
        waiting: BodySet,
        free: &[Cell],
        random: &mut impl Rng,
    ) -> Option<Body> {
        let mut last = None;
        if free.is_empty() {
            return last;
        }
        for overlapping in [false, true] {
            for _ in 0..CELL_DRAWS {
                let corner = self.corner(free[random.random_range(0..free.len())]);
                let headings = if matches!(entity, Entity::Agent(_)) { HEADINGS } else { 1 };
                for heading in 0..headings {
                    let angle = FRAC_PI_4 * heading as f32;
                    let angle = self.flip.map_or(angle, |flip| flip.angle(angle));
                    let body = Body::at_rest(corner, angle);
                    last = Some(body);
                    if self.consistent(particle, entity, &body)
                        && (overlapping || self.clear(particle, entity, waiting, &body))
                    {
                        return last;
                    }
                }
            }
        }
        last
    }

    /// The corner of a cell at which bodies are put: the upper left one in the original world.
    fn corner(&self, cell: Cell) -> Vec2 {
        let upper_left = Vec2::new(-0.5, 0.5);
        cell.centre() + self.flip.map_or(upper_left, |flip| flip.vector(upper_left))
    }

    /// Whether an unseen body may be in a pose: no cell of its outline is in view or out of range, and it
    /// keeps clear of all that is observed.
    fn consistent(&self, particle: &State, entity: Entity, body: &Body) -> bool {
        if !body.is_finite() {
            return false;
        }
        let perimeter = Perimeter::of(self.physics, entity, body);
        if perimeter.out_of_range
            || perimeter.cells.iter().any(|&cell| self.observation.visible.contains(cell))
        {
            return false;
        }
        let outline = Outline::of(self.physics, entity, body);
        !self.observation.observed.iter().any(|known| {
            let known = Outline::of(self.physics, known, particle.body(known));
            outline.overlaps(&scaled(&known, CLEARANCE_SCALE))
        })
    }

    /// Whether a pose overlaps neither walls nor any body that has its place.
    fn clear(&self, particle: &State, entity: Entity, waiting: BodySet, body: &Body) -> bool {
        let outline = Outline::of(self.physics, entity, body);
        let others = self.physics.entities().filter(|&other| other != entity && !waiting.contains(other));
        outline.inside_arena()
            && !self.physics.walls.iter().any(|&wall| outline.overlaps_wall(wall))
            && !others
                .into_iter()
                .any(|other| outline.overlaps(&Outline::of(self.physics, other, particle.body(other))))
    }
}

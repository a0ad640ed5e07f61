//! The bodies of a particle that contradict an observation, and the places that they are put at instead.

use crate::{
    perimeter::Perimeter,
    recorded::{CELL_DRAWS, CLEARANCE_SCALE, HEADINGS, NEAR_TRUTH},
    senses::scaled,
};
use core::f32::consts::FRAC_PI_4;
use phase_model::{AgentId, Body, BodySet, Entity, Flip, PhysicsConfig, State, Vec2, geometry::Outline};
use phase_perception::{Cell, CellSet, Observation};
use rand::{Rng, RngExt};

/// Everything that decides about unseen bodies.
pub struct Redraw<'a> {
    /// The scene's physics.
    pub physics: &'a PhysicsConfig,
    /// The layout's reflection: the original saw the world as it was before.
    pub flip: Option<Flip>,
    /// Every cell ever seen.
    pub seen: &'a CellSet,
    /// The agent's observation.
    pub observation: &'a Observation,
    /// The state of the world, where it is known: the original looks at it, and tolerates an unseen body near
    /// its true place.
    pub truth: Option<&'a State>,
}

impl Redraw<'_> {
    /// Whether an unseen body of a particle contradicts the observation.
    #[must_use]
    pub fn contradicts(&self, particle: &State, entity: Entity) -> bool {
        !self.consistent(entity, particle.body(entity)) || self.touches_observed(particle, entity)
    }

    /// Redraws the bodies of a particle that contradict the observation.
    pub(crate) fn apply(&self, particle: &mut State, random: &mut impl Rng) {
        let unseen = self.physics.entities().filter(|&entity| !self.observation.observed.contains(entity));
        let contradicted: BodySet = unseen.filter(|&entity| self.contradicts(particle, entity)).collect();
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
        for entity in contradicted.iter() {
            if let Some(body) = self.place(particle, entity, contradicted, &free, random) {
                *particle.body_mut(entity) = body;
            }
        }
    }

    /// A new pose for a body: consistent and clear of all bodies but those redrawn; else consistent; else the
    /// last one tried. `None` without cells to choose from.
    fn place(
        &self,
        particle: &State,
        entity: Entity,
        redrawn: BodySet,
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
                    if self.consistent(entity, &body)
                        && (overlapping || self.clear(particle, entity, redrawn, &body))
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

    /// Whether an unseen body may be in a pose: no cell of its outline is out of range, and none is in view
    /// unless the body is near its true place.
    fn consistent(&self, entity: Entity, body: &Body) -> bool {
        if !body.is_finite() {
            return false;
        }
        let perimeter = Perimeter::of(self.physics, entity, body);
        let is_near = self
            .truth
            .is_some_and(|truth| (body.position - truth.position(entity)).abs().max_element() <= NEAR_TRUTH);
        !perimeter.out_of_range
            && (is_near || !perimeter.cells.iter().any(|&cell| self.observation.visible.contains(cell)))
    }

    /// Whether an unseen body overlaps an observed one, enlarged.
    fn touches_observed(&self, particle: &State, entity: Entity) -> bool {
        let outline = Outline::of(self.physics, entity, particle.body(entity));
        self.observation.observed.iter().any(|known| {
            let known = Outline::of(self.physics, known, particle.body(known));
            outline.overlaps(&scaled(&known, CLEARANCE_SCALE))
        })
    }

    /// Whether a pose keeps clear of what is observed and of unseen bodies that are kept. Walls do not count.
    fn clear(&self, particle: &State, entity: Entity, redrawn: BodySet, body: &Body) -> bool {
        let outline = Outline::of(self.physics, entity, body);
        let mut others = self.physics.entities().filter(|&other| other != entity && !redrawn.contains(other));
        !others.any(|other| {
            let scale = if self.observation.observed.contains(other) { CLEARANCE_SCALE } else { 1.0 };
            outline.overlaps(&scaled(&Outline::of(self.physics, other, particle.body(other)), scale))
        })
    }
}

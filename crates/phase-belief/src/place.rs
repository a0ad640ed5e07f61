//! Drawing a place for a body that is not observed.

use crate::{consistency::is_clear_of_walls, memory::CellMemory};
use core::f32::consts::PI;
use phase_model::{Body, Entity, EntitySet, MAX_ENTITIES, Physique, State, Vec2, geometry::Outline};
use phase_perception::{Cell, cells::CELL_COUNT, footprint::any_cell};
use rand::{Rng, RngExt};

/// Tries at a place for one body before all places are gone through.
const TRIES: usize = 200;
/// Draws of all bodies of a particle together, before those that overlap are drawn one after the other.
const JOINT_TRIES: usize = 8;
/// Places tried in a cell, along each side, when all cells are gone through.
const PLACES_PER_SIDE: usize = 2;

/// Draws places in one step of a belief, for all its particles.
pub(crate) struct Placer<'a> {
    physique: &'a Physique,
    memory: &'a CellMemory,
    agents: Option<Weights>,
    objects: Option<Weights>,
}

impl<'a> Placer<'a> {
    pub(crate) fn new(physique: &'a Physique, memory: &'a CellMemory) -> Self {
        Self { physique, memory, agents: None, objects: None }
    }

    /// Gives some entities of a particle new bodies at rest, which overlap neither walls, nor the other bodies,
    /// nor one another. All are drawn together and together rejected, so that none has the first choice.
    /// Returns how many could not be placed.
    pub(crate) fn redraw(&mut self, particle: &mut State, which: EntitySet, rng: &mut impl Rng) -> usize {
        let mut outlines = [None; MAX_ENTITIES];
        for entity in self.physique.entities().filter(|&entity| !which.contains(entity)) {
            outlines[entity.index()] = Some(Outline::of(self.physique, entity, particle.body(entity)));
        }
        for _ in 0..JOINT_TRIES {
            if self.draw_all(particle, which, outlines, rng) {
                return 0;
            }
        }
        let mut unresolved = 0;
        for entity in which.iter() {
            let body = match self.draw(entity, &outlines, rng) {
                Some(body) => body,
                None => {
                    let (body, found) = self.search(entity, particle.body(entity), &outlines, rng);
                    unresolved += usize::from(!found);
                    body
                }
            };
            *particle.body_mut(entity) = body;
            outlines[entity.index()] = Some(Outline::of(self.physique, entity, &body));
        }
        unresolved
    }

    /// Draws each entity clear of the outlines given; false if one found no place or two overlap.
    fn draw_all(
        &mut self,
        particle: &mut State,
        which: EntitySet,
        mut outlines: [Option<Outline>; MAX_ENTITIES],
        rng: &mut impl Rng,
    ) -> bool {
        let fixed = outlines;
        for entity in which.iter() {
            let Some(body) = self.draw(entity, &fixed, rng) else { return false };
            let outline = Outline::of(self.physique, entity, &body);
            if overlaps_any(&outline, &outlines) {
                return false;
            }
            outlines[entity.index()] = Some(outline);
            *particle.body_mut(entity) = body;
        }
        true
    }

    /// A random place for one entity, or `None` after too many rejections.
    fn draw(
        &mut self,
        entity: Entity,
        outlines: &[Option<Outline>; MAX_ENTITIES],
        rng: &mut impl Rng,
    ) -> Option<Body> {
        let physique = self.physique;
        let weights = self.weights(entity);
        for _ in 0..TRIES {
            let cell = weights.draw(rng)?;
            let position = cell.min() + Vec2::new(rng.random(), rng.random());
            let body = Body::at_rest(position, random_angle(entity, rng));
            let outline = Outline::of(physique, entity, &body);
            let threshold = weights.of(cell) * rng.random::<f32>();
            if is_clear_of_walls(physique, &outline)
                && !overlaps_any(&outline, outlines)
                && weights.least(&outline) > threshold
            {
                return Some(body);
            }
        }
        None
    }

    /// Goes through all cells and picks one of the possible places in proportion to its weight. If no place is
    /// possible, one that is at least clear of walls and bodies, or else of walls, or else where the body was or
    /// the first place tried, and false.
    fn search(
        &mut self,
        entity: Entity,
        last: &Body,
        outlines: &[Option<Outline>; MAX_ENTITIES],
        rng: &mut impl Rng,
    ) -> (Body, bool) {
        let physique = self.physique;
        let weights = self.weights(entity);
        let (mut possible, mut clear, mut inside) =
            (Reservoir::default(), Reservoir::default(), Reservoir::default());
        for cell in Cell::all() {
            for place in 0..PLACES_PER_SIDE * PLACES_PER_SIDE {
                let (column, row) = (place % PLACES_PER_SIDE, place / PLACES_PER_SIDE);
                let offset = (Vec2::new(column as f32, row as f32) + 0.5) / PLACES_PER_SIDE as f32;
                let body = Body::at_rest(cell.min() + offset, random_angle(entity, rng));
                let outline = Outline::of(physique, entity, &body);
                if !is_clear_of_walls(physique, &outline) {
                    continue;
                }
                inside.offer(body, 1.0, rng);
                if overlaps_any(&outline, outlines) {
                    continue;
                }
                clear.offer(body, 1.0, rng);
                possible.offer(body, weights.least(&outline), rng);
            }
        }
        if let Some(body) = possible.kept {
            return (body, true);
        }
        let rest = Some(Body::at_rest(last.position, last.angle)).filter(Body::is_finite);
        let body = clear.kept.or(inside.kept).or(rest).unwrap_or_default();
        (body, false)
    }

    /// The weights of all cells for one kind of entity, reckoned when first needed.
    fn weights(&mut self, entity: Entity) -> &Weights {
        let weights = match entity {
            Entity::Agent(_) => &mut self.agents,
            Entity::Object(_) => &mut self.objects,
        };
        weights.get_or_insert_with(|| Weights::new(self.memory, entity))
    }
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

/// The weight of each cell, ready for drawing cells in proportion.
struct Weights {
    weights: [f32; CELL_COUNT],
    /// Sum of the weights up to and including each cell.
    sums: [f32; CELL_COUNT],
}

impl Weights {
    fn new(memory: &CellMemory, entity: Entity) -> Self {
        let (mut weights, mut sums) = ([0.0; CELL_COUNT], [0.0; CELL_COUNT]);
        let mut sum = 0.0;
        for cell in Cell::all() {
            let weight = memory.weight(entity, cell);
            sum += weight;
            weights[cell.index()] = weight;
            sums[cell.index()] = sum;
        }
        Self { weights, sums }
    }

    fn of(&self, cell: Cell) -> f32 {
        self.weights[cell.index()]
    }

    /// A cell in proportion to its weight, or `None` if all weigh nothing.
    fn draw(&self, rng: &mut impl Rng) -> Option<Cell> {
        let mark = rng.random::<f32>() * self.sums[CELL_COUNT - 1];
        // Rounding may put the mark onto the very end, past all cells.
        Cell::from_index(self.sums.partition_point(|&sum| sum <= mark))
    }

    /// The least weight of the cells an outline lies on, 0 if it lies on none.
    fn least(&self, outline: &Outline) -> f32 {
        let mut least = f32::INFINITY;
        let nothing = any_cell(outline, |cell| {
            least = least.min(self.of(cell));
            least <= 0.0
        });
        if nothing || least == f32::INFINITY { 0.0 } else { least }
    }
}

/// One of many bodies, kept with a probability in proportion to its weight.
#[derive(Default)]
struct Reservoir {
    kept: Option<Body>,
    total: f32,
}

impl Reservoir {
    fn offer(&mut self, body: Body, weight: f32, rng: &mut impl Rng) {
        if weight > 0.0 {
            self.total += weight;
            if rng.random::<f32>() * self.total < weight {
                self.kept = Some(body);
            }
        }
    }
}

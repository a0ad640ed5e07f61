//! The input of all networks: an event as nodes, one for each agent, object, landmark and inner wall
//! (appendix, "Baseline Implementation").

mod batch;
mod contact;
mod embedding;
mod features;
mod readers;

pub use batch::Batch;
pub use contact::ContactMatrix;
pub use embedding::NodeEmbedding;
pub use features::FEATURES;
pub(crate) use features::{LENGTH, SPEED};
pub use readers::{FixedEmbedding, GoalHead};
pub(crate) use readers::{last_output, max_pool};

use contact::contacts;
use features::{body, landmark, wall};
use phase_event::ObservedEvent;
use phase_model::{MAX_ENTITIES, Segment, Vec2, arena::LANDMARKS};

/// Nodes that move: agents, then objects.
pub const MOVING: usize = MAX_ENTITIES;
/// Inner walls, at most.
pub const WALLS: usize = 4;
/// Fixed nodes: landmarks, then inner walls.
pub const FIXED: usize = LANDMARKS.len() + WALLS;
/// All nodes, moving ones first. Absent objects and walls keep their places.
pub const NODES: usize = MOVING + FIXED;

/// An event as features for networks. It is made of an [`ObservedEvent`], so it cannot contain labels.
#[derive(Clone, PartialEq, Debug)]
pub struct Nodes {
    /// Number of objects, 0 to 2.
    objects: usize,
    /// Features of agents and objects, by row.
    moving: Vec<[[f32; FEATURES]; MOVING]>,
    /// Features of landmarks and of the existing walls.
    fixed: Vec<[f32; FEATURES]>,
    /// Positions of agents and objects (u), by row.
    positions: Vec<[Vec2; MOVING]>,
    /// Positions of landmarks and walls (u), walls by their centres.
    places: Vec<Vec2>,
    /// The pairs of agents and objects that are in contact, by row.
    contacts: Vec<ContactMatrix>,
    /// The inner walls (u).
    walls: Vec<Segment>,
}

impl Nodes {
    /// The nodes of an event.
    #[must_use]
    pub fn of(event: &ObservedEvent) -> Self {
        let mut radii = [0.0; MOVING];
        let sizes = event.agent_sizes();
        for (radius, size) in radii.iter_mut().zip(sizes.iter().chain(event.object_sizes())) {
            *radius = size.radius();
        }
        let entities = event.entities().count();
        let moving = event.rows().iter().map(|row| {
            core::array::from_fn(|k| if k < entities { body(k, radii[k], &row[k]) } else { [0.0; FEATURES] })
        });
        let positions: Vec<[Vec2; MOVING]> = event
            .rows()
            .iter()
            .map(|row| core::array::from_fn(|k| if k < entities { row[k].position } else { Vec2::ZERO }))
            .collect();
        let walls = event.layout().walls();
        let contacts = positions.iter().map(|row| contacts(row, &radii, entities, &walls)).collect();
        Self {
            objects: event.object_sizes().len(),
            moving: moving.collect(),
            fixed: (0..LANDMARKS.len()).map(landmark).chain(walls.iter().map(wall)).collect(),
            positions,
            places: LANDMARKS.into_iter().chain(walls.iter().map(|wall| (wall.a + wall.b) / 2.0)).collect(),
            contacts,
            walls,
        }
    }

    /// Rows of the event, at least 1.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.moving.len()
    }

    /// Whether such a node exists (0 to [`NODES`] − 1).
    #[must_use]
    pub fn has(&self, node: usize) -> bool {
        if node < MOVING { self.has_moving(node) } else { node - MOVING < self.fixed.len() }
    }

    fn has_moving(&self, node: usize) -> bool {
        node < phase_model::AGENT_COUNT + self.objects
    }
}

//! An agent's observation as a vector of 32-bit floats, for learners and for minds in other languages.
//!
//! The vector has [`SIZE`] numbers, in the parts and the order of [`PARTS`]. The observing agent comes first,
//! then the other agent, then the objects; a number about something that the agent does not observe is 0. The
//! last parts hold what both agents know of their scene: bodies, doors, both goals, and the agent's own
//! attitude (the paper: "we assume agents know each other's goals").
//!
//! Key design decision: the vector is complete. [`VectorWriter::write`] and [`read`] are inverse to each
//! other, so a mind that reads vectors decides as one that was given the observations. The trade-off is a
//! longer vector than most learners need: 400 of its numbers are the field of view.
//!
//! Each part with its shape:
//!
//! - `entities` (4 × 11): present, observed, touched (0 or 1); x, y (u); cosine, sine of the angle; angle
//!   (rad); vx, vy (u/s); angular velocity (rad/s)
//! - `grips` (2 × 7): of each agent: holds object 0, object 1; by its head, tail, right, left (0 or 1); the
//!   object's angle minus the agent's (rad)
//! - `contacts` (6): of the pairs (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3) of `entities`: in contact (0
//!   or 1)
//! - `visible` (20 × 20): cells of the arena, row by row from the bottom left: in the field of view (0 or 1)
//! - `radii` (4): of `entities` (u); 0 for an absent object
//! - `forces` (2): maximum force of each agent (100 N)
//! - `doors` (4 × 2): of each inner wall: how far from the centre its door begins and ends (u); 0,
//!   0 without a door
//! - `attitude` (1): of the agent: 1 helps, −1 hinders, 0 neither
//! - `own_goal` (12): kind (agent on landmark, object on landmark, touch), subject (as in `entities`),
//!   landmark: one of each is 1; sign, 1 or −1
//! - `other_goal` (12): the other agent's goal, as `own_goal`
//! - `holds` (2): the agent's goal holds, the other's goal holds, as far as the agent observes it (0 or 1)
//! - `landmarks` (4 × 2): x, y (u): equal in all scenes
//! - `agent` (1): number of the agent, 0 or 1

mod read;
mod write;

pub use read::{InvalidVector, read};
pub use write::VectorWriter;

use core::ops::Range;
use phase_model::{AGENT_COUNT, AgentId, Entity, MAX_ENTITIES, ObjectId};
use phase_perception::cells::CELLS_PER_SIDE;

/// A part of the vector. Its numbers stand row by row.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Part {
    /// The name, as in the list of [the module](self).
    pub name: &'static str,
    /// The length along each dimension.
    pub shape: &'static [usize],
}

impl Part {
    /// The number of numbers: the product of the shape.
    #[must_use]
    pub const fn len(&self) -> usize {
        let mut product = 1;
        let mut dimension = 0;
        while dimension < self.shape.len() {
            product *= self.shape[dimension];
            dimension += 1;
        }
        product
    }

    /// Whether the part has no number; none of [`PARTS`] is empty.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    const fn new(name: &'static str, shape: &'static [usize]) -> Self {
        Self { name, shape }
    }
}

/// The parts of the vector, in order.
pub const PARTS: [Part; 13] = [
    Part::new("entities", &[MAX_ENTITIES, ENTITY_NUMBERS]),
    Part::new("grips", &[AGENT_COUNT, GRIP_NUMBERS]),
    Part::new("contacts", &[PAIRS.len()]),
    Part::new("visible", &[CELLS_PER_SIDE, CELLS_PER_SIDE]),
    Part::new("radii", &[MAX_ENTITIES]),
    Part::new("forces", &[AGENT_COUNT]),
    Part::new("doors", &[4, 2]),
    Part::new("attitude", &[1]),
    Part::new("own_goal", &[GOAL_NUMBERS]),
    Part::new("other_goal", &[GOAL_NUMBERS]),
    Part::new("holds", &[AGENT_COUNT]),
    Part::new("landmarks", &[4, 2]),
    Part::new("agent", &[1]),
];

/// The number of numbers in the vector.
pub const SIZE: usize = range(PARTS.len() - 1).end;

// Indices of parts.
const ENTITIES: usize = 0;
const GRIPS: usize = 1;
const CONTACTS: usize = 2;
const VISIBLE: usize = 3;
const HOLDS: usize = 10;

/// The numbers of a part within the vector.
const fn range(part: usize) -> Range<usize> {
    let mut start = 0;
    let mut before = 0;
    while before < part {
        start += PARTS[before].len();
        before += 1;
    }
    start..start + PARTS[part].len()
}

/// Numbers in the parts that change during an event and stand before those of the scene.
const MOVING: usize = range(VISIBLE).end;

const ENTITY_NUMBERS: usize = 11;
const GRIP_NUMBERS: usize = 7;
const GOAL_NUMBERS: usize = 12;

/// All pairs of entities, by their places in the agent's order.
const PAIRS: [(usize, usize); 6] = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];

/// The entities in the order of an agent's vector: itself, the other agent, both objects.
const fn order(agent: AgentId) -> [Entity; MAX_ENTITIES] {
    let [first, second] = ObjectId::ALL;
    [Entity::Agent(agent), Entity::Agent(agent.other()), Entity::Object(first), Entity::Object(second)]
}

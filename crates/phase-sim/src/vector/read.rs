//! From vectors to observations.

use super::{CONTACTS, ENTITIES, ENTITY_NUMBERS, GRIP_NUMBERS, GRIPS, PAIRS, SIZE, VISIBLE, order, range};
use phase_model::{AgentId, Body, BodySet, Entity, Grip, MAX_ENTITIES, ObjectId, Side, State, Vec2};
use phase_perception::{Cell, CellSet, Observation};

/// The numbers are not an observation of the agent.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
pub enum InvalidVector {
    /// The slice is too short or too long.
    #[error("an observation has {SIZE} numbers, not {found}")]
    Length {
        /// Its length.
        found: usize,
    },
    /// A number is infinite or not a number.
    #[error("an observation has finite numbers; number {index} is {number}")]
    NotFinite {
        /// Its place in the vector.
        index: usize,
        /// The number.
        number: f32,
    },
    /// The last number is not that of the agent.
    #[error("the observation is of agent {found}, not of agent {}", agent.number())]
    OtherAgent {
        /// The last number of the vector.
        found: f32,
        /// The agent that was asked for.
        agent: AgentId,
    },
    /// The agent does not observe itself.
    #[error("an agent always observes itself: entity 0 of its observation must be observed")]
    SelfUnobserved,
}

/// Reads the observation of an agent from a vector, as [`VectorWriter::write`](super::VectorWriter::write)
/// has it.
///
/// Only the parts `entities`, `grips`, `contacts`, `visible` and `agent` are read: an observation does not
/// contain the scene. A flag is set if its number is greater than 0.5. The angle is read, its cosine and its
/// sine are not.
///
/// # Errors
/// [`InvalidVector`] for another length than [`SIZE`], for a number that is not finite, for a vector of the
/// other agent, and for one in which the agent does not observe itself.
pub fn read(agent: AgentId, numbers: &[f32]) -> Result<Observation, InvalidVector> {
    check(agent, numbers)?;
    let order = order(agent);
    let mut known = State::new([Body::default(); MAX_ENTITIES]);
    let mut observed = BodySet::EMPTY;
    let mut touched = BodySet::EMPTY;
    for (numbers, entity) in numbers[range(ENTITIES)].chunks_exact(ENTITY_NUMBERS).zip(order) {
        if numbers[2] > 0.5 {
            touched.insert(entity);
        }
        if numbers[1] > 0.5 {
            observed.insert(entity);
            *known.body_mut(entity) = Body {
                position: Vec2::new(numbers[3], numbers[4]),
                angle: numbers[7],
                velocity: Vec2::new(numbers[8], numbers[9]),
                angular_velocity: numbers[10],
            };
        }
    }
    if !observed.contains(Entity::Agent(agent)) {
        return Err(InvalidVector::SelfUnobserved);
    }
    let grips = numbers[range(GRIPS)].chunks_exact(GRIP_NUMBERS);
    for (numbers, holder) in grips.zip([agent, agent.other()]) {
        known.grips[holder] = read_grip(numbers);
    }
    for (number, (a, b)) in numbers[range(CONTACTS)].iter().zip(PAIRS) {
        if *number > 0.5 {
            known.contacts.insert(order[a], order[b]);
        }
    }
    let mut visible = CellSet::EMPTY;
    for (cell, number) in Cell::all().zip(&numbers[range(VISIBLE)]) {
        if *number > 0.5 {
            visible.insert(cell);
        }
    }
    Ok(Observation::from_parts(agent, visible, observed, touched, &known))
}

fn check(agent: AgentId, numbers: &[f32]) -> Result<(), InvalidVector> {
    if numbers.len() != SIZE {
        return Err(InvalidVector::Length { found: numbers.len() });
    }
    if let Some(index) = numbers.iter().position(|number| !number.is_finite()) {
        return Err(InvalidVector::NotFinite { index, number: numbers[index] });
    }
    let found = numbers[SIZE - 1];
    if found != f32::from(agent.number()) {
        return Err(InvalidVector::OtherAgent { found, agent });
    }
    Ok(())
}

/// The grip of an agent, if it holds an object by a side.
fn read_grip(numbers: &[f32]) -> Option<Grip> {
    let object = ObjectId::ALL.into_iter().find(|&object| numbers[usize::from(object)] > 0.5)?;
    let (side, _) = Side::ALL.into_iter().zip(&numbers[2..6]).find(|(_, number)| **number > 0.5)?;
    Some(Grip { object, side, relative_angle: numbers[6] })
}

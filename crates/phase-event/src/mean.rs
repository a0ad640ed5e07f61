//! One state for each step: the means stored in files and used for evaluation.

use crate::Step;
use phase_model::{Body, Contacts, MAX_ENTITIES, State, arena::SUBSTEPS};

/// The state that represents a whole step in files and in evaluation.
///
/// Bodies are means over its five substeps (angles are unbounded, so
/// a plain mean is valid), grips are those at its end, and contacts are the union over its substeps.
#[must_use]
pub fn mean_state(step: &Step) -> State {
    let mut state = step.substeps[SUBSTEPS - 1];
    for entity in 0..MAX_ENTITIES {
        state.bodies[entity] = mean(step.substeps.map(|substep| substep.bodies[entity]));
    }
    state.contacts = step.substeps.iter().fold(Contacts::NONE, |all, substep| all.union(substep.contacts));
    state
}

fn mean(bodies: [Body; SUBSTEPS]) -> Body {
    let over = |number: fn(&Body) -> f32| {
        let sum: f64 = bodies.iter().map(|body| f64::from(number(body))).sum();
        (sum / SUBSTEPS as f64) as f32
    };
    let mut mean = Body::default();
    mean.position.x = over(|body| body.position.x);
    mean.position.y = over(|body| body.position.y);
    mean.velocity.x = over(|body| body.velocity.x);
    mean.velocity.y = over(|body| body.velocity.y);
    mean.angle = over(|body| body.angle);
    mean.angular_velocity = over(|body| body.angular_velocity);
    mean
}

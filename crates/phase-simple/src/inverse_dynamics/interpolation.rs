//! The states between steps from rows alone, which are means over steps: used to continue where motion cannot
//! be explained.

use phase_event::ObservedEvent;
use phase_model::{Body, MAX_ENTITIES, State, arena};

/// How far the end of a step lies on the way from its mean to the mean of the next: the mean stands for the third of
/// five substeps, the end is the fifth.
const END_OF_STEP: f32 = 0.4;
/// Substeps from the mean of a step to its end.
const SUBSTEPS_TO_END: f32 = 2.0;

/// The state at the end of every step, state 0 being row 0, without grips and contacts.
pub(super) fn states(observed: &ObservedEvent) -> Vec<State> {
    let rows = observed.rows();
    (0..rows.len()).map(|t| State::new(core::array::from_fn(|entity| body(rows, t, entity)))).collect()
}

fn body(rows: &[[Body; MAX_ENTITIES]], t: usize, entity: usize) -> Body {
    let mean = rows[t][entity];
    match rows.get(t + 1) {
        _ if t == 0 => mean,
        Some(next) => between(&mean, &next[entity]),
        None => {
            let seconds = SUBSTEPS_TO_END * arena::SUBSTEP_SECONDS;
            Body { position: mean.position + mean.velocity * seconds, angular_velocity: 0.0, ..mean }
        }
    }
}

fn between(a: &Body, b: &Body) -> Body {
    Body {
        position: a.position.lerp(b.position, END_OF_STEP),
        velocity: a.velocity.lerp(b.velocity, END_OF_STEP),
        angle: a.angle + (b.angle - a.angle) * END_OF_STEP,
        angular_velocity: 0.0,
    }
}

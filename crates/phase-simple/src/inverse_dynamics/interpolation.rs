//! The states between steps from rows alone, which are means over steps: used to continue where motion cannot
//! be explained.

use super::reading::Reading;
use phase_model::{Body, MAX_ENTITIES, State, arena};

/// Share of the way from the mean of a step to the mean of the next at which the step ends: the mean stands
/// for the third of five substeps, the end is the fifth.
const END_OF_STEP: f32 = 0.4;
/// Substeps from the mean of a step to its end.
pub(super) const SUBSTEPS_TO_END: f32 = 2.0;

/// The state at the end of every step, state 0 being row 0, without grips and contacts.
pub(super) fn states(reading: &Reading) -> Vec<State> {
    (0..reading.event.rows().len()).map(|t| state(reading, t)).collect()
}

/// The state at the end of step `t`.
pub(super) fn state(reading: &Reading, t: usize) -> State {
    State::new(core::array::from_fn(|entity| body(reading, t, entity)))
}

fn body(reading: &Reading, t: usize, entity: usize) -> Body {
    let rows: &[[Body; MAX_ENTITIES]] = reading.event.rows();
    let mean = rows[t][entity];
    match rows.get(t + 1) {
        _ if t == 0 => mean,
        Some(next) => between(&mean, &next[entity], reading.angle_periods[entity]),
        None => {
            let seconds = SUBSTEPS_TO_END * arena::SUBSTEP_SECONDS;
            Body { position: mean.position + mean.velocity * seconds, angular_velocity: 0.0, ..mean }
        }
    }
}

fn between(a: &Body, b: &Body, angle_period: Option<f32>) -> Body {
    let turned = angle_period.map_or(0.0, |period| libm::remainderf(b.angle - a.angle, period));
    Body {
        position: a.position.lerp(b.position, END_OF_STEP),
        velocity: a.velocity.lerp(b.velocity, END_OF_STEP),
        angle: a.angle + turned * END_OF_STEP,
        angular_velocity: 0.0,
    }
}

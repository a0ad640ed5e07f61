//! One way to explain an event as far as it has been followed.

use super::{
    difference::Difference,
    replay::{ALL_LEVELS, Replay, TrackedState},
    search::Explanation,
};
use phase_model::{AGENT_COUNT, Action, Body, MAX_ENTITIES, State};

/// Residual of a step that the physics explains (u).
const RESIDUAL_SCALE: f64 = 0.005;
/// Cost of attaching or detaching beside its residual, in logarithms: it is rare.
const GRIP_CHANGE_COST: f64 = 0.5;
/// Difference below which a body is not corrected by the observation (u): it is exact.
const UNCORRECTED: f32 = 0.0005;
/// Residual of a step above which a path continues from the corrected state only (u).
const ALWAYS_CORRECTED: f32 = 0.1;
/// Residual of a step above which the contact memory does not apply to the corrected state (u).
const FORGET_CONTACTS: f32 = 0.2;
/// Prediction error beyond which a body is reset to the observation (u, rad).
const RESET: f32 = 0.4;
/// Cost of not correcting a state that is not exact, in logarithms: of two states that explain the rest of
/// the event equally well, the corrected one is taken.
const UNCORRECTED_COST: f64 = 1e-3;
/// Difference up to which states are the same (u, u/s, rad).
const SAME: f32 = 2e-4;

/// The last step of a path, and which path it continues.
#[derive(Clone, Debug)]
pub(super) struct Path {
    /// The number of the path before this step.
    pub(super) before: Option<usize>,
    /// The number of the reading of the event.
    pub(super) reading: usize,
    /// Whether it is the event before it was mirrored.
    mirrored: bool,
    pub(super) tracked: TrackedState,
    /// Possible strengths of each agent, one bit for each level.
    pub(super) strengths: [u8; AGENT_COUNT],
    /// The actions of the step, as the reading has them.
    pub(super) actions: [Action; AGENT_COUNT],
    /// Residual of the step (u).
    pub(super) residual: f32,
    /// Cost of the whole path, in logarithms.
    pub(super) cost: f64,
}

impl Path {
    /// The beginning of a reading.
    pub(super) fn start(reading: usize, replay: &Replay) -> Self {
        Self {
            before: None,
            reading,
            mirrored: replay.reading.is_mirrored(),
            tracked: replay.start(),
            strengths: [ALL_LEVELS; AGENT_COUNT],
            actions: [Action::NoForce; AGENT_COUNT],
            residual: 0.0,
            cost: replay.reading.cost,
        }
    }

    /// The path continued by an explanation of the next step, from the state that it predicts, from that
    /// state corrected by the observation, or both; `number` is its own number, `between` the state
    /// afterwards by interpolation.
    pub(super) fn extended(
        &self,
        number: usize,
        replay: &Replay,
        explanation: Explanation,
        between: &State,
    ) -> Vec<Self> {
        let Explanation { candidates, predicted } = explanation;
        let mut strengths = self.strengths;
        for (strengths, (action, level)) in strengths.iter_mut().zip(candidates) {
            if action.push().is_some() {
                *strengths = 1 << level;
            }
        }
        let grips = predicted.end.state.grips.iter().zip(&self.tracked.state.grips);
        let changes = grips.filter(|(after, before)| after.is_some() != before.is_some()).count();
        let mut plain = Self {
            before: Some(number),
            reading: self.reading,
            mirrored: self.mirrored,
            tracked: predicted.end,
            strengths,
            actions: candidates.map(|(action, _)| action),
            residual: predicted.residual,
            cost: self.cost + cost(predicted.residual, replay.noise) + GRIP_CHANGE_COST * changes as f64,
        };
        if predicted.residual <= UNCORRECTED {
            return vec![plain];
        }
        let mut corrected = plain.clone();
        corrected.correct(replay, &predicted.differences, between);
        if predicted.residual > ALWAYS_CORRECTED + 2.0 * replay.noise {
            return vec![corrected];
        }
        plain.cost += UNCORRECTED_COST;
        vec![corrected, plain]
    }

    /// Corrects the state by what was observed.
    fn correct(&mut self, replay: &Replay, differences: &[Difference; MAX_ENTITIES], between: &State) {
        for entity in replay.bodies() {
            let difference = &differences[entity];
            if difference.square(replay.radii[entity], replay.noise == 0.0) < UNCORRECTED * UNCORRECTED {
                continue;
            }
            let body = &mut self.tracked.state.bodies[entity];
            let off = difference.position.length().max(difference.angle.abs());
            *body = if off > RESET {
                let observed = &between.bodies[entity];
                // Of all angles that look like the observed one, the nearest.
                let turned = Difference::between(body, observed, replay.reading.angle_periods[entity]).angle;
                Body { angle: body.angle + turned, angular_velocity: body.angular_velocity, ..*observed }
            } else if replay.noise > 0.0 {
                difference.partly_added_to(body)
            } else {
                difference.added_to(body)
            };
        }
        if self.residual > FORGET_CONTACTS + 2.0 * replay.noise {
            self.tracked = replay.at(self.tracked.state);
        }
    }

    /// Whether both agents hold the same by the same sides.
    pub(super) fn same_grips(&self, other: &Self) -> bool {
        let grips =
            |path: &Self| path.tracked.state.grips.map(|grip| grip.map(|grip| (grip.object, grip.side)));
        self.mirrored == other.mirrored && grips(self) == grips(other)
    }

    /// Whether two paths have come to the same state, so that the cheaper one will stay the cheaper.
    pub(super) fn same_state(&self, other: &Self) -> bool {
        let bodies = &self.tracked.state.bodies;
        let others = &other.tracked.state.bodies;
        let same = |(a, b): (&Body, &Body)| {
            (a.position - b.position).abs().max_element() < SAME
                && (a.velocity - b.velocity).abs().max_element() < SAME
                && (a.angle - b.angle).abs() < SAME
        };
        self.same_grips(other)
            && self.tracked.late == other.tracked.late
            && bodies.iter().zip(others).all(same)
    }
}

/// Cost of a residual (u), in logarithms, if errors of rows alone leave `noise` (u): a heavy-tailed
/// distribution, since motion that cannot be explained does occur.
pub(super) fn cost(residual: f32, noise: f32) -> f64 {
    let scaled = f64::from(residual) / libm::hypot(RESIDUAL_SCALE, f64::from(noise));
    libm::log1p(scaled * scaled)
}

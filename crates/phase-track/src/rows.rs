//! From poses in frames to rows of an event.

use crate::{Track, TrackError};
use phase_event::Row;
use phase_model::{
    AGENT_COUNT, Vec2,
    arena::{STEP_SECONDS, STEP_VIDEO_SECONDS, SUBSTEP_SECONDS, SUBSTEPS},
};

/// Meaning of a video's frames.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FrameMeaning {
    /// The motion itself: a row is the mean over the five moments of its step.
    Substeps,
    /// Rows, with bodies drawn straight from row to row: a row is what is shown every 0.25 s.
    Rows,
}

/// Rows of one body with the standard deviations of their columns `x`, `y`, `vx`, `vy` and `angle`.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct BodyRows {
    /// As in an event: x, y (u), vx, vy (u/s of physics), angle (rad).
    pub rows: Vec<Row>,
    /// In the same units.
    pub deviations: Vec<Row>,
}

/// x, y (u) and angle (rad), and their standard deviations.
type Reading = ([f64; 3], [f64; 3]);

/// Share of the bends in a path that lie inside steps, below which bodies go straight from row to row.
const STRAIGHT: f64 = 0.3;

impl Track {
    /// The meaning of the frames, as far as the motion tells: whether paths bend at every frame, or only
    /// every 0.25 s.
    #[must_use]
    pub fn meaning(&self) -> FrameMeaning {
        let mut inside = (0.0, 0);
        let mut at_rows = (0.0, 0);
        for body in 0..self.bodies.len() {
            for three in self.moments.windows(3) {
                if three.iter().any(|moment| !moment.bodies[body].seen) {
                    continue;
                }
                let [a, b, c] = [0, 1, 2].map(|k| &three[k]);
                let place = |k: usize| three[k].bodies[body].pose.position.as_dvec2();
                let ahead = (place(2) - place(1)) / (c.seconds - b.seconds);
                let behind = (place(1) - place(0)) / (b.seconds - a.seconds);
                if ahead.length().max(behind.length()) < 0.4 {
                    continue;
                }
                let steps = |seconds: f64| seconds / STEP_VIDEO_SECONDS + 1e-6;
                let bend = (ahead - behind).length_squared().min(4.0);
                let sum = if steps(a.seconds).floor() == (steps(c.seconds) - 2e-6).floor() {
                    &mut inside
                } else {
                    &mut at_rows
                };
                sum.0 += bend;
                sum.1 += 1;
            }
        }
        let mean = |(sum, count): (f64, usize)| sum / count.max(1) as f64;
        if inside.1 >= 10 && mean(inside) < STRAIGHT * mean(at_rows) {
            FrameMeaning::Rows
        } else {
            FrameMeaning::Substeps
        }
    }

    /// Rows at 4 Hz of every body, agents first, all of one length.
    ///
    /// # Errors
    /// [`TrackError::Short`] if there is no whole step.
    pub fn rows(&self, meaning: FrameMeaning) -> Result<Vec<BodyRows>, TrackError> {
        let last = self.moments.last().map_or(0.0, |moment| moment.seconds);
        // Half a frame is tolerated at the end.
        let steps = ((last + 0.5 / self.frame_rate) / STEP_VIDEO_SECONDS) as usize;
        if steps == 0 {
            return Err(TrackError::Short { frames: self.moments.len(), seconds: last });
        }
        Ok((0..self.bodies.len()).map(|body| self.rows_of(body, steps, meaning)).collect())
    }

    fn rows_of(&self, body: usize, steps: usize, meaning: FrameMeaning) -> BodyRows {
        let mut result = BodyRows::default();
        let lever = if body < AGENT_COUNT { self.bodies[body].size.radius() / 6.0 } else { 0.0 };
        // An agent's centre of mass lies behind its origin.
        let mass = |[x, y, angle]: [f64; 3]| {
            let backward = Vec2::from_angle(angle as f32).perp() * -lever;
            [x + f64::from(backward.x), y + f64::from(backward.y)]
        };
        let substep = STEP_VIDEO_SECONDS / SUBSTEPS as f64;
        let seconds_of_row = |t: usize| t as f64 * STEP_VIDEO_SECONDS;
        let velocity = |from: f64, to: f64, seconds: f64| {
            let [a, b] = [mass(self.at(body, from).0), mass(self.at(body, to).0)];
            [0, 1].map(|k| (b[k] - a[k]) / seconds)
        };
        for t in 0..=steps {
            let end = seconds_of_row(t);
            let (pose, deviation, velocity, over) = match meaning {
                FrameMeaning::Substeps if t > 0 => {
                    let moments: [_; SUBSTEPS] =
                        core::array::from_fn(|k| self.at(body, end - (SUBSTEPS - 1 - k) as f64 * substep));
                    let mean = |of: fn(&Reading) -> [f64; 3]| {
                        let sum = |column: usize| moments.iter().map(|it| of(it)[column]).sum::<f64>();
                        [0, 1, 2].map(|column| sum(column) / SUBSTEPS as f64)
                    };
                    let seconds = STEP_SECONDS;
                    (mean(|it| it.0), mean(|it| it.1), velocity(seconds_of_row(t - 1), end, seconds), seconds)
                }
                FrameMeaning::Substeps => {
                    let (pose, deviation) = self.at(body, 0.0);
                    // At a start from rest the velocity grows as much in the first substep as in the second.
                    let first = velocity(0.0, substep, f64::from(SUBSTEP_SECONDS));
                    let second = velocity(substep, 2.0 * substep, f64::from(SUBSTEP_SECONDS));
                    let start = [0, 1].map(|k| 2.0 * first[k] - second[k]);
                    let noise = 3.0 * 3.0 * deviation[0].max(deviation[1]) / f64::from(SUBSTEP_SECONDS);
                    let rests = start[0].hypot(start[1]) < noise.max(0.5);
                    (pose, deviation, if rests { [0.0; 2] } else { start }, f64::from(SUBSTEP_SECONDS))
                }
                FrameMeaning::Rows => {
                    let (pose, deviation) = self.at(body, end);
                    let from = t.saturating_sub(1);
                    let to = (t + 1).min(steps);
                    let seconds = (to - from) as f64 * STEP_SECONDS;
                    (pose, deviation, velocity(seconds_of_row(from), seconds_of_row(to), seconds), seconds)
                }
            };
            let of_velocity = [0, 1].map(|k| core::f64::consts::SQRT_2 * deviation[k] / over);
            let [x, y, angle] = pose;
            result.rows.push([x, y, velocity[0], velocity[1], angle].map(|it| it as f32));
            let deviation = [deviation[0], deviation[1], of_velocity[0], of_velocity[1], deviation[2]];
            result.deviations.push(deviation.map(|it| it as f32));
        }
        result
    }

    /// Pose (u, u, rad) and standard deviations at a time, straight between the frames beside it.
    fn at(&self, body: usize, seconds: f64) -> Reading {
        let after = self.moments.partition_point(|moment| moment.seconds < seconds - 1e-6);
        let after = after.min(self.moments.len() - 1);
        let [b, a] = [&self.moments[after], &self.moments[after.saturating_sub(1)]];
        let span = b.seconds - a.seconds;
        let share = if span > 0.0 { ((seconds - a.seconds) / span).clamp(0.0, 1.0) } else { 1.0 };
        let [from, to] = [a, b].map(|moment| moment.bodies[body]);
        let columns = |measured: crate::Measured| {
            let pose = measured.pose;
            [f64::from(pose.position.x), f64::from(pose.position.y), f64::from(pose.angle)]
        };
        let [p, q] = [columns(from), columns(to)];
        let pose = core::array::from_fn(|k| p[k] + (q[k] - p[k]) * share);
        let deviation = core::array::from_fn(|k| {
            f64::from(from.deviation[k]) * (1.0 - share) + f64::from(to.deviation[k]) * share
        });
        (pose, deviation)
    }
}

//! From poses in frames to rows of an event.

use crate::{Measured, Moment, Track, TrackError};
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
    /// Rows, each shown until the next.
    Held,
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

/// Share of the motion that lies inside steps, below which rows are held.
const STILL: f64 = 0.05;
/// Mean square of motion from step to step (u²) below which nothing tells what frames mean.
const LEAST_MOTION: f64 = 1e-4;
/// Below this frame rate (Hz) there are too few frames for the motion inside of steps.
const LEAST_RATE_OF_MOTION: f64 = 7.9;
/// Greatest misfit of lines from row to row, as a share of that of smooth ones. Sharp or compressed, videos
/// of rows had .04 to .72, those of motion .86 to 1.5.
const STRAIGHT: f64 = 0.85;
/// Difference (u) from a line that is plain in a sharp picture.
const PLAIN: f64 = 0.01;
/// Weight of what is shown at a row's own time beside the frames around it.
const OWN: f64 = 0.05;

impl Track {
    /// The meaning of the frames, as far as the motion tells: whether bodies move at every frame, and whether
    /// lines that are straight from row to row or smooth ones fit their paths better.
    #[must_use]
    pub fn meaning(&self) -> FrameMeaning {
        if self.frame_rate < LEAST_RATE_OF_MOTION {
            return FrameMeaning::Rows;
        }
        if self.holds_rows() {
            return FrameMeaning::Held;
        }
        let misfit = |degree: usize| -> f64 {
            let bodies = 0..self.bodies.len();
            bodies.flat_map(|body| [0, 1].map(|column| self.misfit(body, column, degree))).sum()
        };
        if misfit(1) < STRAIGHT * misfit(2) { FrameMeaning::Rows } else { FrameMeaning::Substeps }
    }

    /// Whether bodies move only from step to step.
    fn holds_rows(&self) -> bool {
        let mut inside = (0.0, 0);
        let mut at_rows = (0.0, 0);
        for body in 0..self.bodies.len() {
            for two in self.moments.windows(2) {
                let [a, b] = [0, 1].map(|k| columns(&two[k].bodies[body]));
                let step = |seconds: f64| (seconds / STEP_VIDEO_SECONDS + 1e-6).floor();
                let same = step(two[0].seconds) == step(two[1].seconds);
                let moved = libm::hypot(b[0] - a[0], b[1] - a[1]).min(1.0);
                let part = if same { &mut inside } else { &mut at_rows };
                part.0 += moved * moved;
                part.1 += 1;
            }
        }
        let mean = |(sum, count): (f64, usize)| sum / count.max(1) as f64;
        at_rows.1 >= 3 && mean(at_rows) > LEAST_MOTION && mean(inside) < STILL * mean(at_rows)
    }

    /// Misfit of lines of a degree that bend at rows to a column of a body's path: 0 if they go through all
    /// frames.
    fn misfit(&self, body: usize, column: usize, degree: usize) -> f64 {
        let steps = self.steps_shown();
        let fitted = self.spline(body, column, degree);
        let off = |moment: &Moment| {
            let (from, weights) = basis(degree, moment.seconds / STEP_VIDEO_SECONDS, steps);
            let line: f64 = weights.iter().zip(&fitted[from..]).map(|(weight, value)| weight * value).sum();
            let off = (columns(&moment.bodies[body])[column] - line) / PLAIN;
            libm::log1p(off * off)
        };
        self.moments.iter().filter(|moment| moment.bodies[body].seen).map(off).sum()
    }

    /// Steps that are shown, at least in part.
    fn steps_shown(&self) -> usize {
        let last = self.moments.last().map_or(0.0, |moment| moment.seconds);
        ((last / STEP_VIDEO_SECONDS - 1e-6).ceil() as usize).max(1)
    }

    /// The coefficients with which lines of a degree that bend at rows fit a column of a body's path best; of
    /// degree 1, the values at rows.
    fn spline(&self, body: usize, column: usize, degree: usize) -> Vec<f64> {
        let steps = self.steps_shown();
        let mut values: Vec<f64> = Vec::new();
        // Frames off the line count less the second time.
        for _ in 0..2 {
            let mut system = Banded::new(steps + degree);
            for moment in &self.moments {
                let it = &moment.bodies[body];
                let value = columns(it)[column];
                let deviation = f64::from(it.deviation[column]).max(1e-4);
                let (from, weights) = basis(degree, moment.seconds / STEP_VIDEO_SECONDS, steps);
                let line = values.get(from..).map_or(value, |values| {
                    weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
                });
                let off = (value - line) / (4.0 * deviation);
                system.add(
                    from,
                    &weights[..=degree],
                    value,
                    1.0 / (deviation * deviation * (1.0 + off * off)),
                );
            }
            // What is shown at a row's time counts a little, so that no row is free; beyond the ends, hardly.
            for k in 0..steps + degree {
                let place = k as f64 - 0.5 * (degree as f64 - 1.0);
                let own = if (0.0..=steps as f64).contains(&place) { OWN } else { 1e-4 * OWN };
                let (reading, deviation) = self.at(body, place * STEP_VIDEO_SECONDS);
                let deviation = deviation[column].max(1e-4);
                system.add(k, &[1.0], reading[column], own / (deviation * deviation));
            }
            values = system.solve();
        }
        values
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
        let shown: Vec<Reading> = match meaning {
            FrameMeaning::Substeps => Vec::new(),
            FrameMeaning::Rows => self.knots(body, steps),
            FrameMeaning::Held => (0..=steps).map(|t| self.held(body, t)).collect(),
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
                FrameMeaning::Rows | FrameMeaning::Held => {
                    let [from, to] = [t.saturating_sub(1), (t + 1).min(steps)];
                    let seconds = (to - from) as f64 * STEP_SECONDS;
                    let [a, b] = [mass(shown[from].0), mass(shown[to].0)];
                    (shown[t].0, shown[t].1, [0, 1].map(|k| (b[k] - a[k]) / seconds), seconds)
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

    /// The rows between which straight lines fit the frames best.
    fn knots(&self, body: usize, steps: usize) -> Vec<Reading> {
        let values = [0, 1, 2].map(|column| self.spline(body, column, 1));
        let reading = |t: usize| {
            let (_, deviation) = self.at(body, t as f64 * STEP_VIDEO_SECONDS);
            ([0, 1, 2].map(|column| values[column][t]), deviation)
        };
        (0..=steps).map(reading).collect()
    }

    /// The mean of the frames that show row `t`, without those in which the body was hidden if there are
    /// others.
    fn held(&self, body: usize, t: usize) -> Reading {
        let mut sum = ([0.0; 3], [0.0; 3]);
        let mut total = 0.0;
        for moment in &self.moments {
            let it = &moment.bodies[body];
            if (moment.seconds / STEP_VIDEO_SECONDS + 1e-6) as usize == t {
                let weight = if it.seen { 1.0 } else { 1e-6 };
                for (k, column) in columns(it).into_iter().enumerate() {
                    sum.0[k] += weight * column;
                    sum.1[k] += weight * f64::from(it.deviation[k]);
                }
                total += weight;
            }
        }
        if total == 0.0 {
            return self.at(body, t as f64 * STEP_VIDEO_SECONDS);
        }
        (sum.0.map(|it| it / total), sum.1.map(|it| it / total))
    }

    /// Pose (u, u, rad) and standard deviations at a time, straight between the frames beside it.
    fn at(&self, body: usize, seconds: f64) -> Reading {
        let after = self.moments.partition_point(|moment| moment.seconds < seconds - 1e-6);
        let after = after.min(self.moments.len() - 1);
        let [b, a] = [&self.moments[after], &self.moments[after.saturating_sub(1)]];
        let span = b.seconds - a.seconds;
        let share = if span > 0.0 { ((seconds - a.seconds) / span).clamp(0.0, 1.0) } else { 1.0 };
        let [from, to] = [a, b].map(|moment| moment.bodies[body]);
        let [p, q] = [columns(&from), columns(&to)];
        let pose = core::array::from_fn(|k| p[k] + (q[k] - p[k]) * share);
        let deviation = core::array::from_fn(|k| {
            f64::from(from.deviation[k]) * (1.0 - share) + f64::from(to.deviation[k]) * share
        });
        (pose, deviation)
    }
}

fn columns(measured: &Measured) -> [f64; 3] {
    let pose = measured.pose;
    [pose.position.x, pose.position.y, pose.angle].map(f64::from)
}

/// The first coefficient and the weights with which a line of degree 1 or 2 that bends at rows passes a place
/// (steps).
fn basis(degree: usize, place: f64, steps: usize) -> (usize, [f64; 3]) {
    let from = (place.max(0.0) as usize).min(steps.saturating_sub(1));
    let share = (place - from as f64).clamp(0.0, 1.0);
    let rest = 1.0 - share;
    let weights = match degree {
        1 => [rest, share, 0.0],
        _ => [0.5 * rest * rest, 0.5 + share * rest, 0.5 * share * share],
    };
    (from, weights)
}

/// Normal equations in which each of the unknowns meets the next two at most.
struct Banded {
    rows: Vec<[f64; 3]>,
    right: Vec<f64>,
}

impl Banded {
    fn new(size: usize) -> Self {
        Self { rows: vec![[0.0; 3]; size], right: vec![0.0; size] }
    }

    /// A weighted sum of unknowns from `from` on that should have a value.
    fn add(&mut self, from: usize, factors: &[f64], value: f64, weight: f64) {
        for (k, a) in factors.iter().enumerate() {
            self.right[from + k] += weight * a * value;
            for (row, b) in self.rows[from + k].iter_mut().zip(&factors[k..]) {
                *row += weight * a * b;
            }
        }
    }

    /// The unknowns, by elimination without exchange of rows, which such a positive matrix does not need.
    fn solve(mut self) -> Vec<f64> {
        let size = self.rows.len();
        for k in 0..size {
            let [pivot, next, after] = self.rows[k];
            for (down, factor) in [(1, next / pivot), (2, after / pivot)] {
                if k + down < size {
                    self.right[k + down] -= factor * self.right[k];
                    self.rows[k + down][0] -= factor * self.rows[k][down];
                }
            }
            if k + 1 < size {
                self.rows[k + 1][1] -= next / pivot * after;
            }
        }
        let mut values = vec![0.0; size + 2];
        for k in (0..size).rev() {
            let [pivot, next, after] = self.rows[k];
            values[k] = (self.right[k] - next * values[k + 1] - after * values[k + 2]) / pivot;
        }
        values.truncate(size);
        values
    }
}

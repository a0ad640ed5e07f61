//! The pose of one body in one picture, by comparing the picture with what the body would look like.

use crate::{
    picture::{Picture, Rgb, square},
    shape::{Appearance, Form, Pose},
    view::View,
};
use phase_model::Vec2;

/// Scale of differences of colour beyond which a pixel says little: it shows something else.
const OUTLIER: f32 = 60.0;
/// Difference of colour up to which a pixel shows a body of that colour.
const OTHER: f32 = 45.0;
/// Error that is the same in all pictures, such as that of the arena's edges (pixels).
const SYSTEMATIC: f32 = 0.12;
/// Steps of the search stop below this change (pixels).
const CONVERGED: f32 = 0.01;
/// Greatest number of steps with edges of one width.
const MOST_STEPS: usize = 4;
/// Width of edges in a sharp picture (pixels).
pub(crate) const SHARP: f32 = 1.2;

/// A pose with what is known of its error.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Fit {
    pub(crate) pose: Pose,
    /// Standard deviations of x, y (u) and angle (rad).
    pub(crate) deviation: [f32; 3],
    /// Root mean square difference of colour inside the body's outline, each pixel's at most [`OUTLIER`].
    pub(crate) difference: f32,
    /// Difference that the pose leaves unexplained inside of the outline and around it, a pixel of the body
    /// in sight.
    pub(crate) unexplained: f32,
    /// Share of the body that no other body covers.
    pub(crate) visible: f32,
}

/// The picture and the other bodies with which a body is compared.
pub(crate) struct Surroundings<'a> {
    pub(crate) picture: &'a Picture<'a>,
    /// The picture without bodies.
    pub(crate) ground: &'a [u8],
    pub(crate) view: View,
    /// Width of edges (pixels), at least [`SHARP`].
    pub(crate) soft: f32,
    /// Distance of the pixels that a fit looks at (pixels): with more than 1 it is faster, and less exact.
    pub(crate) stride: usize,
    /// Bodies that are drawn over it.
    pub(crate) above: &'a [(Appearance, Pose)],
    /// Bodies that are drawn under it.
    pub(crate) below: &'a [(Appearance, Pose)],
    /// Colours of bodies whose places are not known yet: pixels that show them may hide this one.
    pub(crate) others: &'a [Rgb],
}

/// A pixel that can show the body.
struct Sample {
    point: Vec2,
    seen: Rgb,
    under: Rgb,
}

impl Surroundings<'_> {
    fn ground(&self, x: usize, y: usize) -> Rgb {
        let k = 3 * (y * self.picture.size().0 + x);
        [0, 1, 2].map(|channel| f32::from(self.ground[k + channel]))
    }

    /// All pixels within `reach` (u) of a place that no other body hides, and the share of pixels hidden.
    fn samples(&self, centre: Vec2, reach: f32, stride: usize) -> Vec<Sample> {
        let soft = self.soft / self.view.scale;
        let by = 2.0 * soft;
        let near = |bodies: &[(Appearance, Pose)]| -> Vec<(Appearance, Frame)> {
            let far = |body: &Appearance| reach + body.reach() + by;
            let is_near = |(body, pose): &&(Appearance, Pose)| pose.position.distance(centre) < far(body);
            bodies.iter().filter(is_near).map(|(body, pose)| (*body, Frame::new(pose))).collect()
        };
        let (above, below) = (near(self.above), near(self.below));
        let mut samples = Vec::new();
        for (x, y) in self.view.pixels_within(self.picture.size(), centre, reach, stride) {
            let point = self.view.point(x, y);
            let covered =
                |(body, frame): &(Appearance, Frame)| body.cover(frame.local(point), 3.0 * soft) > 0.02;
            if above.iter().any(covered) {
                continue;
            }
            let seen = self.picture.at(x, y);
            if self.others.iter().any(|other| square(*other, seen) < OTHER * OTHER) {
                continue;
            }
            let mut under = self.ground(x, y);
            for (body, frame) in &below {
                under = body.over(under, frame.local(point), soft);
            }
            samples.push(Sample { point, seen, under });
        }
        samples
    }

    /// The best pose near `start`; its edges are first taken as `blur` wide (pixels), which widens the range.
    pub(crate) fn fit(&self, body: &Appearance, start: Pose, blur: f32) -> Fit {
        let pixel = 1.0 / self.view.scale;
        let samples = self.samples(start.position, body.reach() + (blur + 1.0) * pixel, self.stride);
        let mut fit = Fit { pose: start, ..Fit::default() };
        let mut soft = blur.max(self.soft);
        let mut steps = 0;
        loop {
            let step = self.step(body, &samples, &mut fit, soft * pixel);
            steps += 1;
            let last = soft <= self.soft;
            let small = step / pixel < if last { CONVERGED } else { 0.25 };
            if small || steps == MOST_STEPS {
                if last {
                    break;
                }
                soft = (0.4 * soft).max(self.soft);
                steps = 0;
            }
        }
        self.judge(body, &samples, &mut fit);
        fit
    }

    /// Share of a body in a pose that no other body hides.
    pub(crate) fn visible(&self, body: &Appearance, pose: &Pose) -> f32 {
        let mut fit = Fit { pose: *pose, ..Fit::default() };
        self.judge(body, &self.samples(pose.position, body.reach(), self.stride), &mut fit);
        fit.visible
    }

    /// Root mean square difference of colour over all that is near a body in a pose: what tells forms and
    /// sizes apart.
    pub(crate) fn mismatch(&self, body: &Appearance, pose: &Pose, centre: Vec2) -> f32 {
        let soft = self.soft / self.view.scale;
        let frame = Frame::new(pose);
        let mut sum = 0.0;
        let mut count = 0.0_f32;
        for sample in self.samples(centre, 3.2, 2) {
            let look = body.over(sample.under, frame.local(sample.point), soft);
            sum += square(sample.seen, look).min(OUTLIER * OUTLIER);
            count += 1.0;
        }
        (sum / count.max(1.0)).sqrt()
    }

    /// One Gauss-Newton step; returns its length (u), turns measured at the rim.
    fn step(&self, body: &Appearance, samples: &[Sample], fit: &mut Fit, soft: f32) -> f32 {
        let size = if body.form == Form::Disc { 2 } else { 3 };
        let delta = 0.25 * soft;
        let turn = delta / body.radius;
        let pose = fit.pose;
        let frames = [
            pose,
            Pose { position: pose.position + Vec2::new(delta, 0.0), ..pose },
            Pose { position: pose.position + Vec2::new(0.0, delta), ..pose },
            Pose { angle: pose.angle + turn, ..pose },
        ]
        .map(|pose| Frame::new(&pose));
        let units = [delta, delta, turn];
        let mut matrix = [[0.0_f64; 3]; 3];
        let mut vector = [0.0_f64; 3];
        let mut squares = 0.0_f64;
        let mut weights = 0.0_f64;
        let per_distance = 1.01 * delta / body.radius;
        for sample in samples {
            // Most pixels show nothing of an edge, and have no say.
            let local = frames[0].local(sample.point);
            if body.is_plain(local, soft, per_distance * local.length().max(body.radius)) {
                continue;
            }
            let look = |k: usize| body.over(sample.under, frames[k].local(sample.point), soft);
            let now = body.over(sample.under, local, soft);
            let moved: [Rgb; 3] = core::array::from_fn(|k| if k < size { look(k + 1) } else { now });
            if moved.iter().all(|moved| *moved == now) {
                continue;
            }
            let off = square(sample.seen, now);
            let weight = f64::from(1.0 / (1.0 + off / (OUTLIER * OUTLIER)));
            squares += weight * f64::from(off);
            weights += weight * 3.0;
            for channel in 0..3 {
                let slope = moved.map(|moved| f64::from(moved[channel] - now[channel]));
                let off = f64::from(sample.seen[channel] - now[channel]);
                for row in 0..3 {
                    vector[row] += weight * slope[row] * off;
                    for column in 0..=row {
                        matrix[row][column] += weight * slope[row] * slope[column];
                    }
                }
            }
        }
        for row in 0..3 {
            vector[row] /= f64::from(units[row]);
            for column in 0..=row {
                matrix[row][column] /= f64::from(units[row] * units[column]);
                matrix[column][row] = matrix[row][column];
            }
        }
        for (k, row) in matrix.iter_mut().enumerate() {
            row[k] += if k < size { 1e-3 * row[k] + 1e-6 } else { 1.0 };
        }
        let inverse = inverse(&matrix);
        let variance = if weights > 0.0 { squares / weights } else { 1e6 };
        fit.deviation = core::array::from_fn(|k| (variance * inverse[k][k]).max(0.0).sqrt() as f32);
        let systematic = SYSTEMATIC / self.view.scale;
        for (deviation, of) in
            fit.deviation.iter_mut().zip([systematic, systematic, systematic / body.radius])
        {
            *deviation = libm::hypotf(*deviation, of);
        }
        if size == 2 {
            fit.deviation[2] = 0.0;
        }
        let change: [f32; 3] =
            core::array::from_fn(|row| (0..3).map(|k| inverse[row][k] * vector[k]).sum::<f64>() as f32);
        // No step is longer than an edge is wide: the slopes hold no farther.
        let shift = Vec2::new(change[0], change[1]).clamp_length_max(1.5 * soft);
        let turned = if size == 3 { change[2].clamp(-0.3, 0.3) } else { 0.0 };
        fit.pose.position += shift;
        fit.pose.angle += turned;
        shift.length().max(turned.abs() * body.radius)
    }

    /// Measures to what extent the pose explains the picture.
    fn judge(&self, body: &Appearance, samples: &[Sample], fit: &mut Fit) {
        let soft = self.soft / self.view.scale;
        let frame = Frame::new(&fit.pose);
        let mut sum = 0.0;
        let mut around = 0.0;
        let mut count = 0.0;
        for sample in samples {
            let local = frame.local(sample.point);
            let off = square(sample.seen, body.over(sample.under, local, soft)).min(OUTLIER * OUTLIER);
            if body.cover(local, soft) > 0.5 {
                sum += off;
                count += 1.0;
            } else {
                around += off;
            }
        }
        let side = self.view.scale * body.radius / self.stride as f32;
        let area = side * side;
        let whole = area * if body.form == Form::Disc { core::f32::consts::PI } else { 4.0 };
        fit.visible = (count / whole).min(1.0);
        fit.difference = if count > 0.0 { (sum / count).sqrt() } else { OUTLIER };
        fit.unexplained = if count > 0.0 { ((sum + around) / count).sqrt() } else { OUTLIER };
    }
}

/// The frame of a body.
#[derive(Clone, Copy)]
struct Frame {
    origin: Vec2,
    back: Vec2,
}

impl Frame {
    fn new(pose: &Pose) -> Self {
        Self { origin: pose.position, back: Vec2::from_angle(-pose.angle) }
    }

    /// A point in it.
    fn local(&self, point: Vec2) -> Vec2 {
        self.back.rotate(point - self.origin)
    }
}

/// The inverse of a symmetric matrix; of zeros where it has none.
fn inverse(m: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let cofactor = |row: usize, column: usize| {
        let [r, s] = [1, 2].map(|k| (row + k) % 3);
        let [c, d] = [1, 2].map(|k| (column + k) % 3);
        m[r][c] * m[s][d] - m[r][d] * m[s][c]
    };
    let determinant: f64 = (0..3).map(|k| m[0][k] * cofactor(0, k)).sum();
    if determinant.abs() < 1e-30 {
        return [[0.0; 3]; 3];
    }
    core::array::from_fn(|row| core::array::from_fn(|column| cofactor(column, row) / determinant))
}

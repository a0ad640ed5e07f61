//! Bodies followed from frame to frame.

use crate::{
    TrackError,
    arena::{Stage, View},
    detect::{self, Found},
    fit::{Fit, SHARP, Surroundings},
    picture::{Picture, distance},
    shape::{Appearance, Form, Pose},
};
use core::f32::consts::TAU;
use phase_model::{Layout, Size, Vec2};

/// A pose with the standard deviations of its error.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Measured {
    /// The pose.
    pub pose: Pose,
    /// Standard deviations of x and y (u), and of the angle (rad).
    pub deviation: [f32; 3],
    /// Whether the body was seen; if not, the pose is where its motion leads it.
    pub seen: bool,
}

/// The bodies at one time, agents first.
#[derive(Clone, PartialEq, Debug)]
pub struct Moment {
    /// Time since the first frame (s of video).
    pub seconds: f64,
    /// Bodies in the order of [`Tracker::bodies`].
    pub bodies: Vec<Measured>,
}

/// A body that is followed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct TrackedBody {
    /// Its form.
    pub form: Form,
    /// Its size.
    pub size: Size,
    /// Its colour.
    pub colour: [u8; 3],
}

/// Frames in which the arena may be absent before the video is refused: a title, or a fade.
const LONGEST_LEAD: usize = 300;
/// Most that is kept of them (bytes).
const MOST_WAITING: usize = 1 << 26;
/// Longest time that a body may be hidden (s).
const LONGEST_HIDDEN: f64 = 3.0;
/// Difference of colour above which a pose does not explain the picture.
const POOR: f32 = 38.0;
/// Share of a body that must be in sight for its pose to be measured.
const LEAST_VISIBLE: f32 = 0.15;
/// Greatest length of a video (s).
const LONGEST: u32 = 3600;

#[derive(Clone, Copy, Debug)]
struct Followed {
    body: Appearance,
    size: Size,
    fit: Fit,
    /// Change of the pose a second of video.
    velocity: Vec2,
    spin: f32,
    /// When it was last seen (s).
    seen: f64,
    /// Difference of colour when it was first seen.
    usual: f32,
}

/// Follows the bodies of a video frame by frame. It keeps one picture and the poses.
#[derive(Debug)]
pub struct Tracker {
    frames: usize,
    /// When the arena was first seen.
    first_seconds: Option<f64>,
    /// The frames since then in which the bodies could not be told apart yet, with their times. They are
    /// followed backwards once the bodies are known.
    waiting: Vec<(f64, Vec<u8>)>,
    known: Option<Known>,
    /// Why the frames so far were not understood.
    refusal: Option<TrackError>,
    moments: Vec<Moment>,
    least_interval: f64,
    greatest_interval: f64,
    last_seconds: f64,
}

#[derive(Debug)]
struct Known {
    stage: Stage,
    size: (usize, usize),
    ground: Vec<u8>,
    /// Pixels of the ground that no picture has shown yet.
    guessed: Vec<bool>,
    guesses: usize,
    followed: Vec<Followed>,
}

impl Default for Tracker {
    fn default() -> Self {
        Self::new()
    }
}

impl Tracker {
    /// A tracker that has seen nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            frames: 0,
            first_seconds: None,
            waiting: Vec::new(),
            known: None,
            refusal: None,
            moments: Vec::new(),
            least_interval: f64::INFINITY,
            greatest_interval: 0.0,
            last_seconds: 0.0,
        }
    }

    /// Takes the next frame, shown at a time (s).
    ///
    /// # Errors
    /// [`TrackError`] if there is no arena in the first 300 frames, its walls or bodies are not those of an
    /// event, a body is lost for 3 s, the size changes, or the video is longer than an hour.
    pub fn push(&mut self, picture: &Picture<'_>, seconds: f64) -> Result<(), TrackError> {
        let frame = self.frames;
        self.frames += 1;
        if seconds > f64::from(LONGEST) || !seconds.is_finite() {
            return Err(TrackError::Long(LONGEST));
        }
        if frame > 0 {
            let interval = seconds - self.last_seconds;
            self.least_interval = self.least_interval.min(interval);
            self.greatest_interval = self.greatest_interval.max(interval);
        }
        self.last_seconds = seconds;
        let Some(known) = &mut self.known else {
            let now = self.first_seconds.map_or(0.0, |first| seconds - first);
            match Known::begin(picture, frame, now) {
                Ok(known) => {
                    let first = *self.first_seconds.get_or_insert(seconds);
                    self.moments.push(known.moment(seconds - first));
                    let mut known = known;
                    let followed = known.followed.clone();
                    let (width, height) = picture.size();
                    let mut after = now;
                    for (before, bytes) in self.waiting.drain(..).rev() {
                        // Where a body is hidden, nothing is known but its motion afterwards.
                        if let Ok(picture) = Picture::new(width, height, &bytes) {
                            known.follow(&picture, after, before - first)?;
                        }
                        after = before - first;
                        self.moments.push(known.moment(after));
                    }
                    self.moments.reverse();
                    known.followed = followed;
                    self.known = Some(known);
                }
                Err(error) if frame + 1 < LONGEST_LEAD => {
                    // The arena is there, but bodies hide each other: time begins.
                    if !matches!(error, TrackError::NoArena { .. }) {
                        self.first_seconds.get_or_insert(seconds);
                        let kept = self.waiting.len() * picture.bytes().len() < MOST_WAITING;
                        let bytes = if kept { picture.bytes().to_vec() } else { Vec::new() };
                        self.waiting.push((seconds, bytes));
                    }
                    self.refusal = Some(error);
                }
                Err(error) => return Err(error),
            }
            return Ok(());
        };
        if picture.size() != known.size {
            return Err(TrackError::Resized { frame });
        }
        let now = seconds - self.first_seconds.unwrap_or(seconds);
        let before = self.moments.last().map_or(0.0, |moment| moment.seconds);
        known.follow(picture, before, now)?;
        self.moments.push(known.moment(now));
        Ok(())
    }

    /// The motion seen.
    ///
    /// # Errors
    /// [`TrackError`] if no frame was understood, the times of frames are uneven, there are fewer than 8 or
    /// more than 240 frames a second, or they last less than 0.25 s.
    pub fn finish(self) -> Result<Track, TrackError> {
        let seconds = self.last_seconds - self.first_seconds.unwrap_or(self.last_seconds);
        let short = TrackError::Short { frames: self.frames, seconds };
        let Some(known) = self.known else { return Err(self.refusal.unwrap_or(short)) };
        if self.moments.len() < 3 || seconds < 0.25 {
            return Err(short);
        }
        let (least, greatest) = (self.least_interval, self.greatest_interval);
        // Times of some containers are whole milliseconds.
        if greatest > 1.5 * least + 0.002 {
            return Err(TrackError::Uneven { least, greatest });
        }
        let frame_rate = (self.moments.len() - 1) as f64 / seconds;
        if !(7.9..=240.5).contains(&frame_rate) {
            return Err(TrackError::Rate(frame_rate));
        }
        let body = |followed: &Followed| TrackedBody {
            form: followed.body.form,
            size: followed.size,
            colour: followed.body.colour.map(|channel| channel.round().clamp(0.0, 255.0) as u8),
        };
        Ok(Track {
            view: known.stage.view,
            layout: known.stage.layout,
            bodies: known.followed.iter().map(body).collect(),
            frame_rate,
            moments: self.moments,
        })
    }
}

/// Everything that was read from a video.
#[derive(Clone, PartialEq, Debug)]
pub struct Track {
    /// Where the arena is in the picture.
    pub view: View,
    /// Walls and landmarks.
    pub layout: Layout,
    /// The bodies, agents first: at least two, at most four.
    pub bodies: Vec<TrackedBody>,
    /// Frames a second.
    pub frame_rate: f64,
    /// The poses in every frame, at least three.
    pub moments: Vec<Moment>,
}

impl Known {
    fn begin(picture: &Picture<'_>, frame: usize, now: f64) -> Result<Self, TrackError> {
        let stage = Stage::find(picture, frame)?;
        let walls = stage.layout.walls();
        let (width, height) = picture.size();
        let mut ground = picture.bytes().to_vec();
        let in_arena = |x: usize, y: usize| {
            let pixel = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) - stage.view.corner;
            let side = stage.view.scale * phase_model::arena::SIDE;
            pixel.min_element() > 0.0 && pixel.max_element() < side
        };
        for y in 0..height {
            for x in 0..width {
                if in_arena(x, y) {
                    let colour = stage.colour(stage.view.point(x, y), &walls);
                    let k = 3 * (y * width + x);
                    ground[k..k + 3].copy_from_slice(&colour.map(|channel| channel.round() as u8));
                }
            }
        }
        let found = detect::bodies(picture, &stage, &ground)?;
        let followed = found.iter().map(|&Found { body, size, fit }| Followed {
            body,
            size,
            fit,
            velocity: Vec2::ZERO,
            spin: 0.0,
            seen: now,
            usual: fit.difference,
        });
        let mut known = Self {
            size: (width, height),
            guessed: vec![true; width * height],
            guesses: width * height,
            followed: followed.collect(),
            ground,
            stage,
        };
        // Once more, now that it is known what is beside each body.
        known.fit_all(picture, now, now)?;
        known.learn_ground(picture);
        Ok(known)
    }

    fn moment(&self, seconds: f64) -> Moment {
        let measured = |followed: &Followed| Measured {
            pose: followed.fit.pose,
            deviation: followed.fit.deviation,
            seen: followed.seen == seconds,
        };
        Moment { seconds, bodies: self.followed.iter().map(measured).collect() }
    }

    fn follow(&mut self, picture: &Picture<'_>, before: f64, now: f64) -> Result<(), TrackError> {
        self.fit_all(picture, before, now)?;
        if self.guesses > 0 {
            self.learn_ground(picture);
        }
        Ok(())
    }

    /// Fits all bodies, those on top first.
    fn fit_all(&mut self, picture: &Picture<'_>, before: f64, now: f64) -> Result<(), TrackError> {
        let interval = (now - before) as f32;
        for k in (0..self.followed.len()).rev() {
            let it = self.followed[k];
            let others: Vec<_> = (0..self.followed.len())
                .filter(|&other| other != k)
                .map(|other| {
                    let other = &self.followed[other];
                    (other.body, other.fit.pose)
                })
                .collect();
            let is_disc = |body: &(Appearance, Pose)| body.0.form == Form::Disc;
            let (above, below): (Vec<_>, Vec<_>) =
                others.into_iter().partition(|other| it.body.form == Form::Trapezoid && is_disc(other));
            let surroundings = Surroundings {
                picture,
                ground: &self.ground,
                view: self.stage.view,
                above: &above,
                below: &below,
                others: &[],
            };
            let predicted = Pose {
                position: it.fit.pose.position + it.velocity * interval,
                angle: it.fit.pose.angle + it.spin * interval,
            };
            let moved = (it.velocity.length() + it.spin.abs() * it.body.radius)
                * interval.abs()
                * self.stage.view.scale;
            let blur = if interval == 0.0 || moved < 0.5 { 2.0 * SHARP } else { 4.0 * SHARP };
            let mut fit = surroundings.fit(&it.body, predicted, blur);
            // Edges of small or compressed bodies never fit well.
            let usual = it.usual.min(POOR);
            let is_poor = |fit: &Fit| fit.difference > usual + 12.0 || fit.visible < 2.0 * LEAST_VISIBLE;
            if is_poor(&fit) && interval != 0.0 {
                for start in self.elsewhere(&surroundings, &it, predicted) {
                    let other = surroundings.fit(&it.body, start, 4.0 * SHARP);
                    if other.difference / other.visible.max(0.1) < fit.difference / fit.visible.max(0.1) {
                        fit = other;
                    }
                }
            }
            if fit.visible < LEAST_VISIBLE || fit.difference > (1.2 * POOR).max(usual + 14.0) {
                let hidden = now - it.seen;
                if hidden > LONGEST_HIDDEN {
                    let [red, green, blue] = it.body.colour.map(|channel| channel as u8);
                    let colour = format!("#{red:02x}{green:02x}{blue:02x}");
                    return Err(TrackError::Lost { colour, start: it.seen, seconds: hidden });
                }
                let error = 0.1 + it.velocity.length() * hidden.abs() as f32;
                fit = Fit { pose: predicted, deviation: [error, error, error / it.body.radius], ..fit };
                self.followed[k].fit = fit;
                self.followed[k].velocity *= 0.5_f32.powf(interval.abs() / 0.25);
                continue;
            }
            // The nearest of the angles that look the same.
            let turned = libm::remainderf(fit.pose.angle - it.fit.pose.angle, TAU);
            fit.pose.angle = it.fit.pose.angle + turned;
            let followed = &mut self.followed[k];
            if interval != 0.0 {
                followed.velocity = (fit.pose.position - it.fit.pose.position) / interval;
                followed.spin = turned / interval;
            }
            followed.seen = now;
            followed.fit = fit;
        }
        Ok(())
    }

    /// Poses from which to look for a body that is not where it was expected: where its colour is.
    fn elsewhere(&self, surroundings: &Surroundings<'_>, it: &Followed, predicted: Pose) -> Vec<Pose> {
        let picture = surroundings.picture;
        let view = self.stage.view;
        let near = 40.0 + 3.0 * self.stage.noise;
        let colour = it.body.colour;
        let mut points: Vec<Vec2> = Vec::new();
        for (x, y) in view.pixels_within(picture.size(), phase_model::arena::CENTRE, 14.0, 2) {
            let k = 3 * (y * picture.size().0 + x);
            let ground = [0, 1, 2].map(|channel| f32::from(self.ground[k + channel]));
            let seen = picture.at(x, y);
            if distance(seen, colour) < near && distance(seen, ground) > 0.5 * near {
                points.push(view.point(x, y));
            }
        }
        if points.is_empty() {
            return vec![it.fit.pose];
        }
        let middle = |of: fn(&Vec2) -> f32| {
            let mut values: Vec<f32> = points.iter().map(of).collect();
            values.sort_by(f32::total_cmp);
            values[values.len() / 2]
        };
        let centre = Vec2::new(middle(|point| point.x), middle(|point| point.y));
        let near: Vec<&Vec2> =
            points.iter().filter(|point| point.distance(centre) < it.body.reach()).collect();
        let centre = near.iter().fold(Vec2::ZERO, |sum, point| sum + **point) / near.len().max(1) as f32;
        if it.body.form == Form::Disc {
            return vec![Pose { position: centre, angle: 0.0 }, it.fit.pose];
        }
        let directions = 8;
        let around = (0..directions).map(|k| {
            let angle = predicted.angle + TAU * k as f32 / directions as f32;
            Pose { position: centre + Vec2::from_angle(angle).perp() * (0.25 * it.body.radius), angle }
        });
        around.chain([it.fit.pose]).collect()
    }

    /// Takes over what the picture shows of the ground that was only guessed.
    fn learn_ground(&mut self, picture: &Picture<'_>) {
        let (width, height) = self.size;
        let margin = 4.0 / self.stage.view.scale;
        let mut covered = vec![false; width * height];
        for followed in &self.followed {
            let pose = followed.fit.pose;
            for (x, y) in
                self.stage.view.pixels_within(self.size, pose.position, followed.body.reach() + margin, 1)
            {
                covered[y * width + x] = true;
            }
        }
        let shown = picture.bytes().chunks_exact(3);
        let pixels = self.ground.chunks_exact_mut(3).zip(shown);
        for ((guessed, covered), (ground, shown)) in self.guessed.iter_mut().zip(covered).zip(pixels) {
            if *guessed && !covered {
                ground.copy_from_slice(shown);
                *guessed = false;
                self.guesses -= 1;
            }
        }
    }
}

//! The bodies of a video from the picture in which they were told apart on.

use super::{Measured, Moment};
use crate::{
    TrackError,
    arena::Stage,
    detect::{self, Found},
    fit::{Fit, SHARP, Surroundings},
    picture::{Picture, Rgb, distance},
    shape::{Appearance, Form, Pose},
};
use core::f32::consts::TAU;
use phase_model::{Size, Vec2};

/// Time (s) after which what looks like a body of which others cover a part is taken for a small one.
const LONGEST_COVERED: f64 = 2.0;
/// Longest time that a body may be hidden (s).
const LONGEST_HIDDEN: f64 = 3.0;
/// Farthest way of a body from one frame to the next (u): that of a step, where rows are held.
const FARTHEST: f32 = 4.0;
/// Greatest speed of a body that is hidden (u/s).
const FASTEST: f32 = 16.0;
/// Difference of colour above which a pose does not explain the picture.
const POOR: f32 = 38.0;
/// Share of a body that must be in sight for its pose to be measured.
const LEAST_VISIBLE: f32 = 0.15;
/// Share of a hidden body that may be in sight in the pose in which it is thought to be.
const MOST_OPEN: f32 = 0.4;
/// Turn from frame to frame (rad) after which other directions are tried.
const SUDDEN_TURN: f32 = 0.35;
/// Turn away from the prediction (rad) after which a fit goes on.
const FAR_TURN: f32 = 0.15;
/// Turns (rad) that put one side of an agent where another was, so that it looks much the same.
const LOOKALIKES: [f32; 3] = [2.034_44, core::f32::consts::PI, -2.034_44];
/// Frames after which they are tried in any case.
const CHECK_EVERY: usize = 10;
/// Share of what is unexplained that another pose must go below to be taken instead.
const BETTER: f32 = 0.95;

#[derive(Clone, Copy, Debug)]
pub(super) struct Followed {
    pub(super) body: Appearance,
    pub(super) size: Size,
    fit: Fit,
    /// Change of the pose a second of video.
    velocity: Vec2,
    spin: f32,
    /// Time at which it was last seen (s).
    seen: f64,
    /// Difference of colour when it was first seen.
    usual: f32,
}

/// The arena and its bodies.
#[derive(Debug)]
pub(super) struct Known {
    pub(super) stage: Stage,
    pub(super) size: (usize, usize),
    /// Width of edges (pixels).
    soft: f32,
    ground: Vec<u8>,
    /// Pixels of the ground that no picture has shown yet.
    guessed: Vec<usize>,
    pub(super) followed: Vec<Followed>,
    followed_frames: usize,
}

impl Known {
    /// The bodies in a picture, `negative` if that is one of light lines on a dark ground.
    pub(super) fn begin(
        picture: &Picture<'_>,
        frame: usize,
        now: f64,
        negative: bool,
    ) -> Result<Self, TrackError> {
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
        let (soft, found) = detect::bodies(picture, &stage, &ground, negative, now >= LONGEST_COVERED)?;
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
            soft,
            guessed: (0..width * height).collect(),
            followed: followed.collect(),
            followed_frames: 0,
            ground,
            stage,
        };
        // Once more, now that it is known what is beside each body.
        known.fit_all(picture, now, now)?;
        known.learn_ground(picture);
        Ok(known)
    }

    pub(super) fn moment(&self, seconds: f64) -> Moment {
        let measured = |followed: &Followed| Measured {
            pose: followed.fit.pose,
            deviation: followed.fit.deviation,
            seen: followed.seen == seconds,
        };
        Moment { seconds, bodies: self.followed.iter().map(measured).collect() }
    }

    pub(super) fn follow(&mut self, picture: &Picture<'_>, before: f64, now: f64) -> Result<(), TrackError> {
        self.followed_frames += 1;
        self.fit_all(picture, before, now)?;
        self.learn_ground(picture);
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
                soft: self.soft,
                stride: 1,
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
            // A long way is not gone in one search.
            if fit.pose.position.distance(predicted.position) > 0.25 * it.body.radius
                || libm::remainderf(fit.pose.angle - predicted.angle, TAU).abs() > FAR_TURN
            {
                fit = surroundings.fit(&it.body, fit.pose, 2.0 * SHARP);
            }
            let is_poor = |fit: &Fit| fit.difference > usual + 12.0 || fit.visible < 2.0 * LEAST_VISIBLE;
            if is_poor(&fit) && interval != 0.0 {
                for start in self.elsewhere(&surroundings, &it, predicted, now) {
                    let other = surroundings.fit(&it.body, start, 4.0 * SHARP);
                    if other.difference / other.visible.max(0.1) < fit.difference / fit.visible.max(0.1) {
                        fit = other;
                    }
                }
            }
            for start in self.other_directions(&it, &fit, predicted) {
                let other = surroundings.fit(&it.body, start, 2.0 * SHARP);
                if other.visible > 0.9 * fit.visible && other.unexplained < BETTER * fit.unexplained {
                    fit = other;
                }
            }
            if fit.visible < LEAST_VISIBLE || fit.difference > (1.2 * POOR).max(usual + 14.0) {
                let hidden = now - it.seen;
                if hidden > LONGEST_HIDDEN {
                    let [red, green, blue] = it.body.colour.map(|channel| channel as u8);
                    let colour = format!("#{red:02x}{green:02x}{blue:02x}");
                    return Err(TrackError::Lost { colour, start: it.seen, seconds: hidden });
                }
                let near = FARTHEST + FASTEST * hidden.abs() as f32;
                let predicted = hiding_place(&surroundings, &it.body, predicted, near);
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

    /// Poses from which to look for an agent that may have been taken for one that faces elsewhere: after a
    /// sudden turn, and now and then.
    fn other_directions(&self, it: &Followed, fit: &Fit, predicted: Pose) -> Vec<Pose> {
        if it.body.form == Form::Disc {
            return Vec::new();
        }
        let mut starts = Vec::new();
        let turned = libm::remainderf(fit.pose.angle - it.fit.pose.angle, TAU);
        if turned.abs() > SUDDEN_TURN {
            starts.push(Pose { angle: it.fit.pose.angle, ..predicted });
        }
        if self.followed_frames.is_multiple_of(CHECK_EVERY) || turned.abs() > SUDDEN_TURN {
            starts.extend(LOOKALIKES.map(|turn| Pose { angle: fit.pose.angle + turn, ..fit.pose }));
        }
        starts
    }

    /// Poses from which to look for a body that is not where it was expected: where its colour is.
    fn elsewhere(
        &self,
        surroundings: &Surroundings<'_>,
        it: &Followed,
        predicted: Pose,
        now: f64,
    ) -> Vec<Pose> {
        let picture = surroundings.picture;
        let view = self.stage.view;
        let near = 40.0 + 3.0 * self.stage.noise;
        let colour = it.body.colour;
        let mut points: Vec<Vec2> = Vec::new();
        let reach = it.body.reach() + FARTHEST + FASTEST * (now - it.seen).abs() as f32;
        for (x, y) in view.pixels_within(picture.size(), it.fit.pose.position, reach, 2) {
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
        let margin = 4.0 / self.stage.view.scale;
        let view = self.stage.view;
        let width = self.size.0;
        let followed = &self.followed;
        let ground = &mut self.ground;
        self.guessed.retain(|&pixel| {
            let point = view.point(pixel % width, pixel / width);
            let covers = |it: &Followed| {
                let reach = it.body.reach() + margin;
                it.fit.pose.position.distance_squared(point) <= reach * reach
            };
            let covered = followed.iter().any(covers);
            if !covered {
                ground[3 * pixel..3 * pixel + 3].copy_from_slice(&picture.bytes()[3 * pixel..3 * pixel + 3]);
            }
            covered
        });
    }
}

/// The pose nearest to a prediction in which other bodies hide the body; the prediction if there is none
/// `near` it (u).
fn hiding_place(surroundings: &Surroundings<'_>, body: &Appearance, predicted: Pose, near: f32) -> Pose {
    let others: Vec<(Appearance, Pose)> =
        surroundings.above.iter().chain(surroundings.below).copied().collect();
    let colours: Vec<Rgb> = others.iter().map(|(other, _)| other.colour).collect();
    let surroundings = Surroundings { others: &colours, ..*surroundings };
    let between = |(_, other): &(Appearance, Pose)| {
        let towards = other.position;
        (0..=8)
            .map(move |k| Pose { position: predicted.position.lerp(towards, 0.125 * k as f32), ..predicted })
    };
    let off = |pose: &Pose| pose.position.distance(predicted.position);
    let hidden = others
        .iter()
        .flat_map(between)
        .filter(|pose| off(pose) <= near && surroundings.visible(body, pose) < MOST_OPEN);
    hidden.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(predicted)
}

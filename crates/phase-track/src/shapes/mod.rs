//! Shapes of any form that move over a plain ground, where no arena with agents is to be seen.
//!
//! A video is watched twice: a [`Survey`] finds what does not move and the colours of the rest, and a
//! [`ShapeTracker`] then follows the shapes by colour, place and size. Shapes may have one colour, as in
//! Heider and Simmel's film; those that touch are then divided in proportion to their sizes.

mod survey;
mod track;

pub use survey::Survey;
pub use track::{Shape, ShapeTrack};

use crate::{
    Picture, TrackError, View,
    arena::Stage,
    picture::{Rgb, distance},
};
use phase_model::{AGENT_COUNT, Vec2, arena::STEP_VIDEO_SECONDS};
use survey::{components, reduced};

/// Difference of colour that is more than noise.
const DIFFERENT: f32 = 45.0;
/// Area of shapes: least and greatest, as shares of the picture.
const AREA: [f32; 2] = [0.0004, 0.15];
/// Greatest distance from the middle of a shape to its edge, in radii of a disc of its area; lines have more.
const LONGEST: f32 = 3.2;
/// Shapes that are followed at most, passing ones among them.
const MOST_FOLLOWED: usize = 64;
/// Shapes that are kept at most.
const MOST_SHAPES: usize = 9;
/// Least share of the video in which a shape is seen.
const LEAST_SEEN: f32 = 0.3;
/// Time after which a hidden shape stays where it is (s).
const HALF_LIFE: f64 = 0.25;
/// Error of a place in sight, as a share of the shape's radius.
const ERROR: f32 = 0.05;

/// A shape that is followed.
#[derive(Clone, Debug)]
struct FollowedShape {
    colour: usize,
    area: f32,
    /// Distance from the middle to the edge (pixels).
    reach: f32,
    place: Vec2,
    /// Pixels a second.
    velocity: Vec2,
    seen: f64,
    /// Frame, place and error (pixels) wherever it was seen.
    path: Vec<(usize, Vec2, f32)>,
}

impl FollowedShape {
    fn radius(&self) -> f32 {
        (self.area / core::f32::consts::PI).sqrt()
    }

    /// Takes over where it was seen.
    fn see(&mut self, frame: usize, now: f64, place: Vec2, area: f32) {
        let hidden = (1.0 - area / self.area).clamp(0.0, 1.0);
        let hidden = if hidden < 0.15 { 0.0 } else { hidden };
        let since = (now - self.seen) as f32;
        let expected = self.place;
        let place = place.lerp(expected, hidden);
        if let Some((_, before, _)) = self.path.last()
            && since > 0.0
        {
            self.velocity = (place - *before) / since;
        }
        self.place = place;
        self.seen = now;
        self.path.push((frame, place, self.radius() * (ERROR + hidden)));
    }
}

/// Follows shapes through a video that is watched for the second time.
#[derive(Debug)]
pub struct ShapeTracker {
    size: (usize, usize),
    small: (usize, usize),
    floor: Rgb,
    ground: Vec<u8>,
    stays: Vec<bool>,
    colours: Vec<Rgb>,
    frames: Vec<f64>,
    followed: Vec<FollowedShape>,
}

impl ShapeTracker {
    /// Whether a pixel shows something that is not part of the ground.
    fn moves(&self, bytes: &[u8], k: usize) -> bool {
        let at = |bytes: &[u8]| [0, 1, 2].map(|channel| f32::from(bytes[3 * k + channel]));
        let colour = at(bytes);
        distance(colour, self.floor) > DIFFERENT
            && !(self.stays[k] && distance(colour, at(&self.ground)) < DIFFERENT)
    }

    /// Takes the next frame, shown at a time (s).
    ///
    /// # Errors
    /// [`TrackError::Resized`], [`TrackError::Long`] for more than an hour, and [`TrackError::Uneven`] if
    /// time does not grow.
    pub fn push(&mut self, picture: &Picture<'_>, seconds: f64) -> Result<(), TrackError> {
        let frame = self.frames.len();
        if picture.size() != self.size {
            return Err(TrackError::Resized { frame });
        }
        if !(0.0..=3600.0).contains(&seconds) {
            return Err(TrackError::Long(3600));
        }
        let before = self.frames.last().copied().unwrap_or(f64::NEG_INFINITY);
        if seconds <= before {
            return Err(TrackError::Uneven { least: seconds - before, greatest: seconds - before });
        }
        self.frames.push(seconds);
        let (width, height, _, bytes) = reduced(picture);
        // The colour of each pixel that moves.
        let mut masks = vec![vec![false; width * height]; self.colours.len()];
        for k in (0..width * height).filter(|&k| self.moves(&bytes, k)) {
            let colour = [0, 1, 2].map(|channel| f32::from(bytes[3 * k + channel]));
            let off = |other: &Rgb| distance(*other, colour);
            let nearest = self.colours.iter().enumerate().min_by(|a, b| off(a.1).total_cmp(&off(b.1)));
            if let Some((nearest, _)) = nearest.filter(|(_, it)| off(it) < 1.5 * DIFFERENT) {
                masks[nearest][k] = true;
            }
        }
        for shape in &mut self.followed {
            let since = (seconds - shape.seen).max(0.0);
            let interval = (seconds - before.max(0.0)) as f32;
            shape.place += shape.velocity * interval * libm::exp2(-since / HALF_LIFE) as f32;
        }
        for (colour, mask) in masks.iter_mut().enumerate() {
            self.follow(colour, mask, (width, height), frame, seconds);
        }
        Ok(())
    }

    /// Follows the shapes of one colour, and takes up new ones.
    fn follow(&mut self, colour: usize, mask: &mut [bool], size: (usize, usize), frame: usize, now: f64) {
        let (width, height) = size;
        let least = AREA[0] * (width * height) as f32;
        let most = AREA[1] * (width * height) as f32;
        let point = |k: usize| Vec2::new((k % width) as f32 + 0.5, (k / width) as f32 + 0.5);
        let mine: Vec<usize> =
            (0..self.followed.len()).filter(|&k| self.followed[k].colour == colour).collect();
        let pixels: Vec<usize> = (0..mask.len()).filter(|&k| mask[k]).collect();
        let mut places: Vec<Vec2> = mine.iter().map(|&k| self.followed[k].place).collect();
        let mut areas = vec![0.0_f32; mine.len()];
        let mut owners = vec![usize::MAX; pixels.len()];
        for pass in 0..5 {
            let mut sums = vec![Vec2::ZERO; mine.len()];
            areas.fill(0.0);
            for (owner, &pixel) in owners.iter_mut().zip(&pixels) {
                let point = point(pixel);
                let off = |k: usize| {
                    let shape = &self.followed[mine[k]];
                    // What moves fast is looked for in a wider circle at first.
                    let wide = if pass == 0 { 0.6 * shape.reach + 2.0 } else { 2.0 };
                    let away = point.distance(places[k]);
                    (away < 1.1 * shape.reach + wide).then_some((k, away / shape.radius()))
                };
                let nearest = (0..mine.len()).filter_map(off).min_by(|a, b| a.1.total_cmp(&b.1));
                *owner = nearest.map_or(usize::MAX, |(k, _)| k);
                if let Some((k, _)) = nearest {
                    sums[k] += point;
                    areas[k] += 1.0;
                }
            }
            for k in 0..mine.len() {
                if areas[k] > 0.0 {
                    places[k] = sums[k] / areas[k];
                }
            }
        }
        for (k, &shape) in mine.iter().enumerate() {
            if areas[k] > 0.25 * self.followed[shape].area {
                self.followed[shape].see(frame, now, places[k], areas[k]);
            } else {
                owners.iter_mut().filter(|owner| **owner == k).for_each(|owner| *owner = usize::MAX);
            }
        }
        for (owner, pixel) in owners.iter().zip(&pixels) {
            mask[*pixel] = *owner == usize::MAX;
        }
        for part in components(mask, width) {
            let area = part.len() as f32;
            if area < least || area > most {
                continue;
            }
            let place = part.iter().map(|&k| point(k)).sum::<Vec2>() / area;
            let reach = part.iter().map(|&k| point(k).distance(place)).fold(0.0, f32::max);
            let radius = (area / core::f32::consts::PI).sqrt();
            if reach > LONGEST * radius {
                continue;
            }
            // A shape that was hidden, or a new one.
            let alike = |k: &usize| {
                let shape = &self.followed[*k];
                shape.seen < now && (0.6..1.6).contains(&(area / shape.area))
            };
            let hidden = mine.iter().copied().filter(alike).min_by(|a, b| {
                let off = |k: usize| self.followed[k].place.distance(place);
                off(*a).total_cmp(&off(*b))
            });
            if let Some(hidden) = hidden {
                self.followed[hidden].place = place;
                self.followed[hidden].see(frame, now, place, area);
            } else if self.followed.len() < MOST_FOLLOWED {
                let mut shape = FollowedShape {
                    colour,
                    area,
                    reach,
                    place,
                    velocity: Vec2::ZERO,
                    seen: now,
                    path: Vec::new(),
                };
                shape.see(frame, now, place, area);
                self.followed.push(shape);
            }
        }
    }

    /// The shapes that moved.
    ///
    /// # Errors
    /// [`TrackError::Short`] below 0.25 s, [`TrackError::Rate`] for fewer than 4 or more than 240 frames a
    /// second, [`TrackError::Shapes`] if fewer than two shapes moved.
    pub fn finish(self) -> Result<ShapeTrack, TrackError> {
        let frames = self.frames.len();
        let (first, last) = (self.frames.first(), self.frames.last());
        let seconds = first.zip(last).map_or(0.0, |(first, last)| last - first);
        if frames < 3 || seconds < STEP_VIDEO_SECONDS {
            return Err(TrackError::Short { frames, seconds });
        }
        let frame_rate = (frames - 1) as f64 / seconds;
        if !(3.95..=240.5).contains(&frame_rate) {
            return Err(TrackError::Rate(frame_rate));
        }
        let extent = |shape: &FollowedShape| {
            let fold = |of: fn(Vec2, Vec2) -> Vec2| shape.path.iter().map(|it| it.1).reduce(of);
            fold(Vec2::max).zip(fold(Vec2::min)).map_or(0.0, |(high, low)| (high - low).max_element())
        };
        let lasts = |shape: &FollowedShape| {
            shape.path.len() as f32 > LEAST_SEEN * frames as f32
                && extent(shape) > (0.3 * shape.radius()).max(3.0)
        };
        let mut shapes: Vec<FollowedShape> = self.followed.into_iter().filter(lasts).collect();
        shapes.sort_by(|a, b| b.area.total_cmp(&a.area));
        // Eyes and other marks go wherever the shape goes that has them.
        let mut kept: Vec<FollowedShape> = Vec::new();
        for shape in shapes {
            let is_mark = kept.iter().any(|other| shape.area < 0.5 * other.area && inside(&shape, other));
            if !is_mark && kept.len() < MOST_SHAPES {
                kept.push(shape);
            }
        }
        if kept.len() < AGENT_COUNT {
            let rule = format!("{} shapes of a plain colour move in it, not two or more", kept.len());
            return Err(TrackError::Shapes(rule));
        }
        let factor = self.size.0 as f32 / self.small.0 as f32;
        let shape = |shape: &FollowedShape| {
            let at = |seconds: f64| {
                let path = &shape.path;
                let after = path.partition_point(|it| self.frames[it.0] < seconds).min(path.len() - 1);
                let [a, b] = [path[after.saturating_sub(1)], path[after]];
                let span = self.frames[b.0] - self.frames[a.0];
                let share =
                    if span > 0.0 { ((seconds - self.frames[a.0]) / span).clamp(0.0, 1.0) } else { 1.0 };
                a.1.lerp(b.1, share as f32) * factor
            };
            let colour = self.colours[shape.colour].map(|channel| channel.round().clamp(0.0, 255.0) as u8);
            let error = shape.path.iter().map(|it| it.2 * it.2).sum::<f32>() / shape.path.len() as f32;
            Shape {
                colour,
                radius: shape.radius() * factor,
                path: self.frames.iter().map(|&seconds| at(seconds)).collect(),
                seen: shape.path.len() as f64 / frames as f64,
                error: error.sqrt() * factor,
            }
        };
        let mut shapes: Vec<Shape> = kept.iter().map(shape).collect();
        shapes.sort_by(|a, b| b.travelled().total_cmp(&a.travelled()));
        let (width, height) = self.small;
        let stage = Picture::new(width, height, &self.ground)
            .and_then(|ground| Stage::find(&ground, 0))
            .ok()
            .map(|stage| {
                let view = View { scale: stage.view.scale * factor, corner: stage.view.corner * factor };
                (view, stage.layout, stage.has_landmarks())
            })
            // A house is no arena: shapes are outside of it, too.
            .filter(|(view, ..)| {
                let side = view.scale * phase_model::arena::SIDE;
                let within = |place: &Vec2| {
                    let off = *place - view.corner;
                    off.min_element() > 0.0 && off.max_element() < side
                };
                shapes.iter().all(|shape| shape.path.iter().all(within))
            });
        Ok(ShapeTrack { shapes, seconds: self.frames, frame_rate, stage })
    }
}

/// Whether one shape is within the reach of another nearly always.
fn inside(shape: &FollowedShape, other: &FollowedShape) -> bool {
    let mut both = 0;
    let mut within = 0;
    let mut places = other.path.iter().peekable();
    for (frame, place, _) in &shape.path {
        while places.next_if(|it| it.0 < *frame).is_some() {}
        if let Some((_, middle, _)) = places.peek().filter(|it| it.0 == *frame) {
            both += 1;
            within += usize::from(place.distance(*middle) < other.reach);
        }
    }
    10 * within > 9 * both && 2 * both > shape.path.len()
}

//! Shapes of any form that move over a plain ground, where no arena with agents is to be seen.
//!
//! A video is watched twice: a [`Survey`] finds what does not move and the colours of the rest, and a
//! [`ShapeTracker`] then follows the shapes by colour, place and size. Shapes may have one colour, as in Heider
//! and Simmel's film; those that touch are then divided in proportion to their sizes.

use crate::{
    BodyRows, Picture, Roles, TrackError, View,
    arena::Stage,
    detect::{commonest, mean},
    event::{event, noise},
    picture::{Rgb, distance},
    table::{Line, rows, scale},
};
use phase_event::{Missing, Noise, ObservedEvent, Tracking};
use phase_model::{AGENT_COUNT, Layout, MAX_ENTITIES, MAX_OBJECTS, Size, Vec2, arena::STEP_VIDEO_SECONDS};
use std::fmt::Write as _;

/// Longest side of a picture in which shapes are looked for (pixels); larger ones are reduced.
const LONGEST_SIDE: usize = 640;
/// Pictures of which the ground is the median: half as many at least.
const PICTURES: usize = 24;
/// Difference of colour that is more than noise.
const DIFFERENT: f32 = 45.0;
/// Least share of the picture that has the colour of the floor.
const LEAST_FLOOR: f32 = 0.3;
/// Colours that are told apart.
const MOST_COLOURS: usize = 10;
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
/// Error of a heading that is that of motion (rad).
const HEADING: f32 = 0.5;

/// A picture with sides of [`LONGEST_SIDE`] pixels at most, and how many pixels became one across.
fn reduced(picture: &Picture<'_>) -> (usize, usize, usize, Vec<u8>) {
    let (width, height) = picture.size();
    let factor = width.max(height).div_ceil(LONGEST_SIDE);
    if factor == 1 {
        return (width, height, 1, picture.bytes().to_vec());
    }
    let (across, down) = (width / factor, height / factor);
    let mut bytes = Vec::with_capacity(3 * across * down);
    for y in 0..down {
        for x in 0..across {
            let mut sum = [0_u32; 3];
            for row in picture.bytes().chunks_exact(3 * width).skip(y * factor).take(factor) {
                for pixel in row[3 * x * factor..3 * (x + 1) * factor].chunks_exact(3) {
                    sum = [0, 1, 2].map(|k| sum[k] + u32::from(pixel[k]));
                }
            }
            bytes.extend(sum.map(|sum| (sum / (factor * factor) as u32) as u8));
        }
    }
    (across, down, factor, bytes)
}

/// Watches a video for the first time: what stays, and the colours of what does not.
#[derive(Debug, Default)]
pub struct Survey {
    frames: usize,
    /// Every so many frames are kept.
    every: usize,
    kept: Vec<Vec<u8>>,
    /// Size of a picture, and of a reduced one.
    size: (usize, usize),
    small: (usize, usize),
}

impl Survey {
    /// A survey that has seen nothing.
    #[must_use]
    pub fn new() -> Self {
        Self { every: 1, ..Self::default() }
    }

    /// Takes the next frame.
    ///
    /// # Errors
    /// [`TrackError::Resized`].
    pub fn push(&mut self, picture: &Picture<'_>) -> Result<(), TrackError> {
        let frame = self.frames;
        self.frames += 1;
        if frame > 0 && picture.size() != self.size {
            return Err(TrackError::Resized { frame });
        }
        self.size = picture.size();
        if frame.is_multiple_of(self.every.max(1)) {
            if self.kept.len() == PICTURES {
                let mut odd = false;
                self.kept.retain(|_| {
                    odd = !odd;
                    odd
                });
                self.every *= 2;
                if !frame.is_multiple_of(self.every) {
                    return Ok(());
                }
            }
            let (width, height, _, bytes) = reduced(picture);
            self.small = (width, height);
            self.kept.push(bytes);
        }
        Ok(())
    }

    /// A tracker of all that moves over the ground.
    ///
    /// # Errors
    /// [`TrackError::Shapes`] if the ground has no plain colour or nothing moves on it;
    /// [`TrackError::Short`] without frames.
    pub fn finish(self) -> Result<ShapeTracker, TrackError> {
        if self.kept.len() < 3 {
            return Err(TrackError::Short { frames: self.frames, seconds: 0.0 });
        }
        let (width, height) = self.small;
        let area = width * height;
        let middle = |k: usize| {
            let mut values: Vec<u8> = self.kept.iter().map(|bytes| bytes[k]).collect();
            let half = values.len() / 2;
            *values.select_nth_unstable(half).1
        };
        let ground: Vec<u8> = (0..3 * area).map(middle).collect();
        let at = |bytes: &[u8], k: usize| [0, 1, 2].map(|channel| f32::from(bytes[3 * k + channel]));
        let pixels: Vec<(Vec2, Rgb)> = (0..area).map(|k| (Vec2::ZERO, at(&ground, k))).collect();
        let floor = commonest(&pixels).unwrap_or([255.0; 3]);
        let near = pixels.iter().map(|(_, colour)| *colour).filter(|it| distance(*it, floor) < DIFFERENT);
        let share = near.clone().count() as f32 / area as f32;
        let floor = mean(near);
        if share < LEAST_FLOOR {
            let rule = format!("its ground has no plain colour ({:.0} % at most)", 100.0 * share);
            return Err(TrackError::Shapes(rule));
        }
        // What is in the ground but leaves its place is a shape that rested for long.
        let mut stays: Vec<bool> = (0..area).map(|k| distance(at(&ground, k), floor) > DIFFERENT).collect();
        for patch in components(&stays, width) {
            let left = self.kept.iter().any(|bytes| {
                let gone = patch.iter().filter(|&&k| distance(at(bytes, k), floor) < DIFFERENT).count();
                2 * gone > patch.len()
            });
            if left {
                patch.iter().for_each(|&k| stays[k] = false);
            }
        }
        let mut tracker = ShapeTracker {
            size: self.size,
            small: self.small,
            floor,
            ground,
            stays,
            colours: Vec::new(),
            frames: Vec::new(),
            followed: Vec::new(),
        };
        let mut moving: Vec<(Vec2, Rgb)> = Vec::new();
        for bytes in &self.kept {
            moving.extend((0..area).filter(|&k| tracker.moves(bytes, k)).map(|k| (Vec2::ZERO, at(bytes, k))));
        }
        let least = AREA[0] * area as f32;
        while tracker.colours.len() < MOST_COLOURS {
            let Some(mut colour) = commonest(&moving) else { break };
            for _ in 0..3 {
                let near = moving.iter().map(|(_, it)| *it).filter(|it| distance(*it, colour) < DIFFERENT);
                if near.clone().next().is_some() {
                    colour = mean(near);
                }
            }
            let before = moving.len();
            moving.retain(|(_, it)| distance(*it, colour) >= DIFFERENT);
            if ((before - moving.len()) as f32) < 0.3 * least * self.kept.len() as f32 {
                break;
            }
            tracker.colours.push(colour);
        }
        if tracker.colours.is_empty() {
            return Err(TrackError::Shapes("nothing moves in it".into()));
        }
        Ok(tracker)
    }
}

/// The connected parts of a mask.
fn components(mask: &[bool], width: usize) -> Vec<Vec<usize>> {
    let mut left = mask.to_vec();
    let mut parts = Vec::new();
    for start in 0..mask.len() {
        if !left[start] {
            continue;
        }
        left[start] = false;
        let mut part = vec![start];
        let mut next = 0;
        while let Some(&k) = part.get(next) {
            next += 1;
            let x = k % width;
            let beside = [
                (x > 0).then(|| k - 1),
                (x + 1 < width).then_some(k + 1),
                k.checked_sub(width),
                (k + width < mask.len()).then_some(k + width),
            ];
            for k in beside.into_iter().flatten() {
                if left[k] {
                    left[k] = false;
                    part.push(k);
                }
            }
        }
        parts.push(part);
    }
    parts
}

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
    /// [`TrackError::Resized`], [`TrackError::Long`] for more than an hour, and [`TrackError::Uneven`] if time
    /// does not grow.
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

/// A shape that moved.
#[derive(Clone, PartialEq, Debug)]
pub struct Shape {
    /// Its colour.
    pub colour: [u8; 3],
    /// Radius of a disc of its area (pixels).
    pub radius: f32,
    /// The middle of its area in every frame (pixels from the upper left corner).
    pub path: Vec<Vec2>,
    /// Share of the frames in which it was seen; elsewhere its path goes straight.
    pub seen: f64,
    /// Root mean square of the estimated errors of its places (pixels).
    pub error: f32,
}

impl Shape {
    /// The length of its path (pixels), without the trembling of its edges.
    fn travelled(&self) -> f32 {
        let mut sum = 0.0;
        let mut from = self.path[0];
        for place in &self.path {
            if place.distance(from) > 0.25 * self.radius {
                sum += place.distance(from);
                from = *place;
            }
        }
        sum
    }
}

/// The shapes of a video, those that moved farthest first.
#[derive(Clone, PartialEq, Debug)]
pub struct ShapeTrack {
    /// Two shapes or more.
    pub shapes: Vec<Shape>,
    /// Time of every frame (s).
    pub seconds: Vec<f64>,
    /// Frames a second.
    pub frame_rate: f64,
    /// The arena, its layout, and whether it has landmarks, if there is one.
    stage: Option<(View, Layout, bool)>,
}

impl ShapeTrack {
    /// All places as a table with the columns `time` (s), `body` (a number from 1), `x` and `y` (pixels, y
    /// down).
    #[must_use]
    pub fn table(&self) -> String {
        let mut text = String::from("time,body,x,y\n");
        for (frame, seconds) in self.seconds.iter().enumerate() {
            for (k, shape) in self.shapes.iter().enumerate() {
                let Vec2 { x, y } = shape.path[frame];
                let _ = writeln!(text, "{seconds:.4},{},{x:.2},{y:.2}", k + 1);
            }
        }
        text
    }

    /// An event in which the two shapes that moved farthest are the agents and the next two the objects,
    /// unless roles say otherwise. Agents face where they move. Without an arena, the event has no walls,
    /// paths are fitted into it, and each size is the nearest of the four.
    ///
    /// # Errors
    /// [`TrackError::Map`] if roles name a shape that is not there, [`TrackError::Short`] below one step.
    pub fn event(&self, roles: Option<&Roles>) -> Result<(ObservedEvent, Tracking), TrackError> {
        let all: Vec<[u8; 3]> = self.shapes.iter().map(|shape| shape.colour).collect();
        let order = match roles {
            Some(roles) => roles.order(&all, |_, _| true)?,
            None => (0..self.shapes.len().min(MAX_ENTITIES)).collect(),
        };
        let start = self.seconds.first().copied().unwrap_or_default();
        let steps =
            ((self.seconds.last().copied().unwrap_or(start) - start) / STEP_VIDEO_SECONDS + 1e-6) as usize;
        let lines: Vec<Vec<Line>> = order
            .iter()
            .map(|&k| {
                let line =
                    |(seconds, place): (&f64, &Vec2)| (*seconds, [place.x, place.y].map(f64::from), None);
                self.seconds.iter().zip(&self.shapes[k].path).map(line).collect()
            })
            .collect();
        let (factor, offset) = match &self.stage {
            Some((view, _, _)) => {
                let origin = view.pixel(Vec2::ZERO);
                let factor = 1.0 / f64::from(view.scale);
                (factor, [-f64::from(origin.x) * factor, f64::from(origin.y) * factor])
            }
            None => scale(&lines, None, true)?,
        };
        let mut bodies: Vec<BodyRows> =
            lines.iter().map(|line| rows(line, start, steps, (factor, offset), true)).collect();
        for (body, &k) in bodies.iter_mut().zip(&order) {
            let position = self.shapes[k].error * factor as f32;
            let velocity = position / phase_model::arena::STEP_SECONDS as f32;
            body.deviations.fill([position, position, velocity, velocity, HEADING]);
        }
        let size = |&k: &usize| {
            let radius = self.shapes[k].radius * factor as f32;
            let off = |size: &Size| (size.radius() - radius).abs();
            Size::ALL.into_iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(Size::Medium)
        };
        let sizes: Vec<Size> = order.iter().map(size).collect();
        let Noise { position, velocity, .. } = noise(&bodies);
        let seen: f64 = order.iter().map(|&k| self.shapes[k].seen).sum();
        let tracking = Tracking {
            noise: Noise { position, velocity, angle: HEADING },
            frames: self.seconds.len() as u32,
            frame_rate: self.frame_rate,
            straight: true,
            hidden: 1.0 - seen / order.len() as f64,
            missing: Missing {
                forms: true,
                walls: self.stage.is_none(),
                landmarks: self.stage.is_none_or(|(_, _, landmarks)| !landmarks),
                bodies: (self.shapes.len() - order.len()) as u32,
            },
            deviations: bodies.iter().map(|body| body.deviations.clone()).collect(),
        };
        let layout = match &self.stage {
            Some((_, layout, _)) => *layout,
            None => Layout::new(0, None).map_err(|_| TrackError::Walls)?,
        };
        debug_assert!(sizes.len() <= AGENT_COUNT + MAX_OBJECTS);
        Ok((event(layout, &sizes, &bodies)?.with_tracking(&tracking), tracking))
    }
}

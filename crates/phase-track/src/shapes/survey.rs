//! The first pass through a video of shapes: its ground, and the colours of what moves over it.

use super::{AREA, DIFFERENT, ShapeTracker};
use crate::{
    Picture, TrackError,
    detect::{commonest, mean},
    picture::{Rgb, distance},
};
use phase_model::Vec2;

/// Longest side of a picture in which shapes are looked for (pixels); larger ones are reduced.
const LONGEST_SIDE: usize = 640;
/// Pictures of which the ground is the median: half as many at least.
const PICTURES: usize = 24;
/// Least share of the picture that has the colour of the floor.
const LEAST_FLOOR: f32 = 0.3;
/// Colours that are told apart.
const MOST_COLOURS: usize = 10;

/// A picture with sides of [`LONGEST_SIDE`] pixels at most, and how many pixels became one across.
pub(super) fn reduced(picture: &Picture<'_>) -> (usize, usize, usize, Vec<u8>) {
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
pub(super) fn components(mask: &[bool], width: usize) -> Vec<Vec<usize>> {
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

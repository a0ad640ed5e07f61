//! The arena in a picture: its frame, inner walls, landmarks and colours.

use crate::{
    TrackError,
    picture::{Picture, Rgb, darkness, distance, mix},
};
use phase_model::{
    Flip, Layout, Segment, Vec2,
    arena::{self, LANDMARK_HALF_SIDE, LANDMARKS},
};

/// Lines of one direction that may be edges of the arena: half of them from either side.
const MOST_PEAKS: usize = 8;
/// The place, from the middle of a landmark to its edge, at which its rim begins.
const RIM: f32 = 0.7;
/// Squares of lines that may be the arena.
const MOST_FRAMES: usize = 16;

/// Place and scale of the arena in the picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct View {
    /// Pixels of a world unit.
    pub scale: f32,
    /// The arena's upper left corner (pixels from the upper left corner of the picture).
    pub corner: Vec2,
}

impl View {
    /// The world point at the centre of a pixel.
    pub(crate) fn point(self, x: usize, y: usize) -> Vec2 {
        let offset = (Vec2::new(x as f32 + 0.5, y as f32 + 0.5) - self.corner) / self.scale;
        Vec2::new(arena::MIN.x + offset.x, arena::MAX.y - offset.y)
    }

    /// The place of a world point (pixels).
    #[must_use]
    pub fn pixel(self, point: Vec2) -> Vec2 {
        self.corner + Vec2::new(point.x - arena::MIN.x, arena::MAX.y - point.y) * self.scale
    }

    /// The pixels of a picture within a distance (u) of a world point, every `stride`-th in both directions.
    pub(crate) fn pixels_within(
        self,
        (width, height): (usize, usize),
        centre: Vec2,
        reach: f32,
        stride: usize,
    ) -> impl Iterator<Item = (usize, usize)> {
        let centre = self.pixel(centre);
        let reach = reach * self.scale;
        let range = |centre: f32, end: usize| {
            let low = (centre - reach).floor().clamp(0.0, end as f32) as usize;
            low..((centre + reach).ceil().clamp(0.0, end as f32) as usize).max(low)
        };
        let columns = range(centre.x, width);
        let near = move |x: usize, y: usize| {
            centre.distance_squared(Vec2::new(x as f32 + 0.5, y as f32 + 0.5)) <= reach * reach
        };
        range(centre.y, height)
            .step_by(stride)
            .flat_map(move |y| columns.clone().step_by(stride).map(move |x| (x, y)))
            .filter(move |&(x, y)| near(x, y))
    }
}

/// The parts of a picture that do not move.
#[derive(Clone, Debug)]
pub(crate) struct Stage {
    pub(crate) view: View,
    pub(crate) layout: Layout,
    pub(crate) floor: Rgb,
    /// Colour of each landmark; that of the floor where there is none.
    pub(crate) landmarks: [Rgb; 4],
    /// Standard deviation of the floor's colour.
    pub(crate) noise: f32,
    /// Half the width of a wall (u).
    half_wall: f32,
}

impl Stage {
    /// Finds the arena. `frame` is the picture's number.
    pub(crate) fn find(picture: &Picture<'_>, frame: usize) -> Result<Self, TrackError> {
        let mut refusal = TrackError::NoArena { frame };
        let mut best: Option<(f32, Self)> = None;
        for (view, half_wall) in frames_of(picture) {
            match Self::in_frame(picture, view, half_wall) {
                // Axes around the arena also make a square; walls then fit less well.
                Ok((agreeing, stage)) if best.as_ref().is_none_or(|(most, _)| agreeing > most + 0.005) => {
                    best = Some((agreeing, stage));
                }
                Ok(_) => {}
                Err(error) => refusal = error,
            }
        }
        best.map(|(_, stage)| stage).ok_or(refusal)
    }

    /// The stage in a square of lines, and the share of places at which the picture agrees with its layout.
    fn in_frame(picture: &Picture<'_>, view: View, half_wall: f32) -> Result<(f32, Self), TrackError> {
        let everywhere = |_: Vec2| true;
        let (floor, noise) = main_colour(picture, view, everywhere);
        // An agent of much the same colour may cover most of a landmark, but hardly of its rim.
        let rim = |centre: Vec2, point: Vec2| {
            on(centre, point) && (point - centre).abs().max_element() > RIM * LANDMARK_HALF_SIDE
        };
        let landmarks = LANDMARKS.map(|centre| main_colour(picture, view, |point| rim(centre, point)).0);
        let mut stage = Self {
            view,
            layout: Layout::new(0, None).map_err(|_| TrackError::Walls)?,
            floor,
            landmarks,
            noise,
            half_wall,
        };
        let (agreeing, layout) = stage.layout_of(picture)?;
        stage.layout = layout;
        Ok((agreeing, stage))
    }

    /// Whether any landmark has another colour than the floor.
    pub(crate) fn has_landmarks(&self) -> bool {
        self.landmarks.iter().any(|landmark| distance(*landmark, self.floor) > 12.0 + 3.0 * self.noise)
    }

    /// The colour at a world point without bodies.
    pub(crate) fn colour(&self, point: Vec2, walls: &[Segment]) -> Rgb {
        let at = LANDMARKS.iter().position(|&centre| on(centre, point));
        let ground = at.map_or(self.floor, |landmark| self.landmarks[landmark]);
        let edge = (point - arena::CENTRE).abs().max_element() - 0.5 * arena::SIDE;
        let inner = walls.iter().map(|wall| to_segment(wall, point)).fold(f32::INFINITY, f32::min);
        let wall = edge.abs().min(inner) - self.half_wall;
        mix(ground, [0.0; 3], (0.5 - wall * self.view.scale).clamp(0.0, 1.0))
    }

    /// Whether a colour belongs to what does not move at a world point.
    pub(crate) fn explains(&self, colour: Rgb, point: Vec2, walls: &[Segment]) -> bool {
        let near = 24.0 + 3.0 * self.noise;
        distance(colour, self.floor) < near
            || darkness(colour) > 0.3
            || distance(colour, self.colour(point, walls)) < near
    }

    /// The layout whose walls are in the picture, and the share of places that agree.
    fn layout_of(&self, picture: &Picture<'_>) -> Result<(f32, Layout), TrackError> {
        // Places along the four lines from the centre on which there may be walls, and whether there is one.
        let mut places = Vec::new();
        for direction in [Vec2::Y, Vec2::NEG_X, Vec2::NEG_Y, Vec2::X] {
            for k in 4..98 {
                let point = arena::CENTRE + direction * (0.1 * k as f32);
                // Ends of walls are as thick as they are; places beside them say nothing.
                if (k % 25).min(25 - k % 25) <= 4 {
                    continue;
                }
                let across = direction.perp();
                let darkest = (-2..=2)
                    .filter_map(|step| self.seen(picture, point + across * (step as f32 / self.view.scale)))
                    .map(|colour| (darkness(colour), colour))
                    .max_by(|a, b| a.0.total_cmp(&b.0));
                let Some((dark, colour)) = darkest else { continue };
                let ground = self.colour(point, &[]);
                if dark > 0.35 || distance(colour, ground) < 24.0 + 3.0 * self.noise {
                    places.push((point, dark > 0.35));
                }
            }
        }
        let flips = core::iter::once(None).chain(Flip::ALL.map(Some));
        let layouts = flips.flat_map(|flip| (0..22).filter_map(move |base| Layout::new(base, flip).ok()));
        let agreeing = |layout: &Layout| {
            let walls = layout.walls();
            let is_wall = |point: Vec2| walls.iter().any(|wall| to_segment(wall, point) < 0.05);
            places.iter().filter(|(point, dark)| is_wall(*point) == *dark).count()
        };
        let mut best: Option<(usize, Layout)> = None;
        for layout in layouts {
            let agreeing = agreeing(&layout);
            if best.is_none_or(|(most, _)| agreeing > most) {
                best = Some((agreeing, layout));
            }
        }
        // A quarter of one of the four lines is a sixteenth of all places.
        match best {
            Some((agreeing, layout)) if 100 * agreeing >= 97 * places.len() && places.len() > 100 => {
                Ok((agreeing as f32 / places.len() as f32, layout))
            }
            _ => Err(TrackError::Walls),
        }
    }

    fn seen(&self, picture: &Picture<'_>, point: Vec2) -> Option<Rgb> {
        let pixel = self.view.pixel(point);
        let (width, height) = picture.size();
        let inside = pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < width as f32 && pixel.y < height as f32;
        inside.then(|| picture.at(pixel.x as usize, pixel.y as usize))
    }
}

/// Whether a landmark covers a point.
fn on(landmark: Vec2, point: Vec2) -> bool {
    (point - landmark).abs().max_element() < LANDMARK_HALF_SIDE
}

fn to_segment(segment: &Segment, point: Vec2) -> f32 {
    let along = segment.b - segment.a;
    let share = ((point - segment.a).dot(along) / along.length_squared().max(1e-9)).clamp(0.0, 1.0);
    point.distance(segment.a + along * share)
}

/// The commonest colour of the part of the arena that `is_part`, and how much it varies.
fn main_colour(picture: &Picture<'_>, view: View, is_part: impl Fn(Vec2) -> bool) -> (Rgb, f32) {
    let mut counts = vec![0_u32; 4096];
    let bin =
        |colour: Rgb| colour.iter().fold(0, |bin, channel| 16 * bin + (*channel as usize + 8).min(255) / 16);
    let reach = 0.7 * arena::SIDE;
    let pixels = || {
        view.pixels_within(picture.size(), arena::CENTRE, reach, 2).filter(|&(x, y)| {
            let point = view.point(x, y);
            (point - arena::CENTRE).abs().max_element() < 0.49 * arena::SIDE && is_part(point)
        })
    };
    for (x, y) in pixels() {
        counts[bin(picture.at(x, y))] += 1;
    }
    let most = (0..counts.len()).max_by_key(|&bin| counts[bin]).unwrap_or(0);
    let middle = [most / 256, most / 16 % 16, most % 16].map(|level| level as f32 * 16.0);
    let mut sum = [0.0_f64; 3];
    let mut squares = 0.0_f64;
    let mut count = 0.0_f64;
    for colour in pixels().map(|(x, y)| picture.at(x, y)).filter(|&colour| distance(colour, middle) < 30.0) {
        for (sum, channel) in sum.iter_mut().zip(colour) {
            *sum += f64::from(channel);
            squares += f64::from(channel * channel);
        }
        count += 1.0;
    }
    if count == 0.0 {
        return (middle, 0.0);
    }
    let mean = sum.map(|sum| sum / count);
    let variance = squares / count - mean.iter().map(|mean| mean * mean).sum::<f64>();
    (mean.map(|mean| mean as f32), (variance.max(0.0) / 3.0).sqrt() as f32)
}

/// Squares of long dark lines, the largest first, with half the width of their lines (u).
fn frames_of(picture: &Picture<'_>) -> Vec<(View, f32)> {
    let (width, height) = picture.size();
    let dark = |x: usize, y: usize| darkness(picture.at(x, y));
    // Bars beside or above the picture.
    let mut columns = 0..width;
    let mut rows = 0..height;
    let row_is_bar = |y: usize| (0..width).map(|x| dark(x, y)).sum::<f32>() > 0.7 * width as f32;
    let column_is_bar = |x: usize| (0..height).map(|y| dark(x, y)).sum::<f32>() > 0.7 * height as f32;
    while !rows.is_empty() && row_is_bar(rows.start) {
        rows.start += 1;
    }
    while !rows.is_empty() && row_is_bar(rows.end - 1) {
        rows.end -= 1;
    }
    while !columns.is_empty() && column_is_bar(columns.start) {
        columns.start += 1;
    }
    while !columns.is_empty() && column_is_bar(columns.end - 1) {
        columns.end -= 1;
    }
    if rows.len() < 32 || columns.len() < 32 {
        return Vec::new();
    }
    // A line at the picture's edge may itself be taken for a bar.
    let rows = if rows.start > 0 && rows.start < 8 { 0..height } else { rows };
    let columns = if columns.start > 0 && columns.start < 8 { 0..width } else { columns };
    let of_columns: Vec<f32> = columns.clone().map(|x| rows.clone().map(|y| dark(x, y)).sum()).collect();
    let least = 0.25 * columns.len().min(rows.len()) as f32;
    let mut found = Vec::new();
    for (left, right, wide) in pairs(&of_columns) {
        let inside = columns.start + left as usize..(columns.start + right.ceil() as usize + 1).min(width);
        let of_rows: Vec<f32> = rows.clone().map(|y| inside.clone().map(|x| dark(x, y)).sum()).collect();
        for (top, bottom, high) in pairs(&of_rows) {
            let sides = Vec2::new(right - left, bottom - top);
            let is_square = (sides.x - sides.y).abs() < 0.03 * sides.max_element();
            if !is_square || sides.max_element() < least || sides.x < 60.0 {
                continue;
            }
            let scale = 0.5 * (sides.x + sides.y) / arena::SIDE;
            let corner = Vec2::new(columns.start as f32 + left, rows.start as f32 + top);
            let corner = corner + 0.5 * sides - Vec2::splat(0.5 * arena::SIDE * scale);
            found.push((View { scale, corner }, 0.25 * (wide + high) / scale));
        }
    }
    found.sort_by(|a, b| b.0.scale.total_cmp(&a.0.scale));
    found.truncate(MOST_FRAMES);
    found
}

/// The middles of two of the highest peaks of a profile, and the mean of their widths.
fn pairs(profile: &[f32]) -> Vec<(f32, f32, f32)> {
    let peaks = peaks(profile);
    let pairs = peaks.iter().enumerate().flat_map(|(k, a)| peaks[k + 1..].iter().map(move |b| (a, b)));
    pairs.filter(|(a, b)| b.0 - a.0 > 40.0).map(|(a, b)| (a.0, b.0, 0.5 * (a.1 + b.1))).collect()
}

/// The middles of the highest peaks of a profile, with their widths.
fn peaks(profile: &[f32]) -> Vec<(f32, f32)> {
    let most = profile.iter().copied().fold(0.0, f32::max);
    if most < 20.0 {
        return Vec::new();
    }
    let high = |k: usize| profile[k] > 0.6 * most;
    let starts = (0..profile.len()).filter(|&k| high(k) && (k == 0 || !high(k - 1)));
    let peak = |start: usize| {
        let end = (start..profile.len()).take_while(|&k| high(k)).last().unwrap_or(start);
        let from = start.saturating_sub(2);
        let to = (end + 2).min(profile.len() - 1);
        // Landmarks and bodies make a base below the peak.
        let base = profile[from].max(profile[to]).min(0.4 * most);
        let above = |k: usize| (profile[k] - base).max(0.0);
        let total: f32 = (from..=to).map(above).sum();
        let sum: f32 = (from..=to).map(|k| (k as f32 + 0.5) * above(k)).sum();
        (sum / total, total / (most - base))
    };
    let all: Vec<_> = starts.map(peak).collect();
    let ends = MOST_PEAKS / 2;
    // The arena's edges are the outermost of all lines, or inside of a few others.
    let kept = |k: usize| k < ends || k + ends >= all.len();
    all.iter().enumerate().filter(|(k, _)| kept(*k)).map(|(_, peak)| *peak).collect()
}

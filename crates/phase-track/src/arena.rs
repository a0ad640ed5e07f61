//! The arena in a picture: its frame, inner walls, landmarks and colours.

use crate::{
    TrackError,
    picture::{Picture, Rgb, darkness, distance, mix},
    squares::frames_of,
    view::View,
};
use phase_model::{
    Flip, Layout, Segment, Vec2,
    arena::{self, LANDMARK_HALF_SIDE, LANDMARKS},
};

/// The place, from the middle of a landmark to its edge, at which its rim begins.
const RIM: f32 = 0.7;
/// Rows of pixels across an edge of a landmark from which its place is measured, at least.
const LEAST_ROWS: usize = 8;

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
        let mut best: Option<(usize, f32, Self)> = None;
        for (view, half_wall) in frames_of(picture) {
            match Self::in_frame(picture, view, half_wall) {
                Ok((agreeing, stage)) => {
                    let landmarks =
                        stage.landmarks.iter().filter(|&&colour| stage.is_landmark(colour)).count();
                    // A room also makes a square, but without all landmarks; so do axes around the arena, and
                    // walls then fit less well.
                    if best.as_ref().is_none_or(|&(most, agreed, _)| {
                        landmarks > most || landmarks == most && agreeing > agreed + 0.005
                    }) {
                        best = Some((landmarks, agreeing, stage));
                    }
                }
                Err(error) => refusal = error,
            }
        }
        best.map(|(_, _, stage)| stage).ok_or(refusal)
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
        // Lines are drawn along the arena's edge or outside of it; landmarks tell which.
        let outside = view.scaled(1.0 - 2.0 * half_wall / arena::SIDE);
        if let Some(scale) = stage.scale_by_landmarks(picture)
            && (scale - outside.scale).abs() < (scale - view.scale).abs()
        {
            stage.view = outside;
        }
        Ok((agreeing, stage))
    }

    /// Whether any landmark has another colour than the floor.
    pub(crate) fn has_landmarks(&self) -> bool {
        self.landmarks.iter().any(|&landmark| self.is_landmark(landmark))
    }

    fn is_landmark(&self, colour: Rgb) -> bool {
        distance(colour, self.floor) > 12.0 + 3.0 * self.noise
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

    /// Pixels of a unit by the inner edges of landmarks, which are 5 u from the arena's middle. `None` where
    /// there are no landmarks, or bodies hide their edges.
    fn scale_by_landmarks(&self, picture: &Picture<'_>) -> Option<f32> {
        let middle = self.view.pixel(arena::CENTRE);
        let mut edges = Vec::new();
        for (centre, colour) in LANDMARKS.into_iter().zip(self.landmarks) {
            // Compression leaves edges of brightness where they are, but not those of colour.
            let range = brightness(colour) - brightness(self.floor);
            if range.abs() < 20.0 + 3.0 * self.noise {
                continue;
            }
            let share = |pixel: Vec2| {
                let seen = self.seen(picture, self.view.world(pixel))?;
                let share = (brightness(seen) - brightness(self.floor)) / range;
                (-0.2..=1.2).contains(&share).then_some(share)
            };
            let from = self.view.pixel(centre);
            let inwards = (middle - from).signum();
            let reach = (1.6 * LANDMARK_HALF_SIDE * self.view.scale) as usize;
            let rows = (0.7 * LANDMARK_HALF_SIDE * self.view.scale) as i32;
            for step in [Vec2::new(inwards.x, 0.0), Vec2::new(0.0, inwards.y)] {
                let mut distances = Vec::new();
                for row in -rows..=rows {
                    let start = from.floor() + Vec2::splat(0.5) + step.perp() * row as f32;
                    let shares: Option<Vec<f32>> =
                        (0..reach).map(|k| share(start + step * k as f32)).collect();
                    let Some(shares) = shares else { continue };
                    let changes: f32 = shares.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
                    if shares[0] > 0.8 && shares[reach - 1] < 0.2 && changes < 1.6 {
                        // The first pixel begins half a pixel before its middle.
                        let edge = start + step * (shares.iter().sum::<f32>() - 0.5);
                        distances.push(((edge - middle) * step).length());
                    }
                }
                distances.sort_by(f32::total_cmp);
                if distances.len() >= LEAST_ROWS {
                    edges.push(distances[distances.len() / 2]);
                }
            }
        }
        let from_middle = (arena::CENTRE.x - LANDMARKS[0].x).abs() - LANDMARK_HALF_SIDE;
        // Bodies of much the same brightness may move some edges.
        edges.sort_by(f32::total_cmp);
        let middle = [edges.len().saturating_sub(1) / 2, edges.len() / 2].map(|k| edges.get(k).copied());
        let [Some(low), Some(high)] = middle else { return None };
        Some(0.5 * (low + high) / from_middle)
    }

    fn seen(&self, picture: &Picture<'_>, point: Vec2) -> Option<Rgb> {
        let pixel = self.view.pixel(point);
        let (width, height) = picture.size();
        let inside = pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < width as f32 && pixel.y < height as f32;
        inside.then(|| picture.at(pixel.x as usize, pixel.y as usize))
    }
}

fn brightness([red, green, blue]: Rgb) -> f32 {
    0.299 * red + 0.587 * green + 0.114 * blue
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

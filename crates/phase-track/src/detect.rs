//! The bodies in a picture about which nothing is known but its arena.

use crate::{
    TrackError,
    arena::Stage,
    fit::{Fit, SHARP, Surroundings},
    picture::{Picture, Rgb, distance},
    shape::{Appearance, Form, Look, Pose},
};
use core::f32::consts::TAU;
use phase_model::{AGENT_COUNT, MAX_OBJECTS, Segment, Size, Vec2};

/// Widths of outlines inside and outside of a body's edge (u): none, that of our renderer, and a line of some
/// 1.4 pixels along the edge, as plotting programs draw it.
const OUTLINES: [[f32; 2]; 3] = [[0.0, 0.0], [0.09, 0.0], [0.04, 0.04]];
/// Widths of edges (pixels): sharp, or blurred by compression, which keeps fewer pixels of colour than of
/// brightness.
const EDGES: [f32; 3] = [SHARP, 2.5, 4.0];
/// Mean difference of colour inside bodies up to which edges are not looked at more closely.
const CLEAR: f32 = 18.0;
/// Least area of a body's plain colour (u²): half that of the smallest.
const LEAST_AREA: f32 = 0.7;
/// Greatest mean square distance of a patch's pixels from its middle, as a share of its area: 0.16 in discs,
/// 0.21 to 0.24 in agents, more where others cover a part of them, and 1.5 to 3.5 in strips that were seen.
const MOST_SPREAD: f32 = 0.6;
/// Directions in which an agent is looked for.
const DIRECTIONS: usize = 12;
/// Radius of the smallest body at which its form can be told (pixels looked at).
const ENOUGH: f32 = 8.0;
/// Bodies of a colour of their own that are looked for.
const MOST_COLOURS: usize = 8;

/// A body that was found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    pub(crate) body: Appearance,
    pub(crate) size: Size,
    pub(crate) fit: Fit,
}

/// The agents, then the objects; and how wide edges are (pixels). `thin_too` if bodies may have few pixels of
/// plain colour.
pub(crate) fn bodies(
    picture: &Picture<'_>,
    stage: &Stage,
    ground: &[u8],
    negative: bool,
    thin_too: bool,
) -> Result<(f32, Vec<Found>), TrackError> {
    let walls = stage.layout.walls();
    let patches = patches(picture, stage, &walls);
    if !thin_too && patches.iter().any(|patch| patch.thin) {
        // A later picture may show more of it.
        return Err(TrackError::Covered);
    }
    let mut best: Option<(f32, f32, Vec<Found>)> = None;
    for soft in EDGES {
        let view = stage.view;
        let surroundings =
            Surroundings { picture, ground, view, soft, stride: 1, above: &[], below: &[], others: &[] };
        let looks = OUTLINES
            .into_iter()
            .flat_map(|[outline, margin]| [true, false].map(|eyes| Look { outline, margin, eyes, negative }))
            // Eyes may be the same on any ground, or the negative of those on a light one.
            .flat_map(|look| [Some(look), negative.then_some(Look { negative: false, ..look })])
            .flatten();
        for look in looks {
            let found: Vec<Found> =
                (0..patches.len()).filter_map(|k| identify(&surroundings, &patches, k, look)).collect();
            let found = reconsider(&surroundings, found);
            let difference =
                found.iter().map(|found| found.fit.difference).sum::<f32>() / found.len().max(1) as f32;
            if best.as_ref().is_none_or(|(least, _, before)| {
                found.len() > before.len() || found.len() == before.len() && difference < *least
            }) {
                best = Some((difference, soft, found));
            }
        }
        if best.as_ref().is_some_and(|(least, _, found)| *least < CLEAR && found.len() >= AGENT_COUNT) {
            break;
        }
    }
    let (_, soft, found) = best.unwrap_or_default();
    let (mut agents, mut objects): (Vec<_>, Vec<_>) =
        found.into_iter().partition(|found| found.body.form == Form::Trapezoid);
    if agents.len() != AGENT_COUNT || objects.len() > MAX_OBJECTS {
        return Err(TrackError::Bodies { agents: agents.len(), objects: objects.len() });
    }
    // Red before green, blue before pink, as palettes have them.
    let shown = |found: &Found| found.body.colour.map(|it| if negative { 255.0 - it } else { it });
    agents.sort_by(|a, b| hue(shown(a)).total_cmp(&hue(shown(b))));
    objects.sort_by(|a, b| blueness(shown(b)).total_cmp(&blueness(shown(a))));
    agents.append(&mut objects);
    Ok((soft, agents))
}

/// A connected area of one colour.
struct Patch {
    colour: Rgb,
    centre: Vec2,
    /// u²
    area: f32,
    /// Whether most of it are edges: of a small body, or of one of which others cover a part.
    thin: bool,
}

fn patches(picture: &Picture<'_>, stage: &Stage, walls: &[Segment]) -> Vec<Patch> {
    let (width, height) = picture.size();
    let near = 26.0 + 3.0 * stage.noise;
    // Pixels in the midst of a colour tell what colours there are; those at its edges count, too, where
    // bodies are so small that these are most of their area.
    let mut pixels: Vec<(Vec2, Rgb)> = Vec::new();
    let mut edges: Vec<(Vec2, Rgb)> = Vec::new();
    let corner = stage.view.corner;
    let side = stage.view.scale * phase_model::arena::SIDE;
    let range = |start: f32, end: usize| {
        (start.max(1.0) as usize + 1)..((start + side) as usize).min(end.saturating_sub(2))
    };
    for y in range(corner.y, height) {
        for x in range(corner.x, width) {
            let colour = picture.at(x, y);
            let plain = [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)]
                .iter()
                .all(|&(x, y)| distance(picture.at(x, y), colour) < near);
            let point = stage.view.point(x, y);
            if !stage.explains(colour, point, walls) {
                if plain { &mut pixels } else { &mut edges }.push((point, colour));
            }
        }
    }
    let pixel = 1.0 / (stage.view.scale * stage.view.scale);
    let mut patches = Vec::new();
    for _ in 0..MOST_COLOURS {
        let Some(colour) = commonest(&pixels) else { break };
        let mut colour = colour;
        for _ in 0..3 {
            colour =
                mean(pixels.iter().filter(|(_, it)| distance(*it, colour) < 1.5 * near).map(|(_, it)| *it));
        }
        let (mine, others): (Vec<_>, Vec<_>) =
            pixels.into_iter().partition(|(_, it)| distance(*it, colour) < 1.5 * near);
        pixels = others;
        let area = mine.len() as f32 * pixel;
        if mine.is_empty() || area < 0.3 * LEAST_AREA {
            break;
        }
        let centre = median(&mine);
        let is_close = |point: Vec2| point.distance(centre) < 3.2;
        let points = |of: &[(Vec2, Rgb)]| -> Vec<Vec2> {
            let of_colour =
                |(point, it): &&(Vec2, Rgb)| is_close(*point) && distance(*it, colour) < 1.5 * near;
            of.iter().filter(of_colour).map(|(point, _)| *point).collect()
        };
        let mut close = points(&mine);
        let middle = close.iter().sum::<Vec2>() / close.len().max(1) as f32;
        let mut area = close.len() as f32 * pixel;
        let thin = area < LEAST_AREA;
        let mut is_body = !thin;
        if thin {
            close.append(&mut points(&edges));
            area = close.len() as f32 * pixel;
            let spread = close.iter().map(|point| point.distance_squared(middle)).sum::<f32>() * pixel / area;
            // Edges of landmarks in compressed pictures are long strips of a colour of their own.
            is_body = area >= LEAST_AREA && spread < MOST_SPREAD * area;
        }
        if is_body {
            patches.push(Patch { colour, centre: middle, area, thin });
        }
    }
    patches
}

pub(crate) fn commonest(pixels: &[(Vec2, Rgb)]) -> Option<Rgb> {
    let mut counts = vec![0_u32; 4096];
    let bin = |colour: Rgb| colour.iter().fold(0, |bin, channel| 16 * bin + *channel as usize / 16);
    for (_, colour) in pixels {
        counts[bin(*colour)] += 1;
    }
    let most = (0..counts.len()).max_by_key(|&bin| counts[bin])?;
    (counts[most] > 0).then(|| [most / 256, most / 16 % 16, most % 16].map(|level| level as f32 * 16.0 + 8.0))
}

pub(crate) fn mean(colours: impl Iterator<Item = Rgb>) -> Rgb {
    let mut sum = [0.0; 3];
    let mut count = 0.0_f32;
    for colour in colours {
        sum = [0, 1, 2].map(|k| sum[k] + colour[k]);
        count += 1.0;
    }
    sum.map(|sum| sum / count.max(1.0))
}

fn median(pixels: &[(Vec2, Rgb)]) -> Vec2 {
    let middle = |of: fn(&Vec2) -> f32| {
        let mut values: Vec<f32> = pixels.iter().map(|(point, _)| of(point)).collect();
        values.sort_by(f32::total_cmp);
        values[values.len() / 2]
    };
    Vec2::new(middle(|point| point.x), middle(|point| point.y))
}

/// The form, size and pose that explain a patch of colour best, if any does.
fn identify(surroundings: &Surroundings<'_>, patches: &[Patch], k: usize, look: Look) -> Option<Found> {
    let patch = &patches[k];
    let others: Vec<Rgb> =
        patches.iter().enumerate().filter(|(other, _)| *other != k).map(|(_, other)| other.colour).collect();
    // What is found is looked at again with all pixels.
    let stride = ((surroundings.view.scale * Size::ALL[0].radius() / ENOUGH) as usize).max(1);
    let surroundings = &Surroundings { others: &others, stride, ..*surroundings };
    let mut best: Option<(f32, Found)> = None;
    for size in Size::ALL {
        let radius = size.radius();
        let inner = radius - look.outline;
        for form in [Form::Disc, Form::Trapezoid] {
            // Eyes hide up to a third of an agent's colour, another body up to a half; edges are not counted.
            let whole =
                if form == Form::Disc { core::f32::consts::PI * inner * inner } else { 4.0 * inner * inner };
            if patch.area > 1.15 * whole || patch.area < 0.25 * whole {
                continue;
            }
            let body = Appearance { form, radius, colour: patch.colour, look };
            let directions = if form == Form::Disc { 1 } else { DIRECTIONS };
            let start = |k: usize| {
                let angle = TAU * k as f32 / directions as f32;
                // The eyes leave more of the colour at the back.
                let forward = Vec2::from_angle(angle).perp();
                let behind = if form == Form::Disc { 0.0 } else { 0.3 * radius };
                Pose { position: patch.centre + forward * behind, angle }
            };
            for k in 0..directions {
                let fit = surroundings.fit(&body, start(k), 3.0 * SHARP);
                let score = surroundings.mismatch(&body, &fit.pose, patch.centre);
                if best.as_ref().is_none_or(|(least, _)| score < *least) {
                    best = Some((score, Found { body, size, fit }));
                }
            }
        }
    }
    best.filter(|(_, found)| found.fit.difference < 45.0).map(|(_, found)| found)
}

/// The sizes and poses that explain the picture best now that it is known what is beside and on each body.
fn reconsider(surroundings: &Surroundings<'_>, mut found: Vec<Found>) -> Vec<Found> {
    for k in 0..found.len() {
        let me = found[k];
        let others = found.iter().enumerate().filter(|(other, _)| *other != k);
        let others = others.map(|(_, other)| (other.body, other.fit.pose));
        let is_above =
            |other: &(Appearance, Pose)| me.body.form == Form::Trapezoid && other.0.form == Form::Disc;
        let (above, below): (Vec<_>, Vec<_>) = others.partition(is_above);
        let surroundings = Surroundings { above: &above, below: &below, ..*surroundings };
        let mut best: Option<(f32, Found)> = None;
        for size in Size::ALL {
            let body = Appearance { radius: size.radius(), ..me.body };
            let fit = surroundings.fit(&body, me.fit.pose, 4.0 * SHARP);
            let score = surroundings.mismatch(&body, &fit.pose, me.fit.pose.position);
            if best.as_ref().is_none_or(|(least, _)| score < *least) {
                best = Some((score, Found { body, size, fit }));
            }
        }
        if let Some((_, better)) = best {
            found[k] = better;
        }
    }
    found
}

/// Hue from red (0) over green (1/3) to blue (2/3); slightly bluish reds come first.
pub(crate) fn hue([red, green, blue]: Rgb) -> f32 {
    let most = red.max(green).max(blue);
    let least = red.min(green).min(blue);
    let range = (most - least).max(1.0);
    let hue = if most == red {
        (green - blue) / range / 6.0
    } else if most == green {
        (2.0 + (blue - red) / range) / 6.0
    } else {
        (4.0 + (red - green) / range) / 6.0
    };
    if hue > 0.9 { hue - 1.0 } else { hue }
}

fn blueness([red, green, blue]: Rgb) -> f32 {
    blue + 0.5 * green - 1.5 * red
}

//! Tables of positions as events without labels.

use crate::{
    BodyRows, TrackError,
    event::{event, noise},
};
use phase_event::{Missing, ObservedEvent, Tracking};
use phase_model::{
    AGENT_COUNT, Layout, MAX_ENTITIES, Size, Vec2,
    arena::{self, STEP_SECONDS, STEP_VIDEO_SECONDS},
    foreign, json,
};
use serde_json::Value;
use std::collections::BTreeMap;

/// Greatest number of lines of a table.
const MOST_LINES: usize = 4_000_000;
/// Space that is left around positions that are fitted into the arena (u).
const MARGIN: f32 = 2.0;
/// Speed below which a body's heading is not that of its motion (u/s of physics).
const SLOW: f32 = 0.3;
/// Standard deviation of an angle that is a heading (rad).
const HEADING_DEVIATION: f32 = 0.5;

/// Meaning of a table that has one line for each body and time.
#[derive(Clone, PartialEq, Debug)]
pub struct TableOptions {
    /// Names of the columns of time, body, x, y and angle (rad), the last empty where there is none; of the
    /// default columns it may be missing in the table, too. In JSON a dot leads into an object, as in
    /// `track.x`.
    pub columns: [String; 5],
    /// Units of time a second, such as 25 for a column of frame numbers.
    pub rate: f64,
    /// The bodies that are agents 0 and 1 and objects 0 and 1, by what the column says; without, the first
    /// four in the order in which they appear.
    pub bodies: Vec<String>,
    /// The rectangle that becomes the arena, as `[left, bottom, right, top]`; without, positions stay as they
    /// are if all lie inside of the arena, or are fitted into it.
    pub bounds: Option<[f64; 4]>,
    /// Whether y grows downwards, as in pictures.
    pub y_down: bool,
    /// Sizes, in the order of bodies; the last stands for all others.
    pub sizes: Vec<Size>,
    /// Walls.
    pub layout: Layout,
}

impl Default for TableOptions {
    /// Columns `time`, `body`, `x`, `y` and perhaps `angle`, in seconds; the third size of four, no walls.
    fn default() -> Self {
        Self {
            columns: ["time", "body", "x", "y", "angle"].map(String::from),
            rate: 1.0,
            bodies: Vec::new(),
            bounds: None,
            y_down: false,
            sizes: vec![Size::Medium],
            layout: Layout::all_used().next().unwrap_or_else(|| unreachable!("there are layouts")),
        }
    }
}

impl TableOptions {
    /// Whether the table has to have a column of angles: where one is named, and not by default.
    fn needs_angles(&self) -> bool {
        !self.columns[4].is_empty() && self.columns != Self::default().columns
    }
}

/// One line: time, place and angle.
pub(crate) type Line = (f64, [f64; 2], Option<f64>);

/// Reads a table (`ending` `csv`, `tsv`, or JSON in lines) as an event without labels.
///
/// # Errors
/// [`TrackError::Table`] names line, column and rule; [`TrackError::Short`] below one step.
pub fn table(
    bytes: &[u8],
    ending: &str,
    options: &TableOptions,
) -> Result<(ObservedEvent, Tracking), TrackError> {
    let mut names: Vec<String> = Vec::new();
    let mut tracks: BTreeMap<String, Vec<Line>> = BTreeMap::new();
    let mut count = 0;
    let mut has_angles = false;
    each_line(bytes, ending, options, &mut |number, [time, body, x, y, angle]| {
        count += 1;
        if count > MOST_LINES {
            return Err(TrackError::Table(format!("has more than {MOST_LINES} lines")));
        }
        let needed = |column: usize, text: Option<String>| {
            let name = &options.columns[column];
            text.ok_or_else(|| TrackError::Table(format!("line {number}: has no column {name:?}")))
        };
        let number_in = |column: usize, text: String| {
            let value: Option<f64> = text.trim().parse().ok().filter(|value: &f64| value.is_finite());
            let name = &options.columns[column];
            value.ok_or_else(|| {
                TrackError::Table(format!("line {number}: {name} must be a number, not {text:?}"))
            })
        };
        let body = needed(1, body)?;
        let seconds = number_in(0, needed(0, time)?)? / options.rate;
        let place = [number_in(2, needed(2, x)?)?, number_in(3, needed(3, y)?)?];
        has_angles |= angle.is_some();
        let angle = angle.filter(|it| !it.is_empty()).map(|it| number_in(4, it)).transpose()?;
        if !tracks.contains_key(&body) {
            names.push(body.clone());
        }
        tracks.entry(body).or_default().push((seconds, place, angle));
        Ok(())
    })?;
    if options.needs_angles() && !has_angles && count > 0 {
        return Err(TrackError::Table(format!("has no column {:?} in any line", options.columns[4])));
    }
    let chosen = if options.bodies.is_empty() {
        names.into_iter().take(MAX_ENTITIES).collect()
    } else {
        options.bodies.clone()
    };
    if !(AGENT_COUNT..=MAX_ENTITIES).contains(&chosen.len()) {
        let rule = format!("must have two agents and up to two objects, not {} bodies", chosen.len());
        return Err(TrackError::Table(rule));
    }
    if options.sizes.len() > chosen.len() {
        let rule = format!("has {} bodies, fewer than the {} sizes", chosen.len(), options.sizes.len());
        return Err(TrackError::Table(rule));
    }
    let mut lines = Vec::new();
    for (k, name) in chosen.iter().enumerate() {
        if chosen[..k].contains(name) {
            return Err(TrackError::Table(format!("cannot have the body {name:?} in two roles")));
        }
        let mut track =
            tracks.remove(name).ok_or_else(|| TrackError::Table(format!("has no body {name:?}")))?;
        track.sort_by(|a, b| a.0.total_cmp(&b.0));
        if let Some(pair) = track.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            return Err(TrackError::Table(format!("has two places of {name:?} at {} s", pair[0].0)));
        }
        if track.len() < 2 {
            return Err(TrackError::Table(format!("has {name:?} at one time only")));
        }
        lines.push(track);
    }
    let fits = |line: &Line| {
        let y = if options.y_down { -line.1[1] } else { line.1[1] };
        arena::contains(Vec2::new(line.1[0] as f32, y as f32))
    };
    let to_arena = if options.bounds.is_none() && lines.iter().flatten().all(fits) {
        (1.0, [0.0; 2])
    } else {
        scale(&lines, options.bounds, options.y_down)?
    };
    let start = lines.iter().map(|track| track[0].0).fold(f64::NEG_INFINITY, f64::max);
    let end = lines.iter().map(|track| track[track.len() - 1].0).fold(f64::INFINITY, f64::min);
    let steps = ((end - start) / STEP_VIDEO_SECONDS + 1e-6).max(0.0) as usize;
    if steps == 0 {
        return Err(TrackError::Short { frames: count, seconds: end - start });
    }
    if end - start > 3600.0 {
        return Err(TrackError::Long(3600));
    }
    let rows: Vec<BodyRows> =
        lines.iter().map(|track| rows(track, start, steps, to_arena, options.y_down)).collect();
    let sizes = (0..chosen.len())
        .map(|k| options.sizes.get(k).or(options.sizes.last()).copied().unwrap_or(Size::Medium));
    let sizes: Vec<Size> = sizes.collect();
    let common = |track: &Vec<Line>| track.iter().filter(|line| (start..=end).contains(&line.0)).count();
    let longest = lines.iter().map(common).max().unwrap_or(0);
    let tracking = Tracking {
        noise: noise(&rows),
        frames: longest as u32,
        frame_rate: longest.saturating_sub(1) as f64 / (end - start),
        straight: true,
        hidden: hidden(&lines, start, steps),
        missing: Missing::default(),
        deviations: rows.iter().map(|body| body.deviations.clone()).collect(),
    };
    Ok((event(options.layout, &sizes, &rows)?.with_tracking(&tracking), tracking))
}

/// Share of the poses that no line of the body is within a step of (s), so that they lie on the straight way
/// between two others.
fn hidden(lines: &[Vec<Line>], start: f64, steps: usize) -> f64 {
    let is_hidden = |track: &Vec<Line>, t: usize| {
        let seconds = start + t as f64 * STEP_VIDEO_SECONDS;
        let near = |line: &Line| (line.0 - seconds).abs() <= STEP_VIDEO_SECONDS + 1e-6;
        let after = track.partition_point(|line| line.0 < seconds);
        !track[after.saturating_sub(1)..].iter().take(2).any(near)
    };
    let of = |track| (0..=steps).filter(|&t| is_hidden(track, t)).count();
    lines.iter().map(of).sum::<usize>() as f64 / (lines.len() * (steps + 1)) as f64
}

/// Calls `take` with the number and the five columns of every line.
fn each_line(
    bytes: &[u8],
    ending: &str,
    options: &TableOptions,
    take: &mut dyn FnMut(usize, [Option<String>; 5]) -> Result<(), TrackError>,
) -> Result<(), TrackError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if !["csv", "tsv"].contains(&ending) {
        for (k, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
            if line.trim_ascii().is_empty() {
                continue;
            }
            let value =
                json::parse_line(line, k + 1).map_err(|error| TrackError::Table(error.to_string()))?;
            let member =
                |path: &String| match path.split('.').try_fold(&value, |value, key| value.get(key))? {
                    Value::String(text) => Some(text.clone()),
                    Value::Number(number) => Some(number.to_string()),
                    _ => None,
                };
            let columns: [_; 5] = core::array::from_fn(|k| member(&options.columns[k]));
            // Other lines describe scenes, as in trajectory benchmarks.
            if columns[2].is_some() || columns[3].is_some() {
                take(k + 1, columns)?;
            }
        }
        return Ok(());
    }
    let delimiter = if ending == "tsv" { b'\t' } else { b',' };
    let mut reader = csv::ReaderBuilder::new().delimiter(delimiter).from_reader(bytes);
    let headers =
        reader.headers().map_err(|error| TrackError::Table(foreign::table(&error.to_string())))?.clone();
    let places_of = |name: &String| (0..headers.len()).filter(|&k| headers[k].trim() == name).collect();
    let mut found: [Vec<usize>; 5] = core::array::from_fn(|k| places_of(&options.columns[k]));
    if options.columns[4].is_empty() {
        // The column without a name that some programs write has their numbers of lines.
        found[4].clear();
    }
    if let Some(twice) = found.iter().position(|places| places.len() > 1) {
        let name = &options.columns[twice];
        return Err(TrackError::Table(format!("has {} columns {name:?}", found[twice].len())));
    }
    let places = found.map(|places| places.first().copied());
    let needed = if options.needs_angles() { 5 } else { 4 };
    if let Some(missing) = places[..needed].iter().position(Option::is_none) {
        let found: Vec<&str> = headers.iter().collect();
        let name = &options.columns[missing];
        return Err(TrackError::Table(format!(
            "has no column {name:?}, only {found:?}; --columns names them"
        )));
    }
    for (k, record) in reader.records().enumerate() {
        let record = record.map_err(|error| TrackError::Table(foreign::table(&error.to_string())))?;
        take(k + 2, places.map(|place| Some(record.get(place?)?.to_owned())))?;
    }
    Ok(())
}

/// Ratio of the whole area of motion and that of 98 % of the places, above which the rest are mistakes.
const FAR_AWAY: f64 = 100.0;

/// Factor and offset that lead from coordinates, y up, into the arena.
pub(crate) fn scale(
    lines: &[Vec<Line>],
    bounds: Option<[f64; 4]>,
    y_down: bool,
) -> Result<(f64, [f64; 2]), TrackError> {
    let up = |y: f64| if y_down { -y } else { y };
    let places = || lines.iter().flatten().map(|(_, [x, y], _)| [*x, up(*y)]);
    let fits = |[x, y]: [f64; 2]| arena::contains(Vec2::new(x as f32, y as f32));
    let (low, high, side) = if let Some([left, bottom, right, top]) = bounds {
        let [a, b] = [bottom, top].map(up);
        ([left, a.min(b)], [right, a.max(b)], f64::from(arena::SIDE))
    } else {
        let fold = |of: fn(f64, f64) -> f64, start: f64| {
            places().fold([start; 2], |so_far, place| [0, 1].map(|k| of(so_far[k], place[k])))
        };
        (
            fold(f64::min, f64::INFINITY),
            fold(f64::max, f64::NEG_INFINITY),
            f64::from(arena::SIDE - 2.0 * MARGIN),
        )
    };
    let extent = (high[0] - low[0]).max(high[1] - low[1]);
    if !(extent > 0.0 && extent.is_finite()) {
        return Err(TrackError::Table("nothing in it moves, and no bounds are given".into()));
    }
    if bounds.is_none() {
        check_spread([0, 1].map(|k| places().map(|place| place[k]).collect()), extent)?;
    }
    let factor = side / extent;
    let centre = [arena::CENTRE.x, arena::CENTRE.y].map(f64::from);
    let offset = [0, 1].map(|k| centre[k] - factor * 0.5 * (low[k] + high[k]));
    for place in places() {
        if !fits([0, 1].map(|k| factor * place[k] + offset[k])) {
            return Err(TrackError::Table(format!(
                "({}, {}) lies outside of the bounds",
                place[0],
                up(place[1])
            )));
        }
    }
    Ok((factor, offset))
}

/// Checks that the extent of a motion is not that of a few places far from all others, beside which the rest
/// would be one point.
fn check_spread(coordinates: [Vec<f64>; 2], extent: f64) -> Result<(), TrackError> {
    let inner = coordinates.map(|mut values| {
        values.sort_unstable_by(f64::total_cmp);
        let cut = values.len() / 100;
        values[values.len() - 1 - cut] - values[cut]
    });
    if inner[0].max(inner[1]) * FAR_AWAY < extent {
        let rule =
            "98 of 100 places lie within a hundredth of the whole area; leave out the others, or give bounds";
        return Err(TrackError::Table(rule.into()));
    }
    Ok(())
}

pub(crate) fn rows(
    track: &[Line],
    start: f64,
    steps: usize,
    (factor, offset): (f64, [f64; 2]),
    y_down: bool,
) -> BodyRows {
    let at = |seconds: f64| {
        let after = track.partition_point(|line| line.0 < seconds - 1e-9).clamp(1, track.len() - 1);
        let [a, b] = [&track[after - 1], &track[after]];
        let share = ((seconds - a.0) / (b.0 - a.0)).clamp(0.0, 1.0);
        let place = |line: &Line| [line.1[0], if y_down { -line.1[1] } else { line.1[1] }];
        let [p, q] = [place(a), place(b)];
        let place = [0, 1].map(|k| (factor * (p[k] + (q[k] - p[k]) * share) + offset[k]) as f32);
        let angle = a.2.zip(b.2).map(|(p, q)| p + libm::remainder(q - p, core::f64::consts::TAU) * share);
        (Vec2::from_array(place), angle.map(|it| if y_down { -it } else { it } as f32))
    };
    let mut result = BodyRows::default();
    let mut heading = 0.0_f32;
    for t in 0..=steps {
        let seconds = |t: usize| start + t as f64 * STEP_VIDEO_SECONDS;
        let (position, angle) = at(seconds(t));
        let from = t.saturating_sub(1);
        let to = (t + 1).min(steps);
        let velocity = (at(seconds(to)).0 - at(seconds(from)).0) / ((to - from) as f64 * STEP_SECONDS) as f32;
        if velocity.length() > SLOW {
            // An agent at angle 0 faces up.
            let towards = libm::atan2f(-velocity.x, velocity.y);
            heading += libm::remainderf(towards - heading, core::f32::consts::TAU);
        }
        result.rows.push([position.x, position.y, velocity.x, velocity.y, angle.unwrap_or(heading)]);
        let of_angle = if angle.is_some() { 0.0 } else { HEADING_DEVIATION };
        result.deviations.push([0.0, 0.0, 0.0, 0.0, of_angle]);
    }
    result
}

//! `track`: motion of bodies in videos, pictures or tables.

use crate::{
    context::Context, error::CliError, interrupt, json_file, named::named, output::Output, parallel::Jobs,
};
use clap::{Args, value_parser};
use phase_event::observed_to_json;
use phase_files::{atomic, told};
use phase_model::{Flip, Layout, Size};
use phase_runs::{
    error::{Fault, RunError},
    track::{TrackRun, Tracked, is_table, read_all},
};
use phase_track::{FrameMeaning, Roles, Shape, ShapeTrack, TableOptions};
use serde_json::json;
use std::path::{Path, PathBuf};

/// Options of `track`.
#[derive(Args, Debug)]
pub struct TrackOptions {
    /// Videos (.mp4, .gif; others through ffmpeg), folders of PNG pictures, or tables (.csv, .tsv, .jsonl)
    #[arg(value_name = "FILE|DIR", required = true)]
    pub inputs: Vec<PathBuf>,
    /// The file for the events, in the format phase-events/1 without labels
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Name of the event [default: the name of the input]
    #[arg(long, value_name = "ID")]
    pub id: Option<String>,
    /// Pictures a second in folders of PNG pictures, 4 to 240 [default: 20]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(4..=240))]
    pub frame_rate: Option<u32>,
    /// Meaning of frames: the motion itself, rows with bodies drawn straight from row to row, or rows each of
    /// which is held until the next [default: what the motion looks like]
    #[arg(long, value_name = "KIND", value_parser = named(MEANINGS, name_of))]
    pub frames: Option<FrameMeaning>,
    /// Agent 0, agent 1 and the objects, by colour (#rrggbb or a name) or number, with commas between
    /// [default: reddish agent and bluish object first; of other videos, the shapes that move farthest]
    #[arg(long, value_name = "BODIES", value_parser = Roles::read)]
    pub map: Option<Roles>,
    /// A table for the paths (pixels) of all shapes of a video that shows no arena with agents; `track` reads
    /// it again
    #[arg(long, value_name = "FILE")]
    pub shapes: Option<PathBuf>,
    /// Meaning of tables.
    #[command(flatten)]
    pub table: TableArguments,
    /// Number of inputs at once.
    #[command(flatten)]
    pub jobs: Jobs,
    /// Form in which the result is printed.
    #[command(flatten)]
    pub output: Output,
}

/// Options with which tables are read.
#[derive(Args, Debug)]
#[command(next_help_heading = "Tables")]
pub struct TableArguments {
    /// Columns of time, body, x, y and, if there is one, angle (rad), with commas between; a column that is
    /// named must be there. In JSON `a.b` is member b of member a
    #[arg(long, value_name = "NAMES", default_value = "time,body,x,y,angle", value_parser = columns)]
    pub columns: [String; 5],
    /// Units of the column of time in a second, above 0, such as 25 where it counts frames
    #[arg(long, value_name = "RATE", default_value_t = 1.0, value_parser = rate)]
    pub time_units: f64,
    /// The bodies that are agent 0, agent 1 and objects, with commas between [default: the first four]
    #[arg(long, value_name = "BODIES", value_delimiter = ',')]
    pub bodies: Vec<String>,
    /// The rectangle that becomes the arena: left, bottom, right, top [default: positions as they are if all
    /// lie in the arena, or else all of them fitted into it]
    #[arg(long, value_name = "L,B,R,T", value_parser = bounds, allow_hyphen_values = true)]
    pub bounds: Option<[f64; 4]>,
    /// y grows downwards, as in pictures
    #[arg(long)]
    pub y_down: bool,
    /// Size levels of the bodies, 0 to 3, with commas between; the last is that of all others
    #[arg(long, value_name = "LEVELS", default_value = "3", value_parser = size, value_delimiter = ',')]
    pub sizes: Vec<Size>,
    /// Walls: a base layout, 0 to 21, or with a flip, as in 12.3 (docs/reference/formats/events.md)
    #[arg(long, value_name = "LAYOUT", default_value = "0", value_parser = layout)]
    pub layout: Layout,
}

/// Pictures a second in folders of pictures, unless given.
const FRAME_RATE: u32 = 20;
/// The rule for inputs beside `--shapes`.
const ONE_FOREIGN: &str = "needs one video that shows no arena with agents";

const MEANINGS: [FrameMeaning; 3] = [FrameMeaning::Substeps, FrameMeaning::Rows, FrameMeaning::Held];

const fn name_of(meaning: FrameMeaning) -> &'static str {
    match meaning {
        FrameMeaning::Substeps => "motion",
        FrameMeaning::Rows => "rows",
        FrameMeaning::Held => "held",
    }
}

fn columns(text: &str) -> Result<[String; 5], String> {
    let names: Vec<String> = text.split(',').map(|name| name.trim().to_owned()).collect();
    if let Some(k) = (1..names.len()).find(|&k| names[..k].contains(&names[k])) {
        return Err(format!("names the column {:?} twice", names[k]));
    }
    match <[String; 5]>::try_from(names) {
        Ok(five) => Ok(five),
        Err(mut four) if four.len() == 4 => {
            four.push(String::new());
            four.try_into().map_err(|_| String::new())
        }
        Err(other) => {
            Err(format!("must name the columns of time, body, x, y and perhaps angle, not {}", other.len()))
        }
    }
}

fn rate(text: &str) -> Result<f64, String> {
    let rate = text.parse().ok().filter(|rate: &f64| *rate > 0.0 && rate.is_finite());
    rate.ok_or_else(|| format!("must be above 0, not {text:?}"))
}

fn bounds(text: &str) -> Result<[f64; 4], String> {
    let rule = || format!("must be left, bottom, right and top, such as 0,0,640,480, not {text:?}");
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|it| it.trim().parse().ok().filter(|it: &f64| it.is_finite())).collect();
    let bounds = numbers.and_then(|it| <[f64; 4]>::try_from(it).ok()).ok_or_else(rule)?;
    if bounds[0] < bounds[2] && bounds[1] != bounds[3] { Ok(bounds) } else { Err(rule()) }
}

fn size(text: &str) -> Result<Size, String> {
    let size = text.trim().parse().ok().and_then(Size::from_level);
    size.ok_or_else(|| format!("must be a size level 0 to 3, not {text:?}"))
}

fn layout(text: &str) -> Result<Layout, String> {
    let (base, flip) = text.split_once('.').map_or((text, None), |(base, flip)| (base, Some(flip)));
    let rule = || format!("must be a base layout 0 to 21, perhaps with a flip .0 to .3, not {text:?}");
    let base = base.parse().map_err(|_| rule())?;
    let flip = flip.map(|flip| {
        flip.parse::<usize>().ok().and_then(|flip| Flip::ALL.get(flip)).copied().ok_or_else(rule)
    });
    Layout::new(base, flip.transpose()?).map_err(|_| rule())
}

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &TrackOptions, context: &Context) -> Result<(), CliError> {
    arguments.check()?;
    json_file::check("--out", &arguments.out, &arguments.inputs)?;
    if let Some(shapes) = &arguments.shapes {
        json_file::check("--shapes", shapes, arguments.inputs.iter().chain([&arguments.out]))?;
    }
    interrupt::listen();
    let inputs = arguments.inputs.len();
    let runs: Vec<TrackRun> = arguments.inputs.iter().map(|input| arguments.run_of(input)).collect();
    let progress = context.progress("Tracking", inputs, 1);
    let done = |run: &TrackRun| progress.event(1, &told(&run.input));
    let (tracked, mut refused): (Vec<_>, Vec<_>) =
        read_all(&runs, arguments.jobs.threads(), done)?.into_iter().partition(Result::is_ok);
    let tracked: Vec<Tracked> = tracked.into_iter().flatten().collect();
    refused.retain(|result| !matches!(result, Err(error) if error.fault() == Fault::Interruption));
    let is_interrupted = tracked.len() + refused.len() < inputs;
    let mut refused: Vec<RunError> = refused.into_iter().filter_map(Result::err).collect();
    if tracked.is_empty() {
        return Err(match refused.pop() {
            _ if is_interrupted => RunError::Stopped(None).into(),
            Some(error) if inputs == 1 => error.into(),
            last => {
                refused.extend(last);
                CliError::Refused { inputs, refused }
            }
        });
    }
    let shapes = match (&arguments.shapes, &tracked[..]) {
        (None, _) => None,
        (Some(file), [Tracked { shapes: Some(shapes), .. }]) => Some((file, shapes)),
        (Some(_), _) => return Err(CliError::Usage(format!("--shapes: {ONE_FOREIGN}"))),
    };
    let events: Vec<_> =
        tracked.iter().map(|it| (it.id.as_str(), &it.observed, Some(&it.tracking))).collect();
    let text = observed_to_json(&events).map_err(RunError::from)?;
    atomic::write(&arguments.out, text.as_bytes()).map_err(CliError::Output)?;
    if let Some((file, shapes)) = shapes {
        atomic::write(file, shapes.table().as_bytes()).map_err(CliError::Output)?;
    }
    let lines: String = tracked.iter().map(line).collect();
    let report: Vec<_> = tracked.iter().map(report).collect();
    let file = arguments.out.display();
    arguments
        .output
        .print(format!("{lines}{file}"), &json!({ "file": told(&arguments.out), "events": report }))?;
    if is_interrupted {
        return Err(RunError::Stopped(Some(arguments.out.clone())).into());
    }
    if refused.is_empty() { Ok(()) } else { Err(CliError::Refused { inputs, refused }) }
}

impl TrackOptions {
    /// Whether each option says something about one of the inputs.
    fn check(&self) -> Result<(), CliError> {
        let refuse = |option: &str, rule: &str| Err(CliError::Usage(format!("{option}: {rule}")));
        let tables = self.inputs.iter().filter(|input| is_table(input)).count();
        let (table, usual) = (self.table.options(), TableOptions::default());
        let of_tables = [
            ("--columns", table.columns != usual.columns),
            ("--time-units", table.rate != usual.rate),
            ("--bodies", table.bodies != usual.bodies),
            ("--bounds", table.bounds != usual.bounds),
            ("--y-down", table.y_down != usual.y_down),
            ("--sizes", table.sizes != usual.sizes),
            ("--layout", table.layout != usual.layout),
        ];
        let of_pictures = [("--frames", self.frames.is_some()), ("--map", self.map.is_some())];
        let first = |given: &[(&'static str, bool)]| given.iter().find(|it| it.1).map(|it| it.0);
        if self.id.is_some() && self.inputs.len() > 1 {
            return refuse("--id", "names one event, but there are several inputs");
        }
        if let Some(option) = first(&of_pictures).filter(|_| tables == self.inputs.len()) {
            return refuse(option, "is about videos and pictures, and all inputs are tables");
        }
        if let Some(option) = first(&of_tables).filter(|_| tables == 0) {
            return refuse(option, "is about tables, and no input is one");
        }
        if self.frame_rate.is_some() && !self.inputs.iter().any(|input| input.is_dir()) {
            return refuse("--frame-rate", "is about folders of pictures, and no input is one");
        }
        if self.shapes.is_some() && (self.inputs.len() > 1 || tables > 0) {
            return refuse("--shapes", ONE_FOREIGN);
        }
        Ok(())
    }

    fn run_of(&self, input: &Path) -> TrackRun {
        TrackRun {
            input: input.to_owned(),
            id: self.id.clone(),
            frame_rate: f64::from(self.frame_rate.unwrap_or(FRAME_RATE)),
            meaning: self.frames,
            roles: self.map.clone(),
            table: self.table.options(),
        }
    }
}

impl TableArguments {
    fn options(&self) -> TableOptions {
        TableOptions {
            columns: self.columns.clone(),
            rate: self.time_units,
            bodies: self.bodies.clone(),
            bounds: self.bounds,
            y_down: self.y_down,
            sizes: self.sizes.clone(),
            layout: self.layout,
        }
    }
}

/// The errors with which an event was measured, for people.
fn line(tracked: &Tracked) -> String {
    let Tracked { id, observed, tracking, shapes } = tracked;
    let noise = tracking.noise;
    if let Some(shapes) = shapes {
        return foreign(tracked, shapes);
    }
    let objects = observed.object_sizes().len();
    let layout = observed.layout();
    let flip = layout.flip().map_or_else(String::new, |flip| format!(".{}", u8::from(flip)));
    format!(
        "{id}: {} steps from {} frames at {:.1} a second; layout {}{flip}, 2 agents, {objects} objects; errors {:.3} u, {:.1}°; {:.1} % of poses hidden{}\n",
        observed.steps(),
        tracking.frames,
        tracking.frame_rate,
        layout.base(),
        noise.position,
        noise.angle.to_degrees(),
        100.0 * tracking.hidden,
        if tracking.straight { "; bodies go straight from row to row" } else { "" },
    )
}

/// The shapes of a video without an arena and agents, for people.
fn foreign(tracked: &Tracked, found: &ShapeTrack) -> String {
    let Tracked { id, observed, tracking, .. } = tracked;
    let mut text = format!(
        "{id}: {} steps from {} frames at {:.1} a second, not of PHASE's agents but of other shapes:\n",
        observed.steps(),
        tracking.frames,
        tracking.frame_rate,
    );
    for (k, shape) in found.shapes.iter().enumerate() {
        let Shape { colour: [red, green, blue], radius, path, seen, .. } = shape;
        let start = path.first().copied().unwrap_or_default();
        text += &format!(
            "  {} #{red:02x}{green:02x}{blue:02x}, at first at ({:.0}, {:.0}), {radius:.0} pixels in radius, seen in {:.0} % of frames\n",
            k + 1,
            start.x,
            start.y,
            100.0 * seen,
        );
    }
    for sentence in tracking.missing.sentences() {
        text += &format!("  {sentence}\n");
    }
    text
}

/// The errors with which an event was measured, for programs.
fn report(tracked: &Tracked) -> serde_json::Value {
    let Tracked { id, observed, tracking, shapes } = tracked;
    let shapes = shapes.iter().flat_map(|found| &found.shapes);
    let shapes: Vec<_> = shapes
        .map(|Shape { colour, radius, path, seen, .. }| {
            let start = path.first().map(|place| place.to_array());
            json!({ "colour": colour, "radius": radius, "start": start, "seen": seen })
        })
        .collect();
    json!({
        "missing": tracking.missing,
        "shapes": shapes,
        "id": id,
        "steps": observed.steps(),
        "frames": tracking.frames,
        "frame_rate": tracking.frame_rate,
        "layout": observed.layout(),
        "objects": observed.object_sizes().len(),
        "noise": tracking.noise,
        "hidden": tracking.hidden,
        "straight": tracking.straight,
    })
}

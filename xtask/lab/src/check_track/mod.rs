//! `check-track`: errors of the tracks of videos whose motion is known.
//!
//! Events are drawn in several styles by code that shares nothing with the renderer of PHASE, and tracked
//! again. One style is compressed by the program `ffmpeg`; it is left out, and named, where there is none.

mod drawing;

use crate::{check_minds, error::LabError};
use clap::{Args, value_parser};
use core::f32::consts::TAU;
use cpu_time::ThreadTime;
use drawing::{Drawing, STYLES, Style};
use phase_cli::{context::Context, interrupt, json_file::JsonFile};
use phase_event::{ObservedEvent, Recording};
use phase_model::{AGENT_COUNT, MAX_ENTITIES};
use phase_runs::{
    error::RunError,
    interrupt::requested,
    track::{VideoError, read_mp4},
};
use phase_track::{Picture, Track, TrackError, Tracker};
use serde::Serialize;
use std::{
    fmt::Write as _,
    fs::File,
    io::Write as _,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

/// Distance from its own body (u) beyond which a place that is nearer to another body is an exchange.
const EXCHANGED: f32 = 0.5;

/// Options of `check-track`.
#[derive(Args, Debug)]
pub struct CheckTrack {
    /// The events: a file in the format phase-events/1, or the folder of a dataset; may be given several
    /// times. Of recordings, bodies are drawn straight from row to row
    #[arg(long, value_name = "FILE|DIR", required = true)]
    pub events: Vec<PathBuf>,
    /// Only the first N events of each file
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..))]
    pub limit: Option<u32>,
    /// The report as JSON.
    #[command(flatten)]
    pub json: JsonFile,
}

/// Errors in one style.
#[derive(Clone, Debug, Default, Serialize)]
struct Figures {
    style: &'static str,
    videos: usize,
    /// Why videos were refused.
    refused: Vec<String>,
    /// Error of position (u): median and 99th percentile.
    position: [f32; 2],
    /// Error of the heading of agents: 95th percentile (degrees).
    angle: f32,
    /// Rows in which a body is taken for another one.
    exchanged: usize,
    /// Videos whose walls, or sizes and number of bodies, are read wrongly.
    walls_wrong: usize,
    sizes_wrong: usize,
    /// Seconds of video tracked in a second of CPU time, decoding left out.
    times_real_time: f64,
}

#[derive(Default)]
struct Errors {
    figures: Figures,
    positions: Vec<f32>,
    angles: Vec<f32>,
    seconds: f64,
    cpu: f64,
}

/// Runs the command. A missed target is a result, not an error.
///
/// # Errors
/// Any [`LabError`] about the files, or an interruption.
pub fn run(arguments: &CheckTrack, context: &Context) -> Result<(), LabError> {
    arguments.json.check(&arguments.events)?;
    interrupt::listen();
    let mut events = Vec::new();
    for file in &arguments.events {
        let mut read = check_minds::recordings(file, &[], None, context)?;
        read.truncate(arguments.limit.map_or(usize::MAX, |limit| limit as usize));
        events.extend(read);
    }
    let folder = tempfile::tempdir().map_err(LabError::Scratch)?;
    let mut found = Vec::new();
    let mut missing = Vec::new();
    for style in STYLES {
        if style.compressed && !has_ffmpeg() {
            missing.push(style.name);
            continue;
        }
        let progress = context.progress(style.name, events.len(), 1);
        let mut errors = Errors::default();
        for recording in &events {
            if requested() {
                return Err(LabError::Interrupted);
            }
            errors.add(style, recording, folder.path())?;
            progress.event(1, &recording.id);
        }
        found.push(errors.summary(style));
    }
    Ok(arguments.json.print(&found, table(&found, &missing))?)
}

impl Errors {
    fn add(&mut self, style: Style, recording: &Recording, folder: &Path) -> Result<(), LabError> {
        let truth = recording.observed().map_err(|error| RunError::Usage(error.to_string()))?;
        let drawing = Drawing::new(style, &truth);
        let frames = drawing.frames(recording);
        self.figures.videos += 1;
        let tracked = if style.compressed {
            let file = folder.join("video.mp4");
            compress(style, frames.iter().map(|(_, state)| drawing.draw(state)), &file)
                .and_then(|()| File::open(&file))
                .map_err(VideoError::Io)
                .and_then(|file| self.timed(|| read_mp4(file)))
        } else {
            self.push(style, &drawing, &frames).map_err(VideoError::Track)
        };
        let event = tracked.and_then(|track| Ok(track.event(track.meaning(), None)?.0));
        match event {
            Ok(event) => self.compare(&truth, &event),
            Err(error) => self.figures.refused.push(format!("{}: {error}", recording.id)),
        }
        self.seconds += truth.steps() as f64 / 4.0;
        Ok(())
    }

    fn push(
        &mut self,
        style: Style,
        drawing: &Drawing,
        frames: &[(f64, phase_model::State)],
    ) -> Result<Track, TrackError> {
        let mut tracker = Tracker::new();
        let (width, height) = style.size;
        for (seconds, state) in frames {
            let bytes = drawing.draw(state);
            let picture = Picture::new(width, height, &bytes)?;
            self.timed(|| tracker.push(&picture, *seconds))?;
        }
        tracker.finish()
    }

    fn timed<T>(&mut self, work: impl FnOnce() -> T) -> T {
        let start = ThreadTime::now();
        let done = work();
        self.cpu += start.elapsed().as_secs_f64();
        done
    }

    fn compare(&mut self, truth: &ObservedEvent, found: &ObservedEvent) {
        let sizes = |event: &ObservedEvent| (event.agent_sizes(), event.object_sizes().to_vec());
        self.figures.walls_wrong += usize::from(truth.layout().walls() != found.layout().walls());
        self.figures.sizes_wrong += usize::from(sizes(truth) != sizes(found));
        let bodies = AGENT_COUNT + truth.object_sizes().len().min(found.object_sizes().len());
        for (truth, found) in truth.rows().iter().zip(found.rows()) {
            for k in 0..bodies.min(MAX_ENTITIES) {
                let off = |other: usize| found[k].position.distance(truth[other].position);
                self.positions.push(off(k));
                let exchanged = off(k) > EXCHANGED && (0..bodies).any(|other| off(other) < off(k));
                self.figures.exchanged += usize::from(exchanged);
                if k < AGENT_COUNT {
                    self.angles.push(libm::remainderf(found[k].angle - truth[k].angle, TAU).abs());
                }
            }
        }
    }

    fn summary(self, style: Style) -> Figures {
        let quantile = |mut values: Vec<f32>, shares: &[f64]| -> Vec<f32> {
            values.sort_by(f32::total_cmp);
            let last = values.len().saturating_sub(1) as f64;
            let at = |share: &f64| values.get((share * last).round() as usize).copied().unwrap_or(f32::NAN);
            shares.iter().map(at).collect()
        };
        let position = quantile(self.positions, &[0.5, 0.99]);
        Figures {
            style: style.name,
            position: [position[0], position[1]],
            angle: quantile(self.angles, &[0.95])[0].to_degrees(),
            times_real_time: self.seconds / self.cpu.max(1e-9),
            ..self.figures
        }
    }
}

fn table(found: &[Figures], missing: &[&str]) -> String {
    let mut text = format!(
        "{:<26} {:>6} {:>7} {:>10} {:>9} {:>9} {:>9} {:>5} {:>5} {:>9}\n",
        "style",
        "videos",
        "refused",
        "median u",
        "99 % u",
        "95 % °",
        "exchanged",
        "walls",
        "sizes",
        "real time"
    );
    for figures in found {
        let [median, most] = figures.position;
        let _ = writeln!(
            text,
            "{:<26} {:>6} {:>7} {median:>10.4} {most:>9.4} {:>9.2} {:>9} {:>5} {:>5} {:>8.1}x",
            figures.style,
            figures.videos,
            figures.refused.len(),
            figures.angle,
            figures.exchanged,
            figures.walls_wrong,
            figures.sizes_wrong,
            figures.times_real_time,
        );
    }
    for refusal in found.iter().flat_map(|figures| &figures.refused) {
        let _ = writeln!(text, "refused: {refusal}");
    }
    for style in missing {
        let _ = writeln!(text, "not measured, because ffmpeg is not installed: {style}");
    }
    text.trim_end().to_owned()
}

fn has_ffmpeg() -> bool {
    let version = Command::new("ffmpeg").arg("-version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    version.is_ok_and(|status| status.success())
}

/// Writes H.264 with CRF 35.
fn compress(style: Style, pictures: impl Iterator<Item = Vec<u8>>, file: &Path) -> std::io::Result<()> {
    let (width, height) = style.size;
    let mut child = Command::new("ffmpeg")
        .args(["-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-r", "20", "-s"])
        .arg(format!("{width}x{height}"))
        .args(["-i", "-", "-pix_fmt", "yuv420p", "-c:v", "libx264", "-crf", "35"])
        .arg(file)
        .stdin(Stdio::piped())
        .spawn()?;
    if let Some(mut input) = child.stdin.take() {
        for picture in pictures {
            input.write_all(&picture)?;
        }
    }
    let status = child.wait()?;
    if status.success() { Ok(()) } else { Err(std::io::Error::other("ffmpeg failed")) }
}

#[cfg(test)]
mod tests {
    use super::{Errors, STYLES};
    use phase_event::ObservedEvent;
    use phase_model::{Body, Layout, MAX_ENTITIES, Size, Vec2};

    /// 100 rows of bodies that rest, changed by `change`.
    fn event(layout: u8, first: Size, change: impl Fn(usize, &mut [Body; MAX_ENTITIES])) -> ObservedEvent {
        let row = |t: usize| {
            let mut row = [8.0, 12.0, 16.0, 20.0].map(|x| Body::at_rest(Vec2::new(x, 8.0), 0.0));
            change(t, &mut row);
            row
        };
        let layout = Layout::new(layout, None).expect("a layout");
        let rows = (0..100).map(row).collect();
        ObservedEvent::new(layout, [first, Size::Small], vec![Size::Small], rows).expect("an event")
    }

    #[test]
    fn errors_are_those_that_were_made() {
        let truth = event(0, Size::Small, |_, _| {});
        let found = event(2, Size::Large, |t, row| {
            // Three units off in two rows, a fifth of a unit in ten, and a whole turn, which is none.
            row[0].position.y += if t < 2 {
                3.0
            } else if t < 12 {
                0.2
            } else {
                0.0
            };
            row[0].angle = core::f32::consts::TAU;
            row[1].angle = if t < 20 { -0.5 } else { 0.0 };
            // The agents change places in one row; what is absent is not compared.
            if t == 50 {
                row.swap(0, 1);
            }
            row[3].position.x = 0.0;
        });
        let mut errors = Errors { seconds: 10.0, cpu: 2.0, ..Errors::default() };
        errors.compare(&truth, &found);
        assert_eq!((errors.positions.len(), errors.angles.len()), (300, 200));
        let figures = errors.summary(STYLES[0]);
        assert_eq!((figures.walls_wrong, figures.sizes_wrong, figures.exchanged), (1, 1, 2));
        // Of 300 errors, 286 are 0, then 10 of 0.2, two of 3 and two of 4 u.
        assert_eq!(figures.position[0], 0.0);
        assert!((figures.position[1] - 3.0).abs() < 0.01, "{:?}", figures.position);
        // A tenth of the headings of agents are half a radian off.
        assert!((figures.angle - 0.5_f32.to_degrees()).abs() < 0.01, "{}", figures.angle);
        assert_eq!(figures.times_real_time, 5.0);
    }
}

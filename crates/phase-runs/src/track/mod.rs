//! Tracks of videos and tables: motion of bodies as an event without labels.

mod animation;
mod boxes;
mod ffmpeg;
mod mp4;
mod pictures;

pub use crate::error::video::VideoError;
use crate::{error::RunError, interrupt::requested, parallel::make_all};
use phase_event::{ObservedEvent, Tracking, check_id};
use phase_files::{FileError, Problem, regular};
use phase_track::{
    FrameMeaning, Picture, Roles, ShapeTrack, Survey, TableOptions, Track, TrackError, Tracker,
};
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

/// Takes decoded frames: width and height (pixels), red, green and blue of each pixel, and the time (s).
type Sink<'a> = &'a mut dyn FnMut((usize, usize), &[u8], f64) -> Result<(), VideoError>;

/// Tracks H.264 in an .mp4, without the help of other programs.
///
/// # Errors
/// [`VideoError`].
pub fn read_mp4(file: std::fs::File) -> Result<Track, VideoError> {
    track(|sink| mp4::decode(file, sink))
}

/// Tracks the bodies of PHASE in what `decode` shows.
fn track(decode: impl FnOnce(Sink<'_>) -> Result<(), VideoError>) -> Result<Track, VideoError> {
    let mut tracker = Tracker::new();
    decode(&mut |(width, height), rgb, seconds| {
        goes_on()?;
        Ok(tracker.push(&Picture::new(width, height, rgb)?, seconds)?)
    })?;
    Ok(tracker.finish()?)
}

/// Follows shapes of any form, in two passes.
fn shapes(decode: impl Fn(Sink<'_>) -> Result<(), VideoError>) -> Result<ShapeTrack, VideoError> {
    let mut survey = Survey::new();
    decode(&mut |(width, height), rgb, _| {
        goes_on()?;
        Ok(survey.push(&Picture::new(width, height, rgb)?)?)
    })?;
    let mut tracker = survey.finish()?;
    decode(&mut |(width, height), rgb, seconds| {
        goes_on()?;
        Ok(tracker.push(&Picture::new(width, height, rgb)?, seconds)?)
    })?;
    Ok(tracker.finish()?)
}

fn goes_on() -> Result<(), VideoError> {
    if requested() { Err(VideoError::Interrupted) } else { Ok(()) }
}

/// Whether an input is read as a table, which its ending tells.
#[must_use]
pub fn is_table(input: &Path) -> bool {
    ["csv", "jsonl", "ndjson", "tsv"].contains(&ending(input).as_str())
}

/// A run that tracks one video or table.
#[derive(Clone, PartialEq, Debug)]
pub struct TrackRun {
    /// A video, a folder of PNG pictures, or a table (`.csv`, `.jsonl`).
    pub input: PathBuf,
    /// Name of the event; that of the input if absent.
    pub id: Option<String>,
    /// Frames a second of a folder of pictures.
    pub frame_rate: f64,
    /// Meaning of frames; found out if absent.
    pub meaning: Option<FrameMeaning>,
    /// The roles of bodies, if they are given.
    pub roles: Option<Roles>,
    /// Columns, rate and scale of a table.
    pub table: TableOptions,
}

/// An event that a run has read.
#[derive(Clone, Debug)]
pub struct Tracked {
    /// Name of the event.
    pub id: String,
    /// The event.
    pub observed: ObservedEvent,
    /// The errors with which it was measured.
    pub tracking: Tracking,
    /// All shapes of a video that does not show an arena with agents.
    pub shapes: Option<ShapeTrack>,
}

/// Reads many inputs, several at once; `done` is called with each that has been read or refused. Returns, in
/// their order, those that were done before an interruption.
///
/// # Errors
/// [`RunError::Usage`] for an unusable `id`, or for two inputs of one name; [`RunError::Threads`].
pub fn read_all(
    runs: &[TrackRun],
    threads: usize,
    done: impl Fn(&TrackRun) + Sync,
) -> Result<Vec<Result<Tracked, RunError>>, RunError> {
    let mut names = runs.iter().map(TrackRun::id).collect::<Result<Vec<_>, _>>()?;
    names.iter_mut().for_each(|name| name.make_ascii_lowercase());
    names.sort();
    if let Some(pair) = names.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(RunError::Usage(format!("two inputs give an event {}; rename one", pair[0])));
    }
    let read: Mutex<BTreeMap<usize, Result<Tracked, RunError>>> = Mutex::default();
    make_all(threads, runs.len(), |index| {
        let result = runs[index].read();
        read.lock().unwrap_or_else(PoisonError::into_inner).insert(index, result);
        done(&runs[index]);
        Ok(Some(()))
    })?;
    Ok(read.into_inner().unwrap_or_else(PoisonError::into_inner).into_values().collect())
}

impl TrackRun {
    /// Reads the input.
    ///
    /// # Errors
    /// [`RunError::Track`] names the file and the problem; [`RunError::Usage`] for an unusable `id`.
    pub fn read(&self) -> Result<Tracked, RunError> {
        let failed = |source: VideoError| RunError::Track { file: self.input.clone(), source };
        let id = self.id()?;
        let ending = ending(&self.input);
        let mut shapes_found = None;
        let (observed, tracking) = if is_table(&self.input) {
            let bytes = regular::bytes(&self.input)?;
            phase_track::table(&bytes, &ending, &self.table).map_err(|error| failed(error.into()))?
        } else {
            match track(|sink| self.decode(sink)) {
                Ok(track) => {
                    let meaning = self.meaning.unwrap_or_else(|| track.meaning());
                    track.event(meaning, self.roles.as_ref()).map_err(|error| failed(error.into()))?
                }
                Err(VideoError::Track(
                    why @ (TrackError::NoArena { .. }
                    | TrackError::Walls
                    | TrackError::Covered
                    | TrackError::Bodies { .. }),
                )) => {
                    let found = shapes(|sink| self.decode(sink)).map_err(|error| match error {
                        // Both reasons are of interest.
                        VideoError::Track(error @ TrackError::Shapes(_)) => {
                            failed(VideoError::Foreign { why, error })
                        }
                        error => failed(error),
                    })?;
                    let event = found.event(self.roles.as_ref()).map_err(|error| failed(error.into()))?;
                    shapes_found = Some(found);
                    event
                }
                Err(error) => return Err(failed(error)),
            }
        };
        Ok(Tracked { id, observed, tracking, shapes: shapes_found })
    }

    fn id(&self) -> Result<String, RunError> {
        let stem = || {
            let stem = self.input.file_stem().unwrap_or_default().to_string_lossy();
            let plain = |letter: char| letter.is_ascii_alphanumeric() || "-_".contains(letter);
            let id: String =
                stem.chars().map(|letter| if plain(letter) { letter } else { '-' }).take(60).collect();
            id.trim_start_matches('-').to_owned()
        };
        let id = self.id.clone().unwrap_or_else(stem);
        check_id(&id).map_err(|rule| RunError::Usage(format!("--id: {rule}, not {id:?}")))?;
        Ok(id)
    }

    fn decode(&self, sink: Sink<'_>) -> Result<(), VideoError> {
        if self.input.is_dir() {
            return pictures::decode(&self.input, self.frame_rate, sink);
        }
        let file = regular::open(&self.input).map_err(|FileError { problem, .. }| match problem {
            Problem::Unreadable(error) => VideoError::Io(error),
            other => VideoError::Unreadable(other.to_string()),
        })?;
        let native = match ending(&self.input).as_str() {
            "gif" => return animation::decode(file, sink),
            "mp4" | "m4v" | "mov" => mp4::decode(file, &mut *sink),
            "png" | "jpg" | "jpeg" | "bmp" | "webp" | "svg" => {
                let rule = "it is one picture; give a video, a GIF or a folder of PNG pictures";
                return Err(VideoError::Unreadable(rule.into()));
            }
            _ => Err(VideoError::Unreadable("its ending is not .mp4 or .gif".into())),
        };
        match native {
            Err(VideoError::Unreadable(why)) => ffmpeg::decode(&self.input, why, sink),
            other => other,
        }
    }
}

fn ending(path: &Path) -> String {
    path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default()
}

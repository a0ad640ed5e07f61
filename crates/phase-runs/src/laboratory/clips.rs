//! Clips of events as files.

use super::{Opened, open, tables::unusable, unfit};
use crate::{error::RunError, interrupt, listener::Listener, parallel::make_all, source::EventInput, words};
use gif::{Encoder, Repeat};
use phase_dataset::manifest::{EventEntry, MANIFEST_FILE, Manifest};
use phase_event::{Recording, check_id};
use phase_files::{atomic, run::Run};
use phase_laboratory::clip::{Clip, Cut, seconds_of};
use phase_model::{EventKind, PhysicsConfig, Relation, State, arena::FRAMES_PER_SECOND};
use phase_render::{Frame, PaletteName, RenderError, SceneRenderer, Style, VideoEncoder};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
};

/// The list of all clips; written last.
pub const CLIPS_FILE: &str = "clips.json";
/// The value of its field `format`.
const CLIPS_FORMAT: &str = "phase-clips/1";
/// Hundredths of a second that a frame of a GIF lasts.
const GIF_DELAY: u16 = (100 / FRAMES_PER_SECOND) as u16;
/// Effort of a GIF's colour table, 1 (best) to 30.
const GIF_SPEED: i32 = 10;

/// A form in which a clip is written.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ClipForm {
    /// A video, H.264 in 4:2:0 without sound, 20 frames a second, ready to play before it is fully loaded.
    Mp4,
    /// A folder with a picture for each frame.
    Png,
    /// An animated picture of at most 256 colours a frame.
    Gif,
}

/// Treatment of events that are too short.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shorter {
    /// Nothing is cut and the run fails.
    #[default]
    Refuse,
    /// They have no clip.
    LeaveOut,
}

/// A run that cuts clips.
#[derive(Clone, Debug)]
pub struct ClipRun {
    /// The events.
    pub events: PathBuf,
    /// Only these, if there are any.
    pub ids: Vec<String>,
    /// The part to cut.
    pub cut: Cut,
    /// Treatment of shorter events.
    pub shorter: Shorter,
    /// The folder for the clips.
    pub out: PathBuf,
    /// The forms to write, beside the events themselves.
    pub forms: Vec<ClipForm>,
    /// Whether pictures leave out what only this renderer draws: the bars of grips.
    pub plain: bool,
    /// Colours.
    pub palette: PaletteName,
    /// Side of the pictures (pixels), even.
    pub side: u32,
    /// Number of events at once.
    pub threads: usize,
}

/// Clips that are there.
#[derive(Clone, PartialEq, Debug)]
pub struct Clips {
    /// Number of clips.
    pub clips: usize,
    /// Events that were too short.
    pub left_out: Vec<String>,
    /// Whether they were made now.
    pub is_new: bool,
}

/// The list of clips, [`CLIPS_FILE`].
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ClipList {
    format: String,
    run: Value,
    pub(super) clips: Vec<Entry>,
    left_out: Vec<String>,
}

impl ClipList {
    /// Reads the list of a folder, which names one clip at least, each by another name.
    pub(super) fn read(file: &Path) -> Result<Self, RunError> {
        let list: Self = phase_files::json::read_format(file, CLIPS_FORMAT, "list of clips")?;
        if list.clips.is_empty() {
            return Err(unusable(file, "clips: there is none"));
        }
        let mut known = BTreeSet::new();
        for Entry { id, .. } in &list.clips {
            // Videos are named by it.
            check_id(id).map_err(|rule| unusable(file, &format!("clips: id {rule}, not {id:?}")))?;
            if !known.insert(id.to_ascii_lowercase()) {
                return Err(unusable(file, &format!("clips: id {id} is that of two clips")));
            }
        }
        for Entry { id, steps, video, .. } in &list.clips {
            if *steps == 0 {
                return Err(unusable(file, &format!("clip {id}: steps must be at least 1")));
            }
            if video.as_ref().is_some_and(|video| *video != format!("{id}.mp4")) {
                return Err(unusable(file, &format!("clip {id}: video must be {id}.mp4")));
            }
        }
        Ok(list)
    }
}

/// An event's clip, as the list names it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Entry {
    pub(super) id: String,
    source: String,
    first_step: usize,
    pub(super) steps: usize,
    seconds: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) set: Option<String>,
    pub(super) kind: EventKind,
    pub(super) relation: Relation,
    agents: Value,
    event: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) video: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) frames: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    gif: Option<String>,
}

impl ClipRun {
    /// Cuts all clips. Clips that are complete are kept after an interruption.
    ///
    /// # Errors
    /// If the events or the folder cannot be used, a file cannot be written, or a stop was requested.
    pub fn run(&self, listener: &dyn Listener) -> Result<Clips, RunError> {
        let source = EventInput::open(&self.events, &self.ids, listener)?;
        let sets = sets(&self.events)?;
        let run = Run::new([
            ("command", "clip".into()),
            ("events", source_digest(&source)?.into()),
            ("steps", self.cut.steps.into()),
            ("start", format!("{:?}", self.cut.start).into()),
            ("shorter", json!(self.shorter)),
            ("forms", json!(self.forms)),
            ("plain", self.plain.into()),
            ("palette", self.palette.name().into()),
            ("side", self.side.into()),
        ]);
        let folder = match open(&self.out, CLIPS_FILE, &run)? {
            Opened::Done(done) => {
                for file in files_of(&done) {
                    if !self.out.join(file).exists() {
                        let rule = format!("lists {file}, which is gone; make the clips in another folder");
                        return Err(RunError::Usage(format!(
                            "{}: {rule}",
                            self.out.join(CLIPS_FILE).display()
                        )));
                    }
                }
                let clips = done["clips"].as_array().map_or(0, Vec::len);
                let left_out = serde_json::from_value(done["left_out"].clone()).unwrap_or_default();
                return Ok(Clips { clips, left_out, is_new: false });
            }
            Opened::Open(folder) => folder,
        };
        let progress =
            listener.progress(&format!("cutting {}", words::events(source.len())), source.len(), 1);
        let made = make_all(self.threads, source.len(), |index| {
            let recording = source.load(index)?;
            let entry = self.clip(&recording, &sets);
            progress.event(0, &recording.id);
            match entry {
                Ok(entry) => Ok(Some((recording.id.clone(), Some(entry)))),
                Err(RunError::Usage(_)) if self.shorter == Shorter::LeaveOut => {
                    Ok(Some((recording.id.clone(), None)))
                }
                Err(error) => Err(error),
            }
        })?;
        drop(progress);
        let made = made.ok_or_else(|| RunError::Interrupted(self.out.clone()))?;
        let left_out: Vec<String> =
            made.iter().filter(|(_, entry)| entry.is_none()).map(|(id, _)| id.clone()).collect();
        let clips: Vec<Entry> = made.into_iter().filter_map(|(_, entry)| entry).collect();
        let count = clips.len();
        let run = run.value().clone();
        let list = ClipList { format: CLIPS_FORMAT.into(), run, clips, left_out: left_out.clone() };
        atomic::write_json(&self.out.join(CLIPS_FILE), &list)?;
        folder.finish()?;
        Ok(Clips { clips: count, left_out, is_new: true })
    }

    fn clip(&self, recording: &Recording, sets: &BTreeMap<String, String>) -> Result<Entry, RunError> {
        let window =
            self.cut.window(&recording.id, recording.trajectory.steps()).map_err(|error| unfit(&error))?;
        let id = format!("{}-from{}", recording.id, window.first_step);
        phase_model::path::check_file_name(&id).map_err(|rule| {
            RunError::Usage(format!("event {}: the name of its clip, {id}, {rule}", recording.id))
        })?;
        let clip = Clip::of(recording, self.cut, id.clone()).map_err(|error| unfit(&error))?;
        let event = format!("{id}.json");
        let text = phase_event::to_json(core::slice::from_ref(&clip.recording))?;
        atomic::write(&self.out.join(&event), text.as_bytes())?;
        let wants = |form: ClipForm, name: String| self.forms.contains(&form).then_some(name);
        let [video, frames, gif] = [
            wants(ClipForm::Mp4, format!("{id}.mp4")),
            wants(ClipForm::Png, id.clone()),
            wants(ClipForm::Gif, format!("{id}.gif")),
        ];
        let states: Vec<State> = clip.window.frames(recording).collect();
        let pictures = Pictures { id: &id, out: &self.out, style: self.style(), states: &states };
        pictures.write(&recording.scene.physics(), video.as_deref(), frames.as_deref(), gif.as_deref())?;
        Ok(Entry {
            source: recording.id.clone(),
            first_step: clip.window.first_step,
            steps: clip.window.steps,
            seconds: seconds_of(clip.window.steps),
            set: sets.get(&recording.id).cloned(),
            kind: clip.kind,
            relation: clip.relation,
            agents: json!(clip.agents),
            id,
            event,
            video,
            frames,
            gif,
        })
    }

    fn style(&self) -> Style {
        Style { grips: !self.plain, palette: self.palette.palette(), ..Style::with_side(self.side) }
    }
}

/// The files and folders that a list of clips names.
fn files_of(list: &Value) -> impl Iterator<Item = &str> {
    let clips = list["clips"].as_array().into_iter().flatten();
    clips.flat_map(|clip| ["event", "video", "frames", "gif"].map(|form| clip[form].as_str())).flatten()
}

/// The pictures of one clip.
struct Pictures<'a> {
    id: &'a str,
    out: &'a Path,
    style: Style,
    states: &'a [State],
}

impl Pictures<'_> {
    fn write(
        &self,
        physics: &PhysicsConfig,
        video: Option<&str>,
        frames: Option<&str>,
        gif: Option<&str>,
    ) -> Result<(), RunError> {
        if video.is_none() && frames.is_none() && gif.is_none() {
            return Ok(());
        }
        let failed = |source: RenderError| RunError::Render { id: self.id.to_owned(), source };
        let renderer = SceneRenderer::new(physics, self.style).map_err(failed)?;
        let mut encoder = match video {
            Some(_) => Some(
                VideoEncoder::new(Vec::new(), renderer.width(), renderer.height(), FRAMES_PER_SECOND)
                    .map_err(failed)?,
            ),
            None => None,
        };
        let mut animation = gif.map(|_| Animation::new(renderer.width(), renderer.height()));
        if let Some(folder) = frames {
            super::create(&self.out.join(folder))?;
        }
        for (k, state) in self.states.iter().enumerate() {
            if interrupt::requested() {
                return Err(RunError::Interrupted(self.out.to_owned()));
            }
            let frame = renderer.frame(state, None);
            if let Some(encoder) = &mut encoder {
                encoder.push(&frame).map_err(failed)?;
            }
            if let Some(animation) = &mut animation {
                animation.push(&frame);
            }
            if let Some(folder) = frames {
                let path = self.out.join(folder).join(format!("{k:04}.png"));
                atomic::write(&path, &frame.png().map_err(failed)?)?;
            }
        }
        if let (Some(encoder), Some(name)) = (encoder, video) {
            atomic::write(&self.out.join(name), &encoder.finish().map_err(failed)?)?;
        }
        if let (Some(animation), Some(name)) = (animation, gif) {
            atomic::write(&self.out.join(name), &animation.encoded(&self.out.join(name))?)?;
        }
        Ok(())
    }
}

/// The frames of a GIF.
struct Animation {
    width: u16,
    height: u16,
    frames: Vec<gif::Frame<'static>>,
}

impl Animation {
    const fn new(width: u32, height: u32) -> Self {
        // A picture has at most 2160 pixels a side.
        Self { width: width as u16, height: height as u16, frames: Vec::new() }
    }

    fn push(&mut self, frame: &Frame) {
        let mut pixels = frame.rgba().to_vec();
        let mut frame = gif::Frame::from_rgba_speed(self.width, self.height, &mut pixels, GIF_SPEED);
        frame.delay = GIF_DELAY;
        self.frames.push(frame);
    }

    fn encoded(&self, path: &Path) -> Result<Vec<u8>, RunError> {
        let failed = |error: gif::EncodingError| {
            let source = std::io::Error::other(error);
            RunError::Output(phase_files::WriteError {
                path: path.to_owned(),
                action: "encode the picture",
                source,
            })
        };
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, self.width, self.height, &[]).map_err(failed)?;
        encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
        for frame in &self.frames {
            encoder.write_frame(frame).map_err(failed)?;
        }
        drop(encoder);
        Ok(bytes)
    }
}

/// The sets of minimal pairs that the events of a dataset belong to, by event.
fn sets(events: &Path) -> Result<BTreeMap<String, String>, RunError> {
    let manifest = events.join(MANIFEST_FILE);
    if !manifest.is_file() {
        return Ok(BTreeMap::new());
    }
    let of = |event: EventEntry| Some((event.id, event.set?.set));
    Ok(Manifest::read(&manifest)?.events.into_iter().filter_map(of).collect())
}

/// A digest of the ids and rows of events.
pub(crate) fn source_digest(source: &EventInput) -> Result<String, RunError> {
    let mut text = String::new();
    for index in 0..source.len() {
        let recording = source.load(index)?;
        text += &phase_files::checksum::sha256_hex(recording.to_json()?.as_bytes());
    }
    Ok(phase_files::checksum::sha256_hex(text.as_bytes()))
}

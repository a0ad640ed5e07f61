//! Events as videos, or as pictures of their key frames, with what agents believe or an observer infers.

mod page;
mod watch;

use crate::{
    captions,
    error::RunError,
    interrupt::requested,
    listener::Listener,
    parallel::{self, make_all},
    picture::{self, BeliefFrame, Look, ObserverFrame, RenderedState},
    source::{self, SeenEvent, SeenInput},
    words,
};
use phase_event::SimulationRecord;
use phase_files::{WriteError, atomic, serialize_told};
use phase_model::{AGENT_COUNT, AgentId, State, Strength, arena::SUBSTEPS};
use phase_render::Palette;
use phase_sim::SimulationSettings;
use serde::{Serialize, Serializer};
use serde_json::json;
use std::path::{Path, PathBuf};
use watch::{Watched, watch};

/// The value of the field `format` of an observer's course.
const OBSERVER_FORMAT: &str = "phase-observer/1";
/// States of the beliefs of an event that are shown at most; each has some 150 bytes.
const MOST_STATES: usize = 1_000_000;

/// Videos or pictures of events.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Rendering {
    /// A file in the format `phase-events/1`, or the folder of a dataset or of simulations.
    pub events: PathBuf,
    /// Only the events with these ids; all if empty.
    pub ids: Vec<String>,
    /// Folder for the files, or for a single event a file that ends in `.mp4`, as a picture in `.png`.
    pub out: PathBuf,
    /// Additions to the bodies.
    pub view: View,
    /// Colours, and size and rate of videos.
    pub look: Look,
    /// Number of frames of a picture, at least 1; without it there is a video.
    pub contact_sheet: Option<usize>,
    /// Number of threads; without it that of this machine's cores.
    pub threads: Option<usize>,
}

/// Additions that a video or picture shows beside the bodies.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum View {
    /// Nothing.
    #[default]
    World,
    /// An agent's field of view and belief, and why it acts; of simulated events only.
    Belief(AgentId),
    /// Both agents' fields of view and beliefs, side by side.
    Beliefs,
    /// The inference of SIMPLE while it watches the event, with this random seed; it is also written into a
    /// file that ends in `.observer.json` beside the video.
    Observer(u64),
}

impl View {
    /// The agents whose beliefs are shown, from left to right.
    fn agents(self) -> Vec<AgentId> {
        match self {
            Self::World | Self::Observer(_) => Vec::new(),
            Self::Belief(agent) => vec![agent],
            Self::Beliefs => AgentId::ALL.into(),
        }
    }

    /// The part of a file's name after the event's id.
    fn suffix(self) -> String {
        match self {
            Self::World => String::new(),
            Self::Belief(agent) => format!(".belief{agent}"),
            Self::Beliefs => ".belief-both".into(),
            Self::Observer(_) => ".observer".into(),
        }
    }
}

impl Rendering {
    /// Draws the events.
    ///
    /// # Errors
    /// If the events cannot be used or have no beliefs to show, `out` is not such a folder or file, SIMPLE
    /// cannot watch an event, a file cannot be written, or a stop was requested.
    pub fn run(&self, listener: &dyn Listener) -> Result<Renderings, RunError> {
        let source = SeenInput::open(&self.events, &self.ids, listener)?;
        let target = Target::of(&self.out, self.extension(), source.len())?;
        // Known before the work for events in files that are already read; folders contain simulated events.
        if !self.view.agents().is_empty() {
            let unsimulated = match &source {
                SeenInput::Labelled(input) => {
                    input.loaded().find(|recording| recording.simulation.is_none()).map(|it| &it.id)
                }
                SeenInput::Unlabelled(events) => events.first().map(|(id, _)| id),
            };
            if let Some(id) = unsimulated {
                return Err(self.unsimulated(id));
            }
        }
        let activity = format!("rendering {}", words::events(source.len()));
        let progress = listener.progress(&activity, source.len(), 1);
        let made = make_all(parallel::threads(self.threads), source.len(), |index| {
            let event = source.load(index)?;
            let made = self.one(&event, target.path(&event.id, self))?;
            if made.is_some() {
                progress.event(0, &event.id);
            }
            Ok(made)
        })?;
        drop(progress);
        let files = made.ok_or_else(|| RunError::Interrupted(self.out.clone()))?;
        let page = match &target {
            Target::Folder(folder) => self.write_page(&source, folder, &files)?,
            Target::File(_) => None,
        };
        Ok(Renderings { files, page })
    }

    /// Draws one event; `None` if it was interrupted.
    fn one(&self, event: &SeenEvent<'_>, path: PathBuf) -> Result<Option<Rendered>, RunError> {
        let watched = match self.view {
            View::Observer(seed) => {
                if is_same_file(&course_path(&path), &self.events) {
                    let file = self.events.display();
                    let rule = "is read, and what an observer makes of it would be written there; choose another --out";
                    return Err(RunError::Usage(format!("{file}: {rule}")));
                }
                let Some(watched) = watch(event, seed, &requested)? else { return Ok(None) };
                Some(watched)
            }
            _ => None,
        };
        if !self.draw(event, &path, watched.as_deref())? {
            return Ok(None);
        }
        let observer = watched.map(|watched| ObserverCourse::write(&path, &event.id, watched)).transpose()?;
        let interpolated = event.simulation().is_none();
        Ok(Some(Rendered { id: event.id.clone().into_owned(), file: path, interpolated, observer }))
    }

    const fn extension(&self) -> &'static str {
        if self.contact_sheet.is_some() { "png" } else { "mp4" }
    }

    /// Draws one event into a file; returns whether that was not interrupted.
    fn draw(
        &self,
        event: &SeenEvent<'_>,
        path: &Path,
        watched: Option<&[Watched]>,
    ) -> Result<bool, RunError> {
        let id = event.id.as_ref();
        // Strengths cannot be seen, nor are they drawn.
        let physics = event.observed.physics([Strength::Fair.max_force(); AGENT_COUNT]);
        let palette = self.look.palette;
        let agents = self.view.agents();
        let minds: Vec<Vec<BeliefFrame>> = match event.simulation() {
            _ if agents.is_empty() => Vec::new(),
            Some(simulation) => {
                let settings = source::settings(&self.events, id, simulation)?;
                self.check_memory(
                    id,
                    settings.minds.particles(),
                    agents.len() * (simulation.event.steps.len() + 1),
                )?;
                agents.into_iter().map(|agent| minds(simulation, agent, &palette, &settings)).collect()
            }
            None => return Err(self.unsimulated(id)),
        };
        // The decision that chose a step is shown while the step lasts.
        let minds_at = |frame: usize| {
            let step = frame.saturating_sub(1) / SUBSTEPS;
            minds.iter().filter_map(|minds| minds.get(step).or(minds.last())).collect()
        };
        let watched = watched.unwrap_or_default();
        let shares: Vec<_> = watched.iter().map(Watched::shares).collect();
        let observers: Vec<ObserverFrame<'_>> = watched
            .iter()
            .enumerate()
            .map(|(step, watched)| ObserverFrame {
                title: watched.title(),
                captions: watched.captions(&palette),
                shares: &shares[..=step],
                times: shares.len(),
            })
            .collect();
        // The observer sees a step when it is over.
        let observer_at = |frame: usize| observers.get(frame / SUBSTEPS).or(observers.last());
        let frames: Box<dyn Iterator<Item = State>> = match &event.recording {
            Some(recording) => recording.frames(),
            None => Box::new(event.observed.frames().into_iter()),
        };
        let items = frames.enumerate().map(|(k, state)| RenderedState {
            state,
            minds: minds_at(k),
            observer: observer_at(k),
        });
        let result = match self.contact_sheet {
            Some(count) => {
                let items: Vec<RenderedState<'_>> = items.collect();
                picture::write_sheet(path, id, &physics, palette, &items, count).map(|()| true)
            }
            None => picture::write_video(path, id, &physics, &self.look, items, &requested),
        };
        result.map_err(|error| match error {
            RunError::Write(error) => RunError::Output(error),
            other => other,
        })
    }

    /// Checks that beliefs do not fill the memory: so many particles at so many times.
    fn check_memory(&self, id: &str, particles: usize, times: usize) -> Result<(), RunError> {
        if particles.saturating_mul(times) <= MOST_STATES {
            return Ok(());
        }
        let file = self.events.display();
        let rule = format!("--belief needs all beliefs at once, at most {MOST_STATES} states");
        let found = format!("not {particles} (settings.minds.particles) at {times} times");
        Err(RunError::Usage(format!("{file}: event {id}: {rule}, {found}")))
    }

    /// An event that was not simulated does not contain its agents' beliefs.
    fn unsimulated(&self, id: &str) -> RunError {
        let file = self.events.display();
        let rule = "--belief needs a simulated event";
        let why = "a measured recording does not tell what its agents saw and did";
        RunError::Usage(format!("{file}: event {id}: {rule}; {why}"))
    }
}

/// All videos or pictures that were made.
#[derive(Clone, Debug, Serialize)]
pub struct Renderings {
    /// One for each event.
    pub files: Vec<Rendered>,
    /// A page to watch them, if there is one.
    #[serde(serialize_with = "serialize_page", skip_serializing_if = "Option::is_none")]
    pub page: Option<PathBuf>,
}

fn serialize_page<S: Serializer>(page: &Option<PathBuf>, serializer: S) -> Result<S::Ok, S::Error> {
    serialize_told(page.as_deref().unwrap_or(Path::new("")), serializer)
}

/// A video or picture that was made.
#[derive(Clone, Debug, Serialize)]
pub struct Rendered {
    /// The event.
    pub id: String,
    /// Its video or picture.
    #[serde(serialize_with = "serialize_told")]
    pub file: PathBuf,
    /// Whether its frames between the recorded steps are interpolated.
    pub interpolated: bool,
    /// Course of an observer's inference about it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub observer: Option<ObserverCourse>,
}

/// The file of what an observer made of an event.
#[derive(Clone, Debug, Serialize)]
pub struct ObserverCourse {
    /// The file.
    #[serde(serialize_with = "serialize_told")]
    pub file: PathBuf,
    /// Mean time that a step took (s).
    pub mean_step_seconds: f64,
    /// Greatest time that a step took (s).
    pub slowest_step_seconds: f64,
}

impl ObserverCourse {
    fn write(video: &Path, id: &str, watched: Vec<Watched>) -> Result<Self, RunError> {
        let file = course_path(video);
        let course = json!({ "format": OBSERVER_FORMAT, "id": id, "course": watched });
        atomic::write_json(&file, &course).map_err(RunError::Output)?;
        let took = watched.iter().map(|watched| watched.took);
        Ok(Self {
            file,
            mean_step_seconds: took.clone().sum::<f64>() / watched.len().max(1) as f64,
            slowest_step_seconds: took.fold(0.0, f64::max),
        })
    }
}

/// The file of an observer's course beside its video.
fn course_path(video: &Path) -> PathBuf {
    let stem = video.with_extension("");
    let stem = if stem.extension().is_some_and(|it| it == "observer") { stem } else { video.to_owned() };
    stem.with_extension("observer.json")
}

/// Whether two paths lead to one file, which is there.
fn is_same_file(one: &Path, other: &Path) -> bool {
    one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other))
}

/// The output paths of pictures.
enum Target {
    File(PathBuf),
    Folder(PathBuf),
}

impl Target {
    fn of(out: &Path, extension: &str, count: usize) -> Result<Self, RunError> {
        let is_file = out.extension().is_some_and(|found| found == extension);
        check_ending(out, extension)?;
        let folder = if is_file { out.parent().unwrap_or(Path::new("")) } else { out };
        if is_file && out.is_dir() {
            return Err(RunError::Usage(format!("--out: {} is a folder; a file is needed", out.display())));
        }
        if is_file && count != 1 {
            let rule = format!("is one file, but there are {count} events; give a folder or an --id");
            return Err(RunError::Usage(format!("--out: {} {rule}", out.display())));
        }
        if !is_file && out.exists() && !out.is_dir() {
            let rule = format!("is a file that does not end in .{extension}; give a folder or such a file");
            return Err(RunError::Usage(format!("--out: {} {rule}", out.display())));
        }
        if !folder.as_os_str().is_empty() {
            std::fs::create_dir_all(folder).map_err(|source| {
                RunError::Output(WriteError { path: folder.to_owned(), action: "create the folder", source })
            })?;
        }
        Ok(if is_file { Self::File(out.to_owned()) } else { Self::Folder(out.to_owned()) })
    }

    fn path(&self, id: &str, rendering: &Rendering) -> PathBuf {
        match self {
            Self::File(path) => path.clone(),
            Self::Folder(folder) => {
                folder.join(format!("{id}{}.{}", rendering.view.suffix(), rendering.extension()))
            }
        }
    }
}

/// Rejects a path with an unsupported file extension, which would become a folder of that name.
fn check_ending(out: &Path, extension: &str) -> Result<(), RunError> {
    const KNOWN: [&str; 12] =
        ["gif", "webm", "mkv", "mov", "avi", "m4v", "apng", "webp", "jpg", "jpeg", "svg", "pdf"];
    let found = out.extension().map(|found| found.to_string_lossy().to_lowercase()).unwrap_or_default();
    let foreign =
        KNOWN.contains(&found.as_str()) || (found != extension && ["mp4", "png"].contains(&&*found));
    if !foreign || out.is_dir() {
        return Ok(());
    }
    let rule = "cannot be written; a video ends in .mp4, and with --contact-sheet N a picture in .png";
    Err(RunError::Usage(format!("--out: {}: .{found} {rule}", out.display())))
}

/// Views of an agent: what it saw, believed and pursued at every step.
fn minds(
    simulation: &SimulationRecord,
    agent: AgentId,
    palette: &Palette,
    settings: &SimulationSettings,
) -> Vec<BeliefFrame> {
    let event = &simulation.event;
    let snapshots = phase_sim::beliefs(event, agent, &settings.minds);
    let colour = palette.names.agents[agent];
    let steps = event.steps.iter().enumerate();
    let mind = |((t, step), snapshot): ((usize, &phase_event::Step), phase_sim::BeliefSnapshot)| {
        let thought = &step.thoughts[agent];
        BeliefFrame {
            agent,
            visible: snapshot.visible,
            particles: snapshot.particles,
            title: format!("Agent {agent} ({colour}), step {t}: {}", step.actions[agent].name()),
            captions: captions::lines(thought),
        }
    };
    steps.zip(snapshots).map(mind).collect()
}

//! `render`: events as videos, or as pictures of their key frames.

pub mod options;
mod watch;

use crate::{context::Context, error::CliError, interrupt};
use options::{Belief, Render};
use phase_event::{Recording, SimulationRecord};
use phase_files::{WriteError, atomic, serialize_told};
use phase_model::{AgentId, arena::SUBSTEPS};
use phase_render::Palette;
use phase_runs::{
    captions,
    error::RunError,
    interrupt::requested,
    parallel::make_all,
    picture::{self, BeliefFrame, ObserverFrame, RenderedState},
    source::EventInput,
    words,
};
use phase_sim::SimulationSettings;
use serde::Serialize;
use serde_json::json;
use std::path::{Path, PathBuf};
use watch::{Watched, watch};

/// The value of the field `format` of an observer's course.
const OBSERVER_FORMAT: &str = "phase-observer/1";

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Render, context: &Context) -> Result<(), CliError> {
    let source = EventInput::open(&arguments.file, &arguments.id, context)?;
    let extension = if arguments.contact_sheet.is_some() { "png" } else { "mp4" };
    let target = Target::of(&arguments.out, extension, source.len())?;
    // Known before the work for events in files that are already read; folders contain simulated events.
    if arguments.belief.is_some()
        && let Some(recording) = source.loaded().find(|recording| recording.simulation.is_none())
    {
        return Err(unsimulated(arguments, &recording.id).into());
    }
    interrupt::listen();
    let progress = context.progress(&format!("rendering {}", words::events(source.len())), source.len(), 1);
    let made = make_all(arguments.jobs.threads(), source.len(), |index| {
        let recording = source.load(index)?;
        let path = target.path(&recording.id, arguments, extension);
        if arguments.observer && is_same_file(&course_path(&path), &arguments.file) {
            let file = arguments.file.display();
            let rule =
                "is read, and what an observer makes of it would be written there; choose another --out";
            return Err(RunError::Usage(format!("{file}: {rule}")));
        }
        let watched = match arguments.observer {
            true => match watch(&recording, arguments.seed, &requested)? {
                Some(watched) => Some(watched),
                None => return Ok(None),
            },
            false => None,
        };
        if !render(arguments, &recording, &path, watched.as_deref())? {
            return Ok(None);
        }
        let observer =
            watched.map(|watched| ObserverCourse::write(&path, &recording.id, watched)).transpose()?;
        progress.event(0, &recording.id);
        let interpolated = recording.simulation.is_none();
        Ok(Some(Rendered { id: recording.id.clone(), file: path, interpolated, observer }))
    })?;
    drop(progress);
    let made = made.ok_or_else(|| RunError::Interrupted(arguments.out.clone()))?;
    let lines = made.iter().map(Rendered::line).collect::<String>();
    arguments.output.print(lines, &json!({ "files": made }))
}

/// A video or picture that was made.
#[derive(Serialize)]
struct Rendered {
    id: String,
    #[serde(serialize_with = "serialize_told")]
    file: PathBuf,
    /// Whether its frames between the recorded steps are interpolated.
    interpolated: bool,
    /// Course of an observer's inference about it.
    #[serde(skip_serializing_if = "Option::is_none")]
    observer: Option<ObserverCourse>,
}

/// The file of what an observer made of an event.
#[derive(Serialize)]
struct ObserverCourse {
    #[serde(serialize_with = "serialize_told")]
    file: PathBuf,
    /// Mean and greatest time that a step took (s).
    mean_step_seconds: f64,
    slowest_step_seconds: f64,
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

impl Rendered {
    fn line(&self) -> String {
        let note = if self.interpolated { " (frames interpolated between recorded steps)" } else { "" };
        let mut lines = format!("{}{note}\n", self.file.display());
        if let Some(observer) = &self.observer {
            let ms = |seconds: f64| 1000.0 * seconds;
            lines += &format!(
                "{} ({:.0} ms a step, {:.0} ms the slowest)\n",
                observer.file.display(),
                ms(observer.mean_step_seconds),
                ms(observer.slowest_step_seconds)
            );
        }
        lines
    }
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
    fn of(out: &Path, extension: &str, count: usize) -> Result<Self, CliError> {
        let is_file = out.extension().is_some_and(|found| found == extension);
        check_ending(out, extension)?;
        let folder = if is_file { out.parent().unwrap_or(Path::new("")) } else { out };
        if is_file && out.is_dir() {
            return Err(CliError::Usage(format!("--out: {} is a folder; a file is needed", out.display())));
        }
        if is_file && count != 1 {
            let rule = format!("is one file, but there are {count} events; give a folder or an --id");
            return Err(CliError::Usage(format!("--out: {} {rule}", out.display())));
        }
        if !is_file && out.exists() && !out.is_dir() {
            let rule = format!("is a file that does not end in .{extension}; give a folder or such a file");
            return Err(CliError::Usage(format!("--out: {} {rule}", out.display())));
        }
        if !folder.as_os_str().is_empty() {
            std::fs::create_dir_all(folder).map_err(|source| {
                CliError::Output(WriteError { path: folder.to_owned(), action: "create the folder", source })
            })?;
        }
        Ok(if is_file { Self::File(out.to_owned()) } else { Self::Folder(out.to_owned()) })
    }

    fn path(&self, id: &str, arguments: &Render, extension: &str) -> PathBuf {
        match self {
            Self::File(path) => path.clone(),
            Self::Folder(folder) => {
                let suffix = if arguments.observer {
                    ".observer"
                } else {
                    arguments.belief.map_or("", Belief::suffix)
                };
                folder.join(format!("{id}{suffix}.{extension}"))
            }
        }
    }
}

/// Rejects a path with an unsupported file extension, which would become a folder of that name.
fn check_ending(out: &Path, extension: &str) -> Result<(), CliError> {
    const KNOWN: [&str; 12] =
        ["gif", "webm", "mkv", "mov", "avi", "m4v", "apng", "webp", "jpg", "jpeg", "svg", "pdf"];
    let found = out.extension().map(|found| found.to_string_lossy().to_lowercase()).unwrap_or_default();
    let foreign =
        KNOWN.contains(&found.as_str()) || (found != extension && ["mp4", "png"].contains(&&*found));
    if !foreign || out.is_dir() {
        return Ok(());
    }
    let rule = "cannot be written; a video ends in .mp4, and with --contact-sheet N a picture in .png";
    Err(CliError::Usage(format!("--out: {}: .{found} {rule}", out.display())))
}

/// Renders one event; returns whether that was not interrupted.
fn render(
    arguments: &Render,
    recording: &Recording,
    path: &Path,
    watched: Option<&[Watched]>,
) -> Result<bool, RunError> {
    let id = &recording.id;
    let physics = recording.scene.physics();
    let palette = arguments.palette.palette();
    let minds: Vec<Vec<BeliefFrame>> = match (arguments.belief, &recording.simulation) {
        (None, _) => Vec::new(),
        (Some(belief), Some(simulation)) => {
            let settings = settings(arguments, id, simulation)?;
            belief.agents().iter().map(|&agent| minds(simulation, agent, &palette, &settings)).collect()
        }
        (Some(_), None) => return Err(unsimulated(arguments, id)),
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
    let items = recording.frames().enumerate().map(|(k, state)| RenderedState {
        state,
        minds: minds_at(k),
        observer: observer_at(k),
    });
    let result = match arguments.contact_sheet {
        Some(count) => {
            let items: Vec<RenderedState<'_>> = items.collect();
            picture::write_sheet(path, id, &physics, palette, &items, count.into()).map(|()| true)
        }
        None => picture::write_video(path, id, &physics, palette, items, &requested),
    };
    result.map_err(|error| match error {
        RunError::Write(error) => RunError::Output(error),
        other => other,
    })
}

/// An event that was not simulated does not contain its agents' beliefs.
fn unsimulated(arguments: &Render, id: &str) -> RunError {
    let file = arguments.file.display();
    let rule = "--belief needs a simulated event";
    let why = "a measured recording does not tell what its agents saw and did";
    RunError::Usage(format!("{file}: event {id}: {rule}; {why}"))
}

/// The settings that an event was simulated with.
fn settings(
    arguments: &Render,
    id: &str,
    simulation: &SimulationRecord,
) -> Result<SimulationSettings, RunError> {
    SimulationSettings::read(&simulation.settings, "settings").map_err(|source| {
        RunError::SimulationSettings { file: arguments.file.clone(), id: id.to_owned(), source }
    })
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

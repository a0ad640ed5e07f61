//! `render`: events as videos, or as pictures of their key frames.

pub mod options;

use crate::{
    captions,
    console::tell,
    engine,
    error::CliError,
    interrupt,
    parallel::make_all,
    picture::{self, Mind, Shot},
    source::Source,
};
use options::{Belief, Render};
use phase_dataset::WriteError;
use phase_event::{Recording, Row, Simulation, Trajectory};
use phase_model::{AgentId, State, arena::SUBSTEPS};
use phase_render::Palette;
use phase_sim::Settings;
use std::path::{Path, PathBuf};

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Render) -> Result<(), CliError> {
    let source = Source::open(&arguments.file, &arguments.id)?;
    let extension = if arguments.contact_sheet.is_some() { "png" } else { "mp4" };
    let target = Target::of(&arguments.out, extension, source.len())?;
    interrupt::listen();
    let made = make_all(&arguments.jobs, source.len(), |index| {
        let recording = source.load(index)?;
        let path = target.path(&recording.id, arguments.belief, extension);
        let note = render(arguments, &recording, &path)?;
        tell(format!("{}{note}", path.display()));
        Ok(Some(()))
    })?;
    made.map(|_| ()).ok_or_else(|| CliError::Interrupted(arguments.out.clone()))
}

/// Where pictures go.
enum Target {
    File(PathBuf),
    Folder(PathBuf),
}

impl Target {
    fn of(out: &Path, extension: &str, count: usize) -> Result<Self, CliError> {
        let is_file = out.extension().is_some_and(|found| found == extension);
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

    fn path(&self, id: &str, belief: Option<Belief>, extension: &str) -> PathBuf {
        match self {
            Self::File(path) => path.clone(),
            Self::Folder(folder) => {
                let belief = belief.map_or("", Belief::suffix);
                folder.join(format!("{id}{belief}.{extension}"))
            }
        }
    }
}

/// Renders one event and returns what there is to say about it.
fn render(arguments: &Render, recording: &Recording, path: &Path) -> Result<&'static str, CliError> {
    let (id, physique) = (&recording.id, recording.scene.physique());
    let palette = arguments.palette.palette();
    let minds: Vec<Vec<Mind>> = match (arguments.belief, &recording.simulation) {
        (None, _) => Vec::new(),
        (Some(belief), Some(simulation)) => {
            belief.agents().iter().map(|&agent| minds(simulation, agent, &palette)).collect()
        }
        (Some(_), None) => {
            let (file, rule) = (arguments.file.display(), "--belief needs a simulated event");
            let why = "a measured recording does not tell what its agents saw and did";
            return Err(CliError::Usage(format!("{file}: event {id}: {rule}; {why}")));
        }
    };
    let (states, note) = match &recording.simulation {
        Some(simulation) => (simulation.event.frames().copied().collect(), ""),
        None => (interpolated(&recording.trajectory), " (frames interpolated between recorded steps)"),
    };
    // The mind that chose a step is shown while the step lasts.
    let minds_at = |frame: usize| {
        let step = frame.saturating_sub(1) / SUBSTEPS;
        minds.iter().filter_map(|minds| minds.get(step).or(minds.last())).collect()
    };
    let frames = states.into_iter().enumerate();
    let shots: Vec<Shot<'_>> = frames.map(|(k, state)| Shot { state, minds: minds_at(k) }).collect();
    let result = match arguments.contact_sheet {
        Some(count) => picture::write_sheet(path, id, &physique, palette, &shots, count.into()),
        None => picture::write_video(path, id, &physique, palette, &shots),
    };
    result.map(|()| note).map_err(|error| match error {
        CliError::Write(error) => CliError::Output(error),
        other => other,
    })
}

/// What an agent saw, believed and was after at every step.
fn minds(simulation: &Simulation, agent: AgentId, palette: &Palette) -> Vec<Mind> {
    let event = &simulation.event;
    let settings: Settings = serde_json::from_value(simulation.settings.clone()).unwrap_or_default();
    let snapshots = engine::beliefs(event, agent, &settings);
    let colour = palette.agent_names[agent];
    let steps = event.steps.iter().enumerate();
    let mind = |((t, step), snapshot): ((usize, &phase_event::Step), phase_sim::BeliefSnapshot)| {
        let thought = &step.thoughts[agent];
        Mind {
            agent,
            visible: snapshot.visible,
            particles: snapshot.particles,
            title: format!("Agent {agent} ({colour}), step {t}: {}", step.actions[agent].name()),
            captions: captions::lines(thought),
        }
    };
    steps.zip(snapshots).map(mind).collect()
}

/// Five frames for each step of a recording that has rows only: the bodies go straight from row to row.
fn interpolated(trajectory: &Trajectory) -> Vec<State> {
    let between = |rows: &[Row], t: usize, share: f32| -> Row {
        core::array::from_fn(|column| rows[t - 1][column] + share * (rows[t][column] - rows[t - 1][column]))
    };
    let mut states = Vec::with_capacity(1 + trajectory.steps() * SUBSTEPS);
    states.extend(trajectory.state(0));
    for t in 1..=trajectory.steps() {
        for substep in 1..=SUBSTEPS {
            let share = substep as f32 / SUBSTEPS as f32;
            let row = |rows: &Vec<Row>| vec![between(rows, t, share)];
            let moment = Trajectory {
                agents: trajectory.agents.each_ref().map(row),
                objects: trajectory.objects.iter().map(row).collect(),
            };
            states.extend(moment.state(0));
        }
    }
    states
}

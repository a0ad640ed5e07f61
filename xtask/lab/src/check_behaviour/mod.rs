//! `check-behaviour`: whether agents show the intended behaviour, over seeds and reflected scenes.

mod judge;
pub mod options;
mod report;
mod rows;
pub mod sets;
mod trial;

use crate::{check_minds::parameters, error::LabError};
use options::CheckBehaviour;
use phase_cli::{context::Context, interrupt};
use phase_dataset::phase_events;
use phase_files::{
    WriteError, atomic,
    folder::{self, Folder},
    run::Run,
};
use phase_minds::MindParameters;
use phase_model::{Awareness, Scene, arena::SUBSTEPS};
use phase_render::Palette;
use phase_runs::{
    engine::GENERATOR,
    error::RunError,
    event_writer::settings_value,
    parallel::make_all,
    picture::{self, RenderedState},
};
use phase_sim::SimulationSettings;
use report::{SceneResult, Trial};
use rows::PARTS;
use std::path::{Path, PathBuf};
use trial::TrialRunner;

/// The report's file name in the output folder; it is written last.
const REPORT_FILE: &str = "behaviour.json";
/// Folder of the contact sheets.
const SHEETS: &str = "sheets";
/// Frames of a contact sheet.
const SHEET_FRAMES: usize = 15;

/// Runs the command.
///
/// # Errors
/// Any [`LabError`].
pub fn run(arguments: &CheckBehaviour, context: &Context) -> Result<(), LabError> {
    arguments.json.check([])?;
    let scenes = scenes(arguments)?;
    let seeds = arguments.seeds as usize;
    let settings = settings(arguments)?;
    let run = Run::new([
        ("command", "check-behaviour".into()),
        ("generator", GENERATOR.into()),
        ("level", arguments.level.map(u8::from).into()),
        ("seeds", seeds.into()),
        ("set", arguments.scenes.is_none().then(|| arguments.set.name()).into()),
        ("settings", settings_value(&settings)?),
    ]);
    let folder = prepare(&arguments.out, &run)?;
    interrupt::listen();
    let controls = scenes.iter().filter(|(part, ..)| PARTS[*part].control.is_some()).count();
    let events = seeds * (scenes.len() + controls);
    let runner = TrialRunner::new(&folder, settings, events, context);
    let made = make_all(arguments.jobs.threads(), scenes.len() * seeds, |k| {
        let (part, id, scene) = &scenes[k / seeds];
        runner.trial(&PARTS[*part], id, scene, k % seeds)
    })?;
    let Some(trials) = made else { return Err(RunError::Interrupted(arguments.out.clone()).into()) };
    let mut trials = trials.into_iter();
    let results: Vec<SceneResult> = scenes
        .iter()
        .map(|(part, id, _)| SceneResult {
            part: *part,
            id: id.clone(),
            trials: trials.by_ref().take(seeds).collect(),
        })
        .collect();
    let sheets = folder.subfolder(SHEETS).map_err(RunError::from)?;
    for (result, (.., scene)) in results.iter().zip(&scenes) {
        draw(&runner, &sheets, result, scene)?;
    }
    drop(runner);
    let report = report::to_json(run.value(), &results);
    atomic::write_json(&folder.path().join(REPORT_FILE), &report).map_err(RunError::from)?;
    folder.finish().map_err(RunError::from)?;
    let place = arguments.out.join(SHEETS);
    let text = format!("{}contact sheets in {}", report::table(&results), place.display());
    Ok(arguments.json.print(&report, text)?)
}

/// The settings of the events, with the parameters of a file if one is given.
fn settings(arguments: &CheckBehaviour) -> Result<SimulationSettings, RunError> {
    let Some(file) = &arguments.parameters else { return arguments.effort.settings() };
    let minds = parameters::read(file)?;
    // What was fitted with few simulations is checked with as many as an agent has that acts.
    let simulations = MindParameters::of(minds.kind()).simulations();
    arguments.effort.effort().settings_with(minds.with_simulations(simulations))
}

/// The requested scenes: part of the table, id, scene.
fn scenes(arguments: &CheckBehaviour) -> Result<Vec<(usize, String, Scene)>, RunError> {
    let mut scenes = Vec::new();
    let wanted = |row: u8| arguments.row.is_empty() || arguments.row.contains(&row);
    let folders = arguments.folders();
    for (k, part) in PARTS.iter().enumerate().filter(|(_, part)| wanted(part.row)) {
        for file in files(part, &folders) {
            for recording in phase_events::read(&file)? {
                let id = recording.id;
                let mut scene = recording.scene;
                if let Some(level) = arguments.level {
                    scene.agents.iter_mut().for_each(|agent| agent.awareness = Awareness::ignorant(level));
                }
                if let Some(rule) = problem(&scene) {
                    return Err(RunError::Usage(format!("{}: event {id}: {rule}", file.display())));
                }
                scenes.push((k, id, scene));
            }
        }
    }
    Ok(scenes)
}

/// The files of a part.
fn files(part: &rows::BehaviourTest, folders: &[PathBuf]) -> Vec<PathBuf> {
    folders.iter().map(|folder| folder.join(format!("{}.json", part.name))).collect()
}

/// Reason that a scene cannot be simulated here, if there is one.
fn problem(scene: &Scene) -> Option<String> {
    if scene.layout.flip().is_some() {
        return Some("field `layout.flip` must be null, since scenes are mirrored here".into());
    }
    scene.validate_without_overlap().err().map(|error| error.to_string())
}

/// Prepares the folder. The results of a finished check are replaced; those of an unfinished one are kept and
/// used if they are of this executable.
fn prepare(out: &Path, run: &Run) -> Result<Folder, RunError> {
    folder::inspect(out, REPORT_FILE)?;
    let folder = Folder::claim(out, run)?;
    atomic::remove(&out.join(REPORT_FILE))?;
    let sheets = folder.subfolder(SHEETS).map_err(RunError::from)?;
    let failed = |source| WriteError { path: sheets.clone(), action: "clear the folder", source };
    for entry in std::fs::read_dir(&sheets).map_err(failed)?.flatten() {
        if entry.path().extension().is_some_and(|extension| extension == "png") {
            atomic::remove(&entry.path())?;
        }
    }
    Ok(folder)
}

/// Contact sheets of a scene's first event and of its first failure.
fn draw(runner: &TrialRunner, sheets: &Path, result: &SceneResult, scene: &Scene) -> Result<(), RunError> {
    let part = &PARTS[result.part];
    let first = result.trials.first().map(|trial| (trial, ""));
    let failure = result.trials.iter().find(|trial| !trial.verdict.success).map(|trial| (trial, "-failure"));
    for (trial, suffix) in first.into_iter().chain(failure) {
        let name = format!("{}-{}{suffix}.png", trial::key(part), result.id);
        sheet(runner, &sheets.join(name), part, &result.id, scene, trial)?;
    }
    Ok(())
}

fn sheet(
    runner: &TrialRunner,
    path: &Path,
    part: &rows::BehaviourTest,
    id: &str,
    scene: &Scene,
    trial: &Trial,
) -> Result<(), RunError> {
    let index = trial.seed as usize - 1;
    let Some(event) = runner.event(part, id, scene, index)? else {
        return Err(RunError::Interrupted(path.to_owned()));
    };
    let items: Vec<RenderedState<'_>> = event
        .frames()
        .step_by(SUBSTEPS)
        .map(|&state| RenderedState { state, minds: Vec::new(), observer: None })
        .collect();
    picture::write_sheet(path, id, &event.scene.physics(), Palette::PAPER, &items, SHEET_FRAMES)
}

#[cfg(test)]
mod tests {
    use super::{files, judge::judge, rows::PARTS, sets::SceneSet};
    use phase_dataset::phase_events;
    use phase_evidence::Track;
    use phase_model::{AgentId, Entity, Grip, ObjectId, Side};

    /// An event in which nothing happens is not a success, with or without a counterfactual.
    #[test]
    fn no_criterion_holds_at_the_start() {
        for part in &PARTS {
            for file in files(part, &SceneSet::All.folders()) {
                for recording in phase_events::read(&file).expect("readable") {
                    let scene = &recording.scene;
                    let start = Track { physics: scene.physics(), states: vec![scene.initial_state()] };
                    let control = part.control.map(|_| &start);
                    let verdict = judge(part, scene, &start, control);
                    assert!(!verdict.success, "{} {}: {}", file.display(), recording.id, verdict.notes);
                }
            }
        }
    }

    /// Held from step 1 on, and seen in none, half or all but two of nine steps.
    #[test]
    fn holding_is_unseen_while_the_victim_looks_away() {
        let part = PARTS.iter().find(|part| part.row == 12).expect("the row of hidden hindering");
        let file = &files(part, &SceneSet::First.folders())[0];
        let recordings = phase_events::read(file).expect("readable");
        let scene = &recordings.first().expect("a scene").scene;
        let [hinderer, victim] = [AgentId::ZERO, AgentId::ONE].map(Entity::Agent);
        let judged = |looking: usize| {
            let state = |step: usize| {
                let mut state = scene.initial_state();
                let way = state.position(hinderer) - state.position(victim);
                let towards = libm::atan2f(-way.x, way.y);
                let away = if step > looking { core::f32::consts::PI } else { 0.0 };
                state.body_mut(victim).angle = towards + away;
                let object = ObjectId::ZERO;
                state.grips[0] = (step > 0).then_some(Grip { object, side: Side::Head, relative_angle: 0.0 });
                state
            };
            let track = Track { physics: scene.physics(), states: (0..10).map(state).collect() };
            let verdict = judge(part, scene, &track, None);
            (verdict.success, verdict.shown, verdict.notes)
        };
        for (looking, success) in [(0, true), (4, true), (5, false), (9, false)] {
            let (is_success, shown, notes) = judged(looking);
            assert_eq!((is_success, shown), (success, Some(true)), "{notes}");
            assert!(
                notes.ends_with(&format!("held from step 1, 9 steps, {} unseen", 9 - looking)),
                "{notes}"
            );
        }
    }
}

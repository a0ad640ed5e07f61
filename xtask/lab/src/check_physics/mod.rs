//! `check-physics`: the error of an engine with respect to recorded motion.

pub mod options;
mod table;
mod targets;

use crate::error::LabError;
use options::CheckPhysics;
use phase_calibration::{
    ColdForward, Engine, OriginalEngine, Probe, ReadError, Replay, Report, Run, StatelessErrors, WarmForward,
    WorldEngine, horizon_errors, probes_report, replay_reports, run_reports,
};
use phase_cli::context::Context;
use phase_files::json;
use phase_runs::{error::RunError, source::EventInput};
use serde::Serialize;
use serde_json::Value;
use std::{borrow::Cow, path::Path};
use targets::Target;

/// Records that the engine is compared with.
struct Records {
    probes: Option<Vec<Probe>>,
    runs: Option<Vec<Run>>,
    replays: Option<Vec<Replay>>,
    /// Events with recovered actions that cannot be replayed because they are reflected.
    mirrored: usize,
}

/// Runs the command. A missed target is a result, not an error.
///
/// # Errors
/// Any [`LabError`] about the files.
pub fn run(arguments: &CheckPhysics, context: &Context) -> Result<(), LabError> {
    let files = [&arguments.probes, &arguments.runs, &arguments.events];
    if files.iter().all(|file| file.is_none()) {
        let rule = "check-physics needs at least one of --probes, --runs and --events";
        return Err(RunError::Usage(rule.into()).into());
    }
    arguments.json.check(files.into_iter().flatten())?;
    let records = Records::read(arguments, context)?;
    context.note(format!("measuring the engine {}", arguments.engine.name()));
    let (report, targets) = match arguments.engine {
        phase_sim::Engine::World => {
            let report = records.measure::<WorldEngine>("world");
            let targets = targets::of_world(&report);
            (report, targets)
        }
        phase_sim::Engine::Original => {
            let report = records.measure::<OriginalEngine>("original");
            let targets = targets::of_forward(&report);
            (report, targets)
        }
        phase_sim::Engine::Forward => {
            let mut report = records.measure::<WarmForward>("forward");
            report.state_alone = records.runs.as_ref().map(|runs| StatelessErrors {
                one_step: horizon_errors::<ColdForward>(runs, 1),
                ten_steps: horizon_errors::<ColdForward>(runs, 10),
            });
            let targets = targets::of_forward(&report);
            (report, targets)
        }
    };
    let mirrored_left_out = report.replays.as_ref().map(|_| records.mirrored);
    let output = Output { report: &report, targets: &targets, mirrored_left_out };
    Ok(arguments.json.print(&output, table::print(&report, &targets, records.mirrored))?)
}

impl Records {
    fn read(arguments: &CheckPhysics, context: &Context) -> Result<Self, LabError> {
        let (replays, mirrored) = match &arguments.events {
            None => (None, 0),
            Some(file) => {
                let (replays, mirrored) = replays(file, context)?;
                (Some(replays), mirrored)
            }
        };
        Ok(Self {
            probes: arguments.probes.as_ref().map(|file| read(file, Probe::from_value)).transpose()?,
            runs: arguments.runs.as_ref().map(|file| read(file, Run::from_value)).transpose()?,
            replays,
            mirrored,
        })
    }

    fn measure<E: Engine>(&self, engine: &str) -> Report {
        let runs = self.runs.as_deref();
        Report {
            engine: engine.into(),
            probes: self.probes.as_deref().map(probes_report::<E>),
            runs: runs.map(run_reports::<E>),
            replays: self.replays.as_deref().map(replay_reports::<E>),
            one_step: runs.and_then(|runs| horizon_errors::<E>(runs, 1)),
            ten_steps: runs.and_then(|runs| horizon_errors::<E>(runs, 10)),
            state_alone: None,
        }
    }
}

fn read<T>(file: &Path, parse: impl Fn(&Value) -> Result<T, ReadError>) -> Result<T, LabError> {
    let value = json::read(file).map_err(RunError::File)?;
    parse(&value).map_err(|source| LabError::Calibration { file: file.to_owned(), source })
}

/// The events of a file that can be replayed, and the number of those that cannot only because they are
/// reflected.
fn replays(file: &Path, context: &Context) -> Result<(Vec<Replay>, usize), RunError> {
    let source = EventInput::open(file, &[], context)?;
    let mut recordings =
        (0..source.len()).map(|k| source.load(k).map(Cow::into_owned)).collect::<Result<Vec<_>, _>>()?;
    recordings.retain(|recording| recording.recovered_actions.is_some());
    let replays: Vec<Replay> = recordings.iter().filter_map(Replay::of_recording).collect();
    let mirrored = recordings.iter().filter(|recording| recording.scene.layout.flip().is_some()).count();
    if replays.is_empty() {
        let rule = "field `events` must hold an event with `recovered_actions` that is not mirrored";
        return Err(RunError::Usage(format!("{}: {rule}", file.display())));
    }
    Ok((replays, mirrored))
}

/// The file that `--json` writes.
#[derive(Serialize)]
struct Output<'a> {
    #[serde(flatten)]
    report: &'a Report,
    targets: &'a [Target],
    /// Events with recovered actions that were skipped because they are reflected.
    #[serde(skip_serializing_if = "Option::is_none")]
    mirrored_left_out: Option<usize>,
}
